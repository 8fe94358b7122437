// SPDX-License-Identifier: Apache-2.0
// Linear systems of four equations.
#pragma once

#include <span>

#include "base/vec.h"

namespace oriel {

/// Solves rows * x = right for any number of right-hand sides.
///
/// Model:   Gauss-Jordan elimination with row pivoting and row scaling: a small scale with a large
///          translation is not singular.
/// Inputs:  rows: 16 numbers in row-major order; right: four rows of `columns` numbers.
/// Returns: false, with x incomplete, if the matrix is singular. x may alias right or rows.
/// Checked: LinearSystem.*
bool solve_linear_system(std::span<const float, 16> rows, const float* right, int columns,
                         float* x);

/// The inverse by the same elimination, which handles scales for which Mat4::inverse(), in float,
/// fails.
bool invert_exactly(std::span<const float, 16> rows, float* inverse);

/// The rotation about an axis for row vectors; a positive angle about z rotates x to y. The
/// identity for a null axis.
/// Source:  Rodrigues, 1840, transposed.
/// Inputs:  axis: unit or null; angle: radians.
Mat4 rotation_about(const Vec3& axis, float angle);

}  // namespace oriel
