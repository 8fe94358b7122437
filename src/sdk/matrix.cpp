// SPDX-License-Identifier: Apache-2.0
// Matrix functions of shaders: product, inverse, rotation, linear equations, transforms.
#include <algorithm>
#include <span>

#include "base/linear_system.h"
#include "oriel/sdk/shader/vector.h"

namespace {

constexpr int kSide = 4;

std::span<const float, 16> rows_of(const miScalar* m) { return std::span<const float, 16>(m, 16); }

}  // namespace

void mi_matrix_ident(miMatrix m) {
  for (int i = 0; i < 16; ++i) m[i] = i % 5 == 0 ? 1.0f : 0.0f;
}

void mi_matrix_prod(miMatrix r, const miMatrix a, const miMatrix b) {
  miMatrix product;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j)
      product[i * 4 + j] = a[i * 4] * b[j] + a[i * 4 + 1] * b[4 + j] + a[i * 4 + 2] * b[8 + j] +
                           a[i * 4 + 3] * b[12 + j];
  mi_matrix_copy(r, product);
}

miBoolean mi_matrix_isident(const miMatrix m) {
  for (int i = 0; i < 16; ++i)
    if (m[i] != (i % 5 == 0 ? 1.0f : 0.0f)) return miFALSE;
  return miTRUE;
}

miBoolean mi_matrix_isnull(const miMatrix m) {
  return std::all_of(m, m + 16, [](miScalar v) { return v == 0; }) ? miTRUE : miFALSE;
}

float mi_matrix_rot_det(const miMatrix m) {
  return m[0] * (m[5] * m[10] - m[6] * m[9]) + m[1] * (m[6] * m[8] - m[4] * m[10]) +
         m[2] * (m[4] * m[9] - m[5] * m[8]);
}

miBoolean mi_matrix_invert(miMatrix r, const miMatrix m) {
  return oriel::invert_exactly(rows_of(m), r) ? miTRUE : miFALSE;
}

void mi_matrix_rotate(miMatrix m, miScalar x, miScalar y, miScalar z) {
  const miVector axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  miMatrix next;
  mi_matrix_rotate_axis(m, &axes[0], x);
  mi_matrix_rotate_axis(next, &axes[1], y);
  mi_matrix_prod(m, m, next);
  mi_matrix_rotate_axis(next, &axes[2], z);
  mi_matrix_prod(m, m, next);
}

void mi_matrix_rotate_axis(miMatrix m, const miVector* axis, miScalar angle) {
  miVector a = *axis;
  mi_vector_normalize_d(&a);
  const oriel::Mat4 rotation = oriel::rotation_about(oriel::Vec3(a.x, a.y, a.z), angle);
  std::copy_n(rotation.getValue(), 16, m);
}

// n = 4 means a 4 x 4 matrix: a is a miMatrix, and b and x have four rows of n columns. Two public
// baking shaders use the function in this way.
miBoolean mi_matrix_solve(miScalar* x, const miScalar* a, const miScalar* b, int n) {
  return oriel::solve_linear_system(rows_of(a), b, n, x) ? miTRUE : miFALSE;
}

void mi_point_transform(miVector* r, const miVector* p, const miMatrix m) {
  const miVector from = *p;
  mi_vector_transform(r, &from, m);
  r->x += m[12];
  r->y += m[13];
  r->z += m[14];
  // The projective component; 1 for affine matrices.
  const miScalar w = from.x * m[3] + from.y * m[7] + from.z * m[11] + m[15];
  if (w != 1) mi_vector_div(r, w);
}

void mi_vector_transform(miVector* r, const miVector* v, const miMatrix m) {
  const miVector from = *v;
  r->x = from.x * m[0] + from.y * m[4] + from.z * m[8];
  r->y = from.x * m[1] + from.y * m[5] + from.z * m[9];
  r->z = from.x * m[2] + from.y * m[6] + from.z * m[10];
}

void mi_vector_transform_T(miVector* r, const miVector* v, const miMatrix m) {
  const miVector from = *v;
  r->x = from.x * m[0] + from.y * m[1] + from.z * m[2];
  r->y = from.x * m[4] + from.y * m[5] + from.z * m[6];
  r->z = from.x * m[8] + from.y * m[9] + from.z * m[10];
}
