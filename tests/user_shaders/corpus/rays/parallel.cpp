// SPDX-License-Identifier: Apache-2.0
// Parallel rays out of a rectangle around the camera, from the place on the film.
#include <shader.h>

struct cp_parallel {
  miScalar width;
};

extern "C" DLLEXPORT int cp_parallel_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean cp_parallel(miColor* result, miState* state, cp_parallel* paras) {
  const miCamera* camera = state->camera;
  const miScalar half = *mi_eval_scalar(&paras->width) / 2;
  miVector org = {(state->raster_x / camera->x_resolution * 2 - 1) * half,
                  (state->raster_y / camera->y_resolution * 2 - 1) * half / camera->aspect, 0};
  miVector dir = {0, 0, -1};
  mi_point_from_camera(state, &org, &org);
  mi_vector_from_camera(state, &dir, &dir);
  return mi_trace_eye(result, state, &org, &dir);
}
