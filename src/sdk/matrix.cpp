// SPDX-License-Identifier: Apache-2.0
// Matrices of shaders: product, inverse, rotation, linear equations, transforms.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.h"
#include "oriel/sdk/shader/vector.h"

namespace {

constexpr int kSide = 4;
// double throughout: what shaders invert is often a product of scales that float does not hold.
using Rows = double[kSide][kSide];

/// Brings `a` to the identity by rows and does the same to the `columns` of each row of b; false
/// where a is singular.
bool eliminate(Rows& a, double* b, int columns) {
  // Rows of one size first: a small scale beside a far place is not singular.
  for (int i = 0; i < kSide; ++i) {
    double largest = 0;
    for (const double v : a[i]) largest = std::max(largest, std::abs(v));
    if (!(largest > 0)) return false;
    for (double& v : a[i]) v /= largest;
    for (int j = 0; j < columns; ++j) b[i * columns + j] /= largest;
  }
  for (int k = 0; k < kSide; ++k) {
    int pivot = k;
    for (int i = k + 1; i < kSide; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    // What a scale leaves that is smaller by this than how far away it stands is no number.
    if (!(std::abs(a[pivot][k]) > 1e-13)) return false;
    if (pivot != k) {
      std::swap_ranges(a[k], a[k] + kSide, a[pivot]);
      std::swap_ranges(b + k * columns, b + (k + 1) * columns, b + pivot * columns);
    }
    const double inverse = 1 / a[k][k];
    for (int j = 0; j < kSide; ++j) a[k][j] *= inverse;
    for (int j = 0; j < columns; ++j) b[k * columns + j] *= inverse;
    for (int i = 0; i < kSide; ++i) {
      const double factor = a[i][k];
      if (i == k || factor == 0) continue;
      for (int j = 0; j < kSide; ++j) a[i][j] -= factor * a[k][j];
      for (int j = 0; j < columns; ++j) b[i * columns + j] -= factor * b[k * columns + j];
    }
  }
  return true;
}

void load(Rows& rows, const miScalar* m) {
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) rows[i][j] = m[i * kSide + j];
}

/// Columns of one system that mi_matrix_solve takes at a time.
constexpr int kMostColumns = 16;

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
  Rows rows;
  load(rows, m);
  double inverse[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  if (!eliminate(rows, inverse, kSide)) return miFALSE;
  std::transform(inverse, inverse + 16, r, [](double v) { return static_cast<miScalar>(v); });
  return miTRUE;
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

// Rodrigues' formula, transposed for rows; a positive angle turns x to y about z.
void mi_matrix_rotate_axis(miMatrix m, const miVector* axis, miScalar angle) {
  mi_matrix_ident(m);
  miVector a = *axis;
  mi_vector_normalize_d(&a);
  if (mi_vector_dot(&a, &a) == 0) return;
  const float s = oriel::math::sin(angle), c = oriel::math::cos(angle), t = 1 - c;
  m[0] = t * a.x * a.x + c;
  m[1] = t * a.x * a.y + s * a.z;
  m[2] = t * a.x * a.z - s * a.y;
  m[4] = t * a.x * a.y - s * a.z;
  m[5] = t * a.y * a.y + c;
  m[6] = t * a.y * a.z + s * a.x;
  m[8] = t * a.x * a.z + s * a.y;
  m[9] = t * a.y * a.z - s * a.x;
  m[10] = t * a.z * a.z + c;
}

// Shaders that bake (two independent ones are public) solve for a 4 x 4 matrix with n = 4: a is a
// miMatrix, b and x have four rows of n columns.
miBoolean mi_matrix_solve(miScalar* x, const miScalar* a, const miScalar* b, int n) {
  for (int first = 0; first < n; first += kMostColumns) {
    const int columns = std::min(kMostColumns, n - first);
    double right[kSide * kMostColumns];
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < columns; ++j) right[i * columns + j] = b[i * n + first + j];
    Rows rows;
    load(rows, a);
    if (!eliminate(rows, right, columns)) return miFALSE;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < columns; ++j)
        x[i * n + first + j] = static_cast<miScalar>(right[i * columns + j]);
  }
  return miTRUE;
}

void mi_point_transform(miVector* r, const miVector* p, const miMatrix m) {
  const miVector from = *p;
  mi_vector_transform(r, &from, m);
  r->x += m[12];
  r->y += m[13];
  r->z += m[14];
  // Projections; of all other matrices it is 1.
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
