// SPDX-License-Identifier: Apache-2.0
#include "base/linear_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.h"

namespace oriel {
namespace {

constexpr int kSide = 4;
// double throughout: shaders invert products of scales that exceed the precision of float.
using Rows = double[kSide][kSide];

/// Reduces `a` to the identity by row operations and applies them to the `columns` of b; returns
/// false if a is singular.
bool eliminate(Rows& a, double* b, int columns) {
  // Scale rows first: a matrix with a small scale and a large translation is not singular.
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
    // A pivot that is this small relative to the scaled row is a rounding error.
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

void load(Rows& rows, std::span<const float, 16> m) {
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j)
      rows[i][j] = m[static_cast<std::size_t>(i) * kSide + static_cast<std::size_t>(j)];
}

/// Maximum number of columns that are solved together.
constexpr int kMaxColumns = 16;

}  // namespace

bool solve_linear_system(std::span<const float, 16> rows, const float* right, int columns,
                         float* x) {
  for (int first = 0; first < columns; first += kMaxColumns) {
    const int count = std::min(kMaxColumns, columns - first);
    double part[kSide * kMaxColumns];
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < count; ++j) part[i * count + j] = right[i * columns + first + j];
    Rows work;
    load(work, rows);
    if (!eliminate(work, part, count)) return false;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < count; ++j)
        x[i * columns + first + j] = static_cast<float>(part[i * count + j]);
  }
  return true;
}

bool invert_exactly(std::span<const float, 16> rows, float* inverse) {
  Rows work;
  load(work, rows);
  double right[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  if (!eliminate(work, right, kSide)) return false;
  std::transform(right, right + 16, inverse, [](double v) { return static_cast<float>(v); });
  return true;
}

Mat4 rotation_about(const Vec3& a, float angle) {
  if (dot(a, a) == 0) return {};
  const float s = math::sin(angle), c = math::cos(angle), t = 1 - c;
  return Mat4(t * a.x * a.x + c, t * a.x * a.y + s * a.z, t * a.x * a.z - s * a.y, 0,
              t * a.x * a.y - s * a.z, t * a.y * a.y + c, t * a.y * a.z + s * a.x, 0,
              t * a.x * a.z + s * a.y, t * a.y * a.z - s * a.x, t * a.z * a.z + c, 0, 0, 0, 0, 1);
}

}  // namespace oriel
