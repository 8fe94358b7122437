/* SPDX-License-Identifier: Apache-2.0 */
/* The finished picture of a green square at depth 4. */
#include "coverage.h"

DLLEXPORT miBoolean cover_output(void* result, miState* state, void* paras) {
  miContour_endpoint a, b;
  miColor c;
  miScalar depth = 0;
  miVector n;
  miImg_image* image = mi_output_image_open(state, miRC_IMAGE_RGBA);
  miInstance* camera;

  memset(&a, 0, sizeof(a));
  memset(&b, 0, sizeof(b));
  COVER(mi_output_image_open, image && image->width == 2 && image->height == 2);
  if (!image) return miFALSE;
  mi_img_get_color(image, &c, 0, 0);
  COVER(mi_output_image_open, SHOWS(c, 0, 1, 0));
  c = paint(1, 1, 0);
  mi_img_put_color(image, &c, 0, 0);
  mi_output_image_close(state, miRC_IMAGE_RGBA);
  image = mi_output_image_open(state, miRC_IMAGE_RGBA);
  mi_img_get_color(image, &c, 0, 0);
  COVER(mi_output_image_close, SHOWS(c, 1, 1, 0));
  mi_output_image_close(state, miRC_IMAGE_RGBA);

  image = mi_output_image_open(state, miRC_IMAGE_Z);
  if (image) mi_img_get_depth(image, &depth, 1, 1);
  COVER(mi_output_image_open, image && fabs(depth) >= 4 && fabs(depth) < 7);
  mi_output_image_close(state, miRC_IMAGE_Z);
  image = mi_output_image_open(state, miRC_IMAGE_N);
  if (image) mi_img_get_normal(image, &n, 1, 1);
  COVER(mi_output_image_open, image && IS(n, 0, 0, 1));
  mi_output_image_close(state, miRC_IMAGE_N);
  COVER(mi_output_image_open, !mi_output_image_open(state, 99));

  /* Contours are not drawn. */
  mi_add_contour_lines(&a, &b, 1);
  COVER(mi_add_contour_lines, 1);
  COVER(mi_get_contour_line, !mi_get_contour_line(&a, &b));

  camera = mi_scene_edit(state->camera_inst);
  COVER(mi_scene_edit, camera && camera->tf.global_to_local[14] == -4);
  mi_scene_edit_end(state->camera_inst);
  COVER(mi_scene_edit_end, mi_db_type(state->camera_inst) == miSCENE_INSTANCE);
  return miTRUE;
}
