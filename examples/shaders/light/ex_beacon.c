/* SPDX-License-Identifier: Apache-2.0 */
/* A lamp whose beam turns once in so many frames; it decays with the square of the distance. */
/* Shows: a light shader, what a light asks about itself, shadows. */
#include <shader.h>

struct ex_beacon {
  miColor color;   /* at distance 1 */
  miScalar frames; /* of one turn */
  miScalar sharpness;
  miBoolean shadow;
};

DLLEXPORT int ex_beacon_version(void) { return 1; }

DLLEXPORT miBoolean ex_beacon(miColor* result, miState* state, struct ex_beacon* paras) {
  miScalar angle, cosine, weight;
  miVector beam, dir;

  *result = *mi_eval_color(&paras->color);
  /* Rays that see the lamp itself ask for its colour, not for what it sends. */
  if (state->type != miRAY_LIGHT && !miRAY_PHOTON(state->type)) return miTRUE;

  /* The beam turns about the light's own y axis; dir leads from the light to the lit point. */
  angle = (miScalar)(2.0 * M_PI) * (miScalar)state->camera->frame / *mi_eval_scalar(&paras->frames);
  beam.x = (miScalar)cos(angle);
  beam.y = 0;
  beam.z = (miScalar)sin(angle);
  mi_vector_to_light(state, &dir, &state->dir);
  mi_vector_normalize(&dir);
  cosine = mi_vector_dot(&dir, &beam);
  if (cosine <= 0) return miFALSE;

  weight =
      (miScalar)(pow(cosine, *mi_eval_scalar(&paras->sharpness)) / (state->dist * state->dist));
  result->r *= weight;
  result->g *= weight;
  result->b *= weight;

  /* A light shader casts its own shadows: this multiplies result, miFALSE when nothing is left. */
  if (*mi_eval_boolean(&paras->shadow)) return mi_trace_shadow(result, state);
  return miTRUE;
}
