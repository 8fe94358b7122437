/* SPDX-License-Identifier: Apache-2.0 */
/* A sky between two colours, with a soft glow where the sun went down. */
/* Shows: an environment shader; only the ray's origin and direction mean something there. */
#include <shader.h>

struct ex_dusk {
  miColor zenith;
  miColor horizon;
  miColor glow;
  miVector sun; /* direction of the sunset, world space */
  miVector up;  /* world space */
};

DLLEXPORT int ex_dusk_version(void) { return 1; }

DLLEXPORT miBoolean ex_dusk(miColor* result, miState* state, struct ex_dusk* paras) {
  const miColor* zenith = mi_eval_color(&paras->zenith);
  const miColor* horizon = mi_eval_color(&paras->horizon);
  const miColor* glow = mi_eval_color(&paras->glow);
  miVector up = *mi_eval_vector(&paras->up);
  miVector sun = *mi_eval_vector(&paras->sun);
  miVector dir;
  miScalar height, share, cosine;

  mi_vector_to_world(state, &dir, &state->dir);
  mi_vector_normalize(&dir);
  mi_vector_normalize(&up);
  mi_vector_normalize(&sun);

  height = mi_vector_dot(&dir, &up);
  share = height > 0 ? (miScalar)sqrt(height) : 0;
  cosine = mi_vector_dot(&dir, &sun);
  cosine = cosine > 0 ? (miScalar)pow(cosine, 16.0) : 0;
  result->r = horizon->r + share * (zenith->r - horizon->r) + cosine * glow->r;
  result->g = horizon->g + share * (zenith->g - horizon->g) + cosine * glow->g;
  result->b = horizon->b + share * (zenith->b - horizon->b) + cosine * glow->b;
  result->a = 0;
  return miTRUE;
}
