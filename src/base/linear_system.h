// SPDX-License-Identifier: Apache-2.0
// Linear systems of four equations.
#pragma once

#include <span>

#include "base/vec.h"

namespace oriel {

/// Solves rows * x = right for any number of right sides.
///
/// Model:   Gauss and Jordan's elimination with row pivoting, rows scaled to one size first: a
///          small scale beside a distant translation is not singular.
/// Inputs:  rows: 16 numbers, a row after the other; right: four rows of `columns` numbers.
/// Returns: false, with x incomplete, where the matrix is singular. x may be right or rows.
/// Checked: LinearSystem.*
bool solve_linear_system(std::span<const float, 16> rows, const float* right, int columns,
                         float* x);

/// The inverse of a matrix by the same elimination: it serves scales that Mat4::inverse(), in
/// float, does not.
bool invert_exactly(std::span<const float, 16> rows, float* inverse);

/// The rotation about an axis, a positive angle turning x to y about z; for row vectors. The
/// identity for a null axis.
/// Source:  Rodrigues, 1840, transposed.
/// Inputs:  axis: unit or null; angle: radians.
Mat4 rotation_about(const Vec3& axis, float angle);

}  // namespace oriel
