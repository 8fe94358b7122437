// SPDX-License-Identifier: Apache-2.0
// Vector and matrix arithmetic.
#ifndef ORIEL_SDK_VECTOR_H
#define ORIEL_SDK_VECTOR_H

// Conventions
//   The macros take pointers to anything with x, y, z and evaluate them several times. _normalize
//   and _div are statements, the others expressions. Matrices: p' = p * M, see types.h.

#include <string.h>

#include "types.h"

/// r = -r
#define mi_vector_neg(r) ((r)->x = -(r)->x, (r)->y = -(r)->y, (r)->z = -(r)->z)
/// r = a + b
#define mi_vector_add(r, a, b) \
  ((r)->x = (a)->x + (b)->x, (r)->y = (a)->y + (b)->y, (r)->z = (a)->z + (b)->z)
/// r = a - b
#define mi_vector_sub(r, a, b) \
  ((r)->x = (a)->x - (b)->x, (r)->y = (a)->y - (b)->y, (r)->z = (a)->z - (b)->z)
/// r = r * f
#define mi_vector_mul(r, f) ((r)->x *= (f), (r)->y *= (f), (r)->z *= (f))
/// r = r / f; no effect if f = 0.
#define mi_vector_div(r, f)                                  \
  do {                                                       \
    const miScalar mi_divisor_ = (miScalar)(f);              \
    if (mi_divisor_ != 0) {                                  \
      const miScalar mi_factor_ = (miScalar)1 / mi_divisor_; \
      mi_vector_mul(r, mi_factor_);                          \
    }                                                        \
  } while (0)
/// r = a x b; r must be neither a nor b.
#define mi_vector_prod(r, a, b)                                                            \
  ((r)->x = (a)->y * (b)->z - (a)->z * (b)->y, (r)->y = (a)->z * (b)->x - (a)->x * (b)->z, \
   (r)->z = (a)->x * (b)->y - (a)->y * (b)->x)
/// a . b
#define mi_vector_dot(a, b) ((a)->x * (b)->x + (a)->y * (b)->y + (a)->z * (b)->z)
/// Length of r.
#define mi_vector_norm(r) ((miScalar)MI_SQRT(mi_vector_dot(r, r)))
/// Normalises r; a null vector is unchanged.
#define mi_vector_normalize(r)                   \
  do {                                           \
    const miScalar mi_norm_ = mi_vector_norm(r); \
    mi_vector_div(r, mi_norm_);                  \
  } while (0)
/// Minimum per component.
#define mi_vector_min(r, a, b)                                                             \
  ((r)->x = (a)->x < (b)->x ? (a)->x : (b)->x, (r)->y = (a)->y < (b)->y ? (a)->y : (b)->y, \
   (r)->z = (a)->z < (b)->z ? (a)->z : (b)->z)
/// Maximum per component.
#define mi_vector_max(r, a, b)                                                             \
  ((r)->x = (a)->x > (b)->x ? (a)->x : (b)->x, (r)->y = (a)->y > (b)->y ? (a)->y : (b)->y, \
   (r)->z = (a)->z > (b)->z ? (a)->z : (b)->z)
/// Determinant of the rows a, b, c: a . (b x c).
#define mi_vector_det(a, b, c)                                                                   \
  ((a)->x * ((b)->y * (c)->z - (b)->z * (c)->y) + (a)->y * ((b)->z * (c)->x - (b)->x * (c)->z) + \
   (a)->z * ((b)->x * (c)->y - (b)->y * (c)->x))
/// Distance of a and b.
#define mi_vector_dist(a, b)                                 \
  ((miScalar)MI_SQRT(((a)->x - (b)->x) * ((a)->x - (b)->x) + \
                     ((a)->y - (b)->y) * ((a)->y - (b)->y) + \
                     ((a)->z - (b)->z) * ((a)->z - (b)->z)))

/// a . b in double.
#define mi_vector_dot_d(a, b)                                          \
  ((double)(a)->x * (double)(b)->x + (double)(a)->y * (double)(b)->y + \
   (double)(a)->z * (double)(b)->z)
/// Length of r in double.
#define mi_vector_norm_d(r) (sqrt(mi_vector_dot_d(r, r)))
/// r = r / f computed in double; no effect if f = 0.
#define mi_vector_div_d(r, f)                        \
  do {                                               \
    const double mi_divisor_d_ = (double)(f);        \
    if (mi_divisor_d_ != 0) {                        \
      const double mi_factor_d_ = 1 / mi_divisor_d_; \
      mi_vector_mul(r, mi_factor_d_);                \
    }                                                \
  } while (0)
/// Normalises r in double; a null vector is unchanged.
#define mi_vector_normalize_d(r)                   \
  do {                                             \
    const double mi_norm_d_ = mi_vector_norm_d(r); \
    mi_vector_div_d(r, mi_norm_d_);                \
  } while (0)

/// m = 0
#define mi_matrix_null(m) ((void)memset((m), 0, sizeof(miMatrix)))
/// t = s
#define mi_matrix_copy(t, s) ((void)memcpy((t), (s), sizeof(miMatrix)))

#ifdef __cplusplus
extern "C" {
#endif

/// m = identity.
void mi_matrix_ident(miMatrix m);
/// r = a * b; r may be a or b.
void mi_matrix_prod(miMatrix r, const miMatrix a, const miMatrix b);
/// Whether m is the identity.
miBoolean mi_matrix_isident(const miMatrix m);
/// Whether all of m is 0.
miBoolean mi_matrix_isnull(const miMatrix m);
/// Determinant of the upper left 3 x 3.
float mi_matrix_rot_det(const miMatrix m);
/// r = inverse of m; r may be m. miFALSE if m is singular.
miBoolean mi_matrix_invert(miMatrix r, const miMatrix m);
/// m = rotation by x, y, z radians about the axes, in this order.
void mi_matrix_rotate(miMatrix m, miScalar x, miScalar y, miScalar z);
/// m = rotation by `angle` radians about `axis`, which need not be normalised.
void mi_matrix_rotate_axis(miMatrix m, const miVector* axis, miScalar angle);
/// Solves a * x = b: a is 4x4, x and b are 4 rows of n columns; miFALSE if a is singular.
miBoolean mi_matrix_solve(miScalar* x, const miScalar* a, const miScalar* b, int n);
/// r = point p transformed by m; r may be p.
void mi_point_transform(miVector* r, const miVector* p, const miMatrix m);
/// r = vector v transformed by m without its translation; r may be v.
void mi_vector_transform(miVector* r, const miVector* v, const miMatrix m);
/// r = v transformed by the transpose of the upper 3 x 3 of m (for normals, with m the inverse); r
/// may be v.
void mi_vector_transform_T(miVector* r, const miVector* v, const miMatrix m);

#ifdef __cplusplus
}
#endif

#endif
