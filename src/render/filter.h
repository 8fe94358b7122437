// SPDX-License-Identifier: Apache-2.0
// Where in and around a pixel its samples fall, so that their plain mean is the filtered picture.
#pragma once

#include "base/vec.h"
#include "sampling/distribution.h"
#include "scene/render_options.h"

namespace oriel {

/// Value of a pixel filter, not normalised.
///
/// Model:   box 1; triangle 1 - |t|; gauss with a standard deviation of a sixth of the width, less
///          its value at the end so that it closes; mitchell B = C = 1/3; lanczos with two lobes.
///          The widths that a scene leaves out (1, 2, 3, 4, 4) give the textbook filters.
/// Inputs:  t: offset from the pixel's centre over half the width, -1...1; 0 is returned outside.
/// Source:  D. Mitchell, A. Netravali, "Reconstruction Filters in Computer Graphics", SIGGRAPH
///          1988; C. Duchon, "Lanczos Filtering in One and Two Dimensions", J. Appl. Meteor. 1979.
float filter_value(scene::FilterKind kind, float t);

/// Draws sample positions in proportion to the magnitude of a filter.
///
/// Model:   a sample belongs to one pixel alone, so pixels are independent of each other: any
///          thread may render any of them, and each may stop at its own number of samples. Filters
///          are separable. Where the filter is negative the sample is marked, and the pixel is
///          positive_share() x mean of plain samples - negative_share() x mean of marked ones.
/// Source:  M. Ernst, M. Stamminger, G. Greiner, "Filter Importance Sampling", RT 2006.
/// Checked: Filter.* in filter_test.cpp
class FilterSampler {
 public:
  explicit FilterSampler(const scene::PixelFilter& filter);

  struct Offset {
    Vec2 pixels{0};  ///< from the pixel's centre
    bool negative = false;
  };
  Offset sample(Vec2 u) const;

  /// Farthest that samples lie from the pixel's centre, pixels.
  Vec2 half_width() const { return half_width_; }
  bool has_negative_lobes() const { return negative_share_ > 0; }
  /// Integrals of the positive and of the negative part; their difference is 1.
  float positive_share() const { return positive_share_; }
  float negative_share() const { return negative_share_; }
  /// The clip variants: results below 0 become 0.
  bool clips() const { return clips_; }

 private:
  struct Axis {
    float t;
    bool negative;
  };
  Axis sample_axis(float u) const;

  scene::FilterKind kind_;
  Vec2 half_width_;
  sampling::Distribution1D magnitude_;  ///< of the tabulated shapes, over t
  float positive_share_ = 1, negative_share_ = 0;
  bool clips_ = false;
};

}  // namespace oriel
