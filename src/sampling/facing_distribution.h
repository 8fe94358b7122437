// SPDX-License-Identifier: Apache-2.0
// Directions in proportion to a table and to the cosine at a surface.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"

namespace oriel::sampling {

/// Distributions over an octahedral square of directions, one for each way that a surface may face.
///
/// Model:   normals are rounded to 98 directions, on a cube with 5 x 5 points on each side: those
///          along and between the axes are exact. Blocks of cells are chosen in proportion to their
///          sum times a cosine lobe around the rounded normal, and cells in proportion to their
///          value. The cosine lobe reaches a little behind the surface, since the exact normal
///          differs from the rounded one.
/// Inputs:  values, row after row, side x side, a power of two; negative and non-finite ones count
///          as 0, and a table of zeros is uniform. Normals are unit, or null for points that are
///          lit from everywhere.
/// Checked: FacingDistribution.*
class FacingDistribution {
 public:
  FacingDistribution() : FacingDistribution(std::vector<float>{1.0f}, 1) {}
  FacingDistribution(std::span<const float> values, std::size_t side);

  struct Sample {
    Vec2 uv;
    float pdf;          ///< with respect to area in [0,1)^2
    std::size_t index;  ///< cell of uv, row after row
  };
  Sample sample(const Vec3& normal, const Vec2& u) const;
  float pdf(const Vec3& normal, std::size_t cell) const;
  /// The cell of a point.
  std::size_t cell(const Vec2& uv) const;

 private:
  std::size_t side() const { return std::size_t{1} << side_bits_; }

  /// Distributions over squares of count x count, one after the other. Sums of a square lie side by
  /// side, so that a sample reads few lines of memory.
  class Squares {
   public:
    struct Choice {
      std::size_t x = 0, y = 0;
      Vec2 inside;  ///< uniform in [0,1)^2
      float pdf = 0;
    };
    Squares() = default;
    Squares(std::size_t count, std::size_t squares)
        : count_(count), sums_((count + 1) * (count + 1) * squares) {}
    /// Returns the mean of the values.
    double set(std::size_t square, std::span<const float> values);
    Choice choose(std::size_t square, const Vec2& u) const;
    float pdf(std::size_t square, std::size_t x, std::size_t y) const;

   private:
    // Of each square: those of the rows, then those within each row, from 0 to 1.
    std::span<float> sums_of(std::size_t square, std::size_t i) {
      return std::span(sums_).subspan(row_of(square, i), count_ + 1);
    }
    std::size_t row_of(std::size_t square, std::size_t i) const {
      return (square * (count_ + 1) + i) * (count_ + 1);
    }
    std::size_t count_ = 1;
    std::vector<float> sums_;
  };

  // Cells along the square and along a block, as powers of two.
  unsigned side_bits_ = 0, cell_bits_ = 0;
  Squares facing_;  // of blocks, for each rounded normal
  Squares within_;  // of cells, for each block
};

}  // namespace oriel::sampling
