// SPDX-License-Identifier: Apache-2.0
// Densities of directions for diffuse bounces, learned from the light at points of the scene.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/frame.h"
#include "sampling/warp.h"
#include "transport/surface_tree.h"

namespace oriel {

// Conventions
//   Directions above a surface are points of the unit square that sample_cosine_hemisphere() maps
//   to them. A density on the square multiplies cos / pi.

/// Values of the cells of the unit square, row by row.
inline constexpr std::size_t kGuideSide = 16, kGuideCells = kGuideSide * kGuideSide;
using GuideSquare = std::array<float, kGuideCells>;

/// The cell of GuideSquare that contains a point of the square.
std::size_t guide_cell(const Vec2& at);

/// A density on the square that is constant in each cell.
/// Checked: GuideDensity.*
class GuideDensity {
 public:
  /// Inputs:  light: not negative; the density is kUnguided plus a share in proportion to it.
  explicit GuideDensity(const GuideSquare& light);

  /// Share of the samples that are uniform, so that a wrong guide multiplies the noise at most by
  /// its reciprocal. Of .15, .25, .4 and .5, .4 had the smallest error in rooms.
  static constexpr float kUnguided = 0.4f;

  GuideDensity() = default;  ///< to be read
  /// Whether its shares increase to 1.
  bool is_valid() const;

  /// Returns: at least kUnguided; 1 on the average.
  float at(const Vec2& on_square) const;
  /// Maps the uniform `u` to the square with that density, monotonically in each coordinate.
  Vec2 sample(const Vec2& u, float& density) const;

 private:
  // The densities are differences of these shares, which halves the memory that look-ups touch.
  GuideSquare until_;                         ///< share of its row up to the end of each cell
  std::array<float, kGuideSide> rows_until_;  ///< share up to the end of each row
};

/// The guide of one surface point.
class LocalGuide {
 public:
  LocalGuide() = default;
  LocalGuide(const GuideDensity& density, const Frame& frame, const Rgb& light = Rgb(0))
      : density_(&density), frame_(frame), light_(light) {}

  explicit operator bool() const { return density_ != nullptr; }
  /// Density relative to cos / pi. Inputs:  wi: unit, above the surface.
  float density(const Vec3& wi) const {
    return density_->at(sampling::square_of_disc(Vec2(dot(wi, frame_.s), dot(wi, frame_.t))));
  }
  /// Expected radiance of a white Lambert surface here, without light that light samples find.
  const Rgb& light() const { return light_; }
  struct Sample {
    Vec3 wi{0};
    float cosine = 0, density = 0;
  };
  Sample sample(const Vec2& u) const {
    Sample s;
    const Vec3 local = sampling::sample_cosine_hemisphere(density_->sample(u, s.density));
    s.wi = frame_.to_world(local);
    s.cosine = local.z;
    return s;
  }

 private:
  const GuideDensity* density_ = nullptr;
  Frame frame_;
  Rgb light_{0};
};

/// The light that arrives at a point of a surface.
struct GuidePoint {
  Vec3 position{0}, normal{0, 0, 1};
  GuideSquare light{};  ///< mean luminance in each cell, in guide_frame(normal)
  Rgb mean{0};          ///< radiance, mean over the square
  int rays = 1;         ///< that the light was measured with

  /// Averages the light with that of other rays at the same place, each by its rays.
  void add(const GuidePoint& more);
};

/// The frame of all guides of surfaces with that unit normal. It turns smoothly between normals of
/// the same main direction.
Frame guide_frame(const Vec3& normal);

/// Densities for all places of a scene.
///
/// Model:   one for each cell of a SurfaceTree, of the light of its points; the node above counts
///          as a share of a further point.
/// Checked: DirectionGuide.*
class DirectionGuide {
 public:
  DirectionGuide() = default;
  explicit DirectionGuide(std::span<const GuidePoint> points);

  bool empty() const { return tree_.empty(); }
  /// Inputs:  normal: unit. Not for an empty guide.
  LocalGuide at(const Vec3& position, const Vec3& normal) const;
  std::size_t bytes() const {
    return tree_.bytes() + densities_.size() * sizeof(GuideDensity) + light_.size() * sizeof(Rgb);
  }

  /// Writes the guide to a CheckpointWriter, or reads it from a CheckpointReader.
  template <class Checkpoint>
  void visit_state(Checkpoint& checkpoint) {
    tree_.visit_state(checkpoint);
    checkpoint.list(densities_);
    checkpoint.list(light_);
  }
  /// Whether it is a guide; of one that was read.
  bool is_valid() const;

 private:
  SurfaceTree tree_;
  std::vector<GuideDensity> densities_;
  std::vector<Rgb> light_;  ///< GuidePoint::mean by cell
};

}  // namespace oriel
