// SPDX-License-Identifier: Apache-2.0
// Openings of rooms, through which the environment is sampled where the scene has no portals.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "lights/light_tree.h"
#include "lights/portal_table.h"
#include "sampling/rectangle.h"

namespace oriel {

/// A rectangle through which the environment lights a room.
struct OpeningRectangle {
  Vec3 corner{0}, edge_u{0}, edge_v{0};  ///< perpendicular edges, world
  Vec3 inward{0, 0, 1};                  ///< unit normal on the side of the room
  /// The environment behind it, with axes along the edges and against `inward`; null = even.
  std::shared_ptr<const PortalTable> table = nullptr;
  // Set by Openings.
  sampling::RectangleAxes axes = {};  ///< of the edges
  Vec3 centre{0};
  float area = 0, power = 0;  ///< power: area times mean luminance behind it
};

/// The rectangles of a scene's geometry, whatever its environment: without tables. Null = not
/// searched.
using OpeningSearch = std::shared_ptr<const std::vector<OpeningRectangle>>;

/// Densities of directions through rectangles. They only propose directions: the environment is
/// seen through everything else as well, by samples of its own and by rays of lobes.
///
/// Model:   a rectangle in proportion to an estimate of its irradiance, then a direction through it
///          as through a portal: by its table, or uniform in solid angle. The density of a
///          direction is the sum over all rectangles.
/// Checked: Openings.DensityMatchesTheSamples
class Openings {
 public:
  Openings() = default;
  explicit Openings(std::vector<OpeningRectangle> rectangles);
  Openings(std::vector<OpeningRectangle> rectangles, OpeningSearch found)
      : Openings(std::move(rectangles)) {
    found_ = std::move(found);
  }

  /// Maximum number of rectangles.
  static constexpr std::size_t kMax = 16;
  bool empty() const { return rectangles_.empty(); }
  const std::vector<OpeningRectangle>& rectangles() const { return rectangles_; }
  /// What find_openings() found.
  const OpeningSearch& found() const { return found_; }

  /// Estimated irradiance of all rectangles at the point; 0 if none lights it.
  float total(const LitPoint& lit) const;
  struct Sample {
    Vec3 wi{0, 0, 1};
    float pdf = 0;  ///< per solid angle
  };
  /// Inputs:  total: of that point, above 0. u: uniform in [0,1)^2.
  std::optional<Sample> sample(const LitPoint& lit, float total, Vec2 u) const;
  float pdf(const LitPoint& lit, float total, const Vec3& wi) const;

 private:
  float share(const OpeningRectangle& rectangle, const LitPoint& lit) const;
  /// share() times the density of the direction among those through the rectangle; 0 if it misses.
  float density(const OpeningRectangle& rectangle, const LitPoint& lit, const Vec3& wi) const;

  std::vector<OpeningRectangle> rectangles_;
  OpeningSearch found_;
};

}  // namespace oriel
