/* SPDX-License-Identifier: Apache-2.0 */
/* A shader for files of render passes finds none. The warnings are looked for where the program
   says them. */
#include "coverage.h"

DLLEXPORT miBoolean cover_renderpass(miColor* result, miState* state, void* paras) {
  int xl = 1, yl = 1, xs = 1, ys = 1, xres = 1, yres = 1;
  miColor sample = paint(.1, .2, .3);
  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  COVER(mi_renderpass_access, mi_renderpass_access(state, -1, miRC_IMAGE_RGBA) == NULL);
  COVER(mi_renderpass_resolution,
        !mi_renderpass_resolution(&xl, &yl, &xs, &ys, &xres, &yres, state, 0, 0));
  COVER(mi_renderpass_resolution, xl == 0 && yl == 0 && xs == 0 && ys == 0);
  COVER(mi_renderpass_resolution, xres == 0 && yres == 0);
  COVER(mi_renderpass_sample_get,
        !mi_renderpass_sample_get(&sample, sizeof(sample), state, 0, 0, 0) &&
            SHOWS(sample, .1, .2, .3));
  COVER(mi_renderpass_sample_put,
        !mi_renderpass_sample_put(&sample, sizeof(sample), state, 0, 0, 0));
  COVER(mi_renderpass_samplerect_black, !mi_renderpass_samplerect_black(state, 0, 0, 0));
  COVER(mi_renderpass_samplerect_flush, !mi_renderpass_samplerect_flush(state, 0, 0, 0));
  return miTRUE;
}
