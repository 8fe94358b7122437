// SPDX-License-Identifier: Apache-2.0
// Sampling of tabulated distributions: 1D (lights) and 2D (environment maps).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace oriel::sampling {

// Conventions
//   The table covers [0,1) (or [0,1)^2, row 0 at v = 0) with equal cells of constant value.
//   Densities are with respect to that unit domain; the caller applies the Jacobian of its own
//   mapping.
//   Negative and non-finite entries count as 0; a table of zeros is uniform.

/// Piecewise constant distribution over [0,1).
///
/// Errors:  none, except that a table must have at least one cell (assertion).
/// Checked: Distribution1D.SamplesMatchTheTable, Distribution1D.NeverPicksAnEmptyCell.
class Distribution1D {
 public:
  struct Sample {
    float x;            ///< in [0,1)
    float pdf;          ///< with respect to x
    std::size_t index;  ///< cell of x
  };
  struct Choice {
    std::size_t index;
    float pmf;  ///< probability of this cell
    float u;    ///< position in the cell, uniform in [0,1) and reusable as a random number
  };

  Distribution1D() : Distribution1D(std::vector<float>{1.0f}) {}
  explicit Distribution1D(std::span<const float> values);

  std::size_t size() const { return values_.size(); }
  /// Mean of the table: the integral over [0,1).
  float integral() const { return integral_; }

  Sample sample(float u) const;
  Choice choose(float u) const;
  float pdf(float x) const;
  float pmf(std::size_t index) const {
    return values_[index] * inverse_integral_ / static_cast<float>(values_.size());
  }

 private:
  std::vector<float> values_;
  std::vector<float> cdf_;            // size() + 1 entries from 0 to exactly 1
  std::vector<std::uint32_t> guide_;  // the cell of each multiple of 1 / size()
  float integral_ = 0;
  float inverse_integral_ = 0;
};

/// Piecewise constant distribution over [0,1)^2: samples a row by its sum, then a cell in the row.
///
/// Inputs:  values, row after row, width x height.
/// Checked: Distribution2D.SamplesMatchTheTable, Distribution2D.PdfIntegratesToOne.
class Distribution2D {
 public:
  struct Sample {
    Vec2 uv;
    float pdf;          ///< with respect to area in [0,1)^2
    std::size_t index;  ///< cell of uv
  };

  Distribution2D() : Distribution2D(std::vector<float>{1.0f}, 1, 1) {}
  Distribution2D(std::span<const float> values, std::size_t width, std::size_t height);

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  /// The table, row after row.
  const std::vector<float>& values() const { return values_; }
  /// Mean of the table: the integral over [0,1)^2.
  float integral() const { return integral_; }

  Sample sample(const Vec2& u) const;
  /// The cell of a point, row after row.
  std::size_t cell(const Vec2& uv) const;
  float pdf(std::size_t cell) const { return values_[cell] * inverse_integral_; }
  float pdf(const Vec2& uv) const { return pdf(cell(uv)); }

 private:
  std::size_t width_ = 0, height_ = 0;
  std::vector<float> values_;
  std::vector<float> row_cdf_;                             // height x (width + 1)
  std::vector<float> marginal_;                            // height + 1
  std::vector<std::uint32_t> row_guide_, marginal_guide_;  // as Distribution1D's
  float integral_ = 0;
  float inverse_integral_ = 0;
};

}  // namespace oriel::sampling
