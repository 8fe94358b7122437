/* SPDX-License-Identifier: Apache-2.0 */
/* A fisheye lens: the angle to the axis grows with the distance to the middle of the picture. */
/* Shows: a lens shader, raster and camera space. */
#include <shader.h>

struct ex_fisheye {
  miScalar angle; /* of view across the picture's width, degrees */
};

DLLEXPORT int ex_fisheye_version(void) { return 1; }

DLLEXPORT miBoolean ex_fisheye(miColor* result, miState* state, struct ex_fisheye* paras) {
  const miCamera* camera = state->camera;
  miScalar half = *mi_eval_scalar(&paras->angle) * (miScalar)(M_PI / 360.0);
  /* From -1 to 1 across the width, the same unit upwards. */
  miScalar x = 2.0f * state->raster_x / (miScalar)camera->x_resolution - 1.0f;
  miScalar y = (2.0f * state->raster_y / (miScalar)camera->y_resolution - 1.0f) / camera->aspect;
  miScalar r = (miScalar)sqrt(x * x + y * y);
  miVector origin = {0, 0, 0}, dir;

  if (r * half > (miScalar)M_PI) { /* behind the whole sphere */
    result->r = result->g = result->b = result->a = 0;
    return miTRUE;
  }
  dir.x = r > 0 ? (miScalar)sin(r * half) * x / r : 0;
  dir.y = r > 0 ? (miScalar)sin(r * half) * y / r : 0;
  dir.z = -(miScalar)cos(r * half); /* a camera looks down its own -z */

  mi_vector_from_camera(state, &dir, &dir);
  mi_vector_normalize(&dir);
  mi_point_from_camera(state, &origin, &origin);
  return mi_trace_eye(result, state, &origin, &dir);
}
