// SPDX-License-Identifier: Apache-2.0
// Fog that is thick on the ground and thinner above: its density falls exponentially with height,
// so how much of it a ray crosses has a closed form.
// Shows: a volume shader; result holds what lies behind the fog.
#include <shader.h>

struct ex_ground_fog {
  miColor color;
  miScalar density;  // on the ground, per unit of length
  miScalar height;   // over which it falls to 1/e
  miScalar ground;   // height of the ground, world space, y is up
};

extern "C" DLLEXPORT int ex_ground_fog_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean ex_ground_fog(miColor* result, miState* state,
                                             ex_ground_fog* paras) {
  const miScalar density = *mi_eval_scalar(&paras->density);
  const miScalar height = *mi_eval_scalar(&paras->height);
  if (density <= 0 || height <= 0) return miTRUE;

  miVector from, along;
  mi_point_to_world(state, &from, &state->org);
  mi_vector_to_world(state, &along, &state->dir);
  const double start = density * exp(-(from.y - *mi_eval_scalar(&paras->ground)) / height);
  const double rise = along.y / height;
  // A distance of 0 stands for a ray that goes on for ever.
  const bool endless = state->dist == 0;
  double depth;
  if (fabs(rise) < 1e-6)
    depth = endless ? 1e9 : start * state->dist;
  else if (endless)
    depth = rise > 0 ? start / rise : 1e9;
  else
    depth = start * (1 - exp(-rise * state->dist)) / rise;
  const miScalar passes = (miScalar)exp(-depth);

  // Light on its way to a surface only loses something.
  if (state->type == miRAY_SHADOW || state->type == miRAY_LIGHT) {
    result->r *= passes;
    result->g *= passes;
    result->b *= passes;
    return passes > 0 ? miTRUE : miFALSE;
  }
  const miColor fog = *mi_eval_color(&paras->color);
  result->r = result->r * passes + fog.r * (1 - passes);
  result->g = result->g * passes + fog.g * (1 - passes);
  result->b = result->b * passes + fog.b * (1 - passes);
  result->a = result->a * passes + (1 - passes);
  return miTRUE;
}
