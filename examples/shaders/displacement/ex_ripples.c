/* SPDX-License-Identifier: Apache-2.0 */
/* Rings on water about a point of the object. */
/* Shows: a displacement shader; it adds to what shaders before it have said. */
#include <shader.h>

struct ex_ripples {
  miVector centre; /* object space */
  miScalar length; /* of a wave */
  miScalar height;
  miScalar speed; /* waves a frame */
};

DLLEXPORT int ex_ripples_version(void) { return 1; }

DLLEXPORT miBoolean ex_ripples(miScalar* result, miState* state, struct ex_ripples* paras) {
  const miVector* centre = mi_eval_vector(&paras->centre);
  miScalar length = *mi_eval_scalar(&paras->length);
  miScalar distance, phase;
  miVector p;

  mi_point_to_object(state, &p, &state->point);
  distance = mi_vector_dist(&p, centre) / length;
  phase = distance - *mi_eval_scalar(&paras->speed) * (miScalar)state->camera->frame;
  *result +=
      *mi_eval_scalar(&paras->height) * (miScalar)(cos(2.0 * M_PI * phase) / (1.0 + distance));
  return miTRUE;
}
