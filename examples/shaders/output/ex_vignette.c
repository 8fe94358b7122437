/* SPDX-License-Identifier: Apache-2.0 */
/* Darkens the picture towards its corners as a plain lens does: by cosine to the fourth. */
/* Shows: an output shader that changes the finished picture. */
#include <shader.h>

struct ex_vignette {
  miScalar strength; /* 0 nothing, 1 as the camera's own lens */
};

DLLEXPORT int ex_vignette_version(void) { return 1; }

DLLEXPORT miBoolean ex_vignette(void* result, miState* state, struct ex_vignette* paras) {
  const miCamera* camera = state->camera;
  miScalar strength = *mi_eval_scalar(&paras->strength);
  /* Half the film's width, in lengths of the focal distance. */
  miScalar half = 0.5f * camera->aperture / camera->focal;
  miImg_image* image = mi_output_image_open(state, miRC_IMAGE_RGBA);
  int x, y;

  if (!image) return miFALSE;
  for (y = 0; y < camera->y_resolution; y++) {
    if (mi_par_aborted()) break; /* the user does not want to wait */
    for (x = 0; x < camera->x_resolution; x++) {
      miScalar u = half * (2.0f * ((miScalar)x + 0.5f) / (miScalar)camera->x_resolution - 1.0f);
      miScalar v = half / camera->aspect *
                   (2.0f * ((miScalar)y + 0.5f) / (miScalar)camera->y_resolution - 1.0f);
      miScalar squared = 1.0f / (1.0f + u * u + v * v); /* cosine, squared */
      miScalar weight = 1.0f + strength * (squared * squared - 1.0f);
      miColor color;
      mi_img_get_color(image, &color, x, y);
      color.r *= weight;
      color.g *= weight;
      color.b *= weight;
      mi_img_put_color(image, &color, x, y);
    }
  }
  mi_output_image_close(state, miRC_IMAGE_RGBA);
  return miTRUE;
}
