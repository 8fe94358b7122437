/* SPDX-License-Identifier: Apache-2.0 */
/* Vectors and matrices against numbers by hand. */
#include "coverage.h"

static void macros(void) {
  miVector a = make(1, 2, 3), b = make(4, 5, 6), r, nothing = make(0, 0, 0);

  r = a;
  mi_vector_neg(&r);
  COVER(mi_vector_neg, IS(r, -1, -2, -3));
  mi_vector_add(&r, &a, &b);
  COVER(mi_vector_add, IS(r, 5, 7, 9));
  mi_vector_sub(&r, &b, &a);
  COVER(mi_vector_sub, IS(r, 3, 3, 3));
  mi_vector_mul(&r, 2);
  COVER(mi_vector_mul, IS(r, 6, 6, 6));
  mi_vector_div(&r, 3);
  COVER(mi_vector_div, IS(r, 2, 2, 2));
  mi_vector_div(&r, 0);
  COVER(mi_vector_div, IS(r, 2, 2, 2));
  mi_vector_div_d(&r, 4);
  COVER(mi_vector_div_d, IS(r, .5, .5, .5));
  mi_vector_prod(&r, &a, &b);
  COVER(mi_vector_prod, IS(r, -3, 6, -3));
  COVER(mi_vector_dot, NEAR(mi_vector_dot(&a, &b), 32, 0));
  COVER(mi_vector_dot_d, NEAR(mi_vector_dot_d(&a, &b), 32, 0));
  r = make(2, 3, 6);
  COVER(mi_vector_norm, NEAR(mi_vector_norm(&r), 7, 1e-6));
  COVER(mi_vector_norm_d, NEAR(mi_vector_norm_d(&r), 7, 1e-12));
  mi_vector_normalize(&r);
  COVER(mi_vector_normalize, IS(r, 2 / 7., 3 / 7., 6 / 7.));
  mi_vector_normalize(&nothing);
  COVER(mi_vector_normalize, IS(nothing, 0, 0, 0));
  r = make(0, 3, -4);
  mi_vector_normalize_d(&r);
  COVER(mi_vector_normalize_d, IS(r, 0, .6, -.8));
  b = make(4, -5, 6);
  mi_vector_min(&r, &a, &b);
  COVER(mi_vector_min, IS(r, 1, -5, 3));
  mi_vector_max(&r, &a, &b);
  COVER(mi_vector_max, IS(r, 4, 2, 6));
  COVER(mi_vector_dist, NEAR(mi_vector_dist(&a, &b), sqrt(9 + 49 + 9), 1e-5));
  r = make(1, 0, 1);
  /* 1 (-5 - 0) - 2 (4 - 6) + 3 (0 + 5) */
  COVER(mi_vector_det,
        NEAR(mi_vector_det(&a, &b, &r),
             1 * (-5 * 1 - 6 * 0) - 2 * (4 * 1 - 6 * 1) + 3 * (4 * 0 + 5 * 1), 1e-5));
}

static void matrices(void) {
  miMatrix m, n, r;
  miVector v = make(1, 2, 3), z = make(0, 0, 1), p;
  miScalar x[16];
  int i, same = 1;

  mi_matrix_ident(m);
  COVER(mi_matrix_ident, m[0] == 1 && m[1] == 0 && m[5] == 1 && m[15] == 1);
  COVER(mi_matrix_isident, mi_matrix_isident(m));
  mi_matrix_null(n);
  COVER(mi_matrix_null, n[0] == 0 && n[15] == 0);
  COVER(mi_matrix_isnull, mi_matrix_isnull(n) && !mi_matrix_isnull(m) && !mi_matrix_isident(n));

  /* A quarter turn about z takes x to y; rows are what points are multiplied to. */
  mi_matrix_rotate_axis(m, &z, (miScalar)M_PI_2);
  p = make(1, 0, 0);
  mi_vector_transform(&p, &p, m);
  COVER(mi_matrix_rotate_axis, IS(p, 0, 1, 0));
  COVER(mi_vector_transform, IS(p, 0, 1, 0));
  mi_vector_transform_T(&p, &p, m);
  COVER(mi_vector_transform_T, IS(p, 1, 0, 0));
  mi_matrix_rotate(n, 0, 0, (miScalar)M_PI_2);
  for (i = 0; i < 16; i++) same &= NEAR(m[i], n[i], 1e-6);
  COVER(mi_matrix_rotate, same);
  COVER(mi_matrix_rot_det, NEAR(mi_matrix_rot_det(m), 1, 1e-6));

  m[12] = 5;
  m[13] = 6;
  m[14] = 7;
  mi_point_transform(&p, &v, m);
  COVER(mi_point_transform, IS(p, 3, 7, 10));
  mi_matrix_copy(r, m);
  COVER(mi_matrix_copy, memcmp(r, m, sizeof(miMatrix)) == 0);
  COVER(mi_matrix_invert, mi_matrix_invert(n, m));
  mi_point_transform(&p, &p, n);
  COVER(mi_matrix_invert, IS(p, 1, 2, 3));
  mi_matrix_prod(r, m, n);
  for (i = 0, same = 1; i < 16; i++) same &= NEAR(r[i], i % 5 == 0, 1e-5);
  COVER(mi_matrix_prod, same);
  mi_matrix_null(r);
  COVER(mi_matrix_invert, !mi_matrix_invert(n, r));
  /* m x = m has the identity for x. */
  COVER(mi_matrix_solve, mi_matrix_solve(x, m, m, 4));
  for (i = 0, same = 1; i < 16; i++) same &= NEAR(x[i], i % 5 == 0, 1e-5);
  COVER(mi_matrix_solve, same);
}

DLLEXPORT miBoolean cover_vectors(miColor* result, miState* state, void* paras) {
  macros();
  matrices();
  *result = paint(0, 1, 0);
  return miTRUE;
}
