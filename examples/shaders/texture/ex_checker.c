/* SPDX-License-Identifier: Apache-2.0 */
/* Two colours in a pattern of cubes, with edges that noise makes uneven. */
/* Shows: a texture shader, parameters that are asked for only when they are needed. */
#include <shader.h>

struct ex_checker {
  miVector coord; /* as a remapping shader gives it */
  miScalar size;
  miScalar wobble; /* of the edges, in sizes */
  miColor even;
  miColor odd;
};

DLLEXPORT int ex_checker_version(void) { return 1; }

DLLEXPORT miBoolean ex_checker(miColor* result, miState* state, struct ex_checker* paras) {
  miVector p = *mi_eval_vector(&paras->coord);
  miScalar size = *mi_eval_scalar(&paras->size);
  miScalar wobble = *mi_eval_scalar(&paras->wobble);
  int sum;

  mi_vector_div(&p, size);
  if (wobble != 0) {
    miVector at = p;
    mi_vector_mul(&at, 4.0f);
    p.x += wobble * (mi_noise_3d(&at) - 0.5f);
    at.x += 17.0f;
    p.y += wobble * (mi_noise_3d(&at) - 0.5f);
  }
  sum = (int)floor(p.x) + (int)floor(p.y) + (int)floor(p.z);

  /* Only one of the two is evaluated: what is connected to the other costs nothing. */
  *result = *mi_eval_color(sum % 2 == 0 ? &paras->even : &paras->odd);
  return miTRUE;
}
