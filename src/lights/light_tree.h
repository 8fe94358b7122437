// SPDX-License-Identifier: Apache-2.0
// The light tree: picks one of many lights by its importance at a point, and finds the lights whose
// bounds a ray hits.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"
#include "geom/mesh.h"

namespace oriel {

class PortalTable;

/// Directions within an angle of an axis.
struct DirectionCone {
  Vec3 axis{0, 0, 1};
  float cosine = -1;  ///< of the half-angle; -1 = all directions
  bool all() const { return cosine <= -1; }
};

/// The smallest cone that holds both, nearly.
DirectionCone joined(const DirectionCone& a, const DirectionCone& b);

/// A rectangle around portals of one plane whose environment is too uneven to be weighed by its
/// mean.
struct Opening {
  const PortalTable* table = nullptr;  ///< null: the mean is used
  // Along the table's axes, world.
  float x0 = 0, x1 = 0, y0 = 0, y1 = 0, z = 0;
  float scale = 1;  ///< of the table's luminance
};

/// Position, directions and strength of a light, without its shader.
struct LightBounds {
  geom::Box3 box;         ///< around the shape, world
  DirectionCone normals;  ///< of the emitting surface, or axes of cones
  float cos_reach = -1;   ///< of the largest angle to these at which it emits; -1 = any
  /// Share of the strength with which a flat surface emits behind it as well, where cos_reach is 0.
  float behind = 0;
  /// A flat surface lies within this distance of the plane through the middle of the box; infinity
  /// where it is not flat.
  float thickness = std::numeric_limits<float>::infinity();
  // Irradiance facing it at distance d: even + falling / d^2.
  float even = 0, falling = 0;
  Opening opening;
};

/// Bounds of both lights.
LightBounds joined(const LightBounds& a, const LightBounds& b);

/// A point to light.
struct LitPoint {
  Vec3 position{0};
  /// Unit; lights entirely behind its plane do not light the point. Null: lit from both sides.
  Vec3 normal{0};
};

/// A tree of lights, split so that lights of similar position and direction share a node.
///
/// Model:   each step descends into one of up to eight children, with a probability proportional to
///          its importance: an estimate of the irradiance from what its bounds hold, 0 only where
///          it cannot be lit. Depth and cost grow with the logarithm of the number of lights.
///          The cosines at the light and at the point are estimated means over the box and the cone
///          of normals, not their largest values.
/// Source:  Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree
///          Splitting", Proc. ACM CGIT 1(2), 2018, eq. 3, without visibility; 4.4 (cost of a split
///          by power, area and orientation). Eight children by joining levels of a binary tree.
/// Checked: LightTree.* (probabilities sum to one, choices follow them, lights that light a point
///          have one above 0).
class LightTree {
 public:
  LightTree() = default;
  /// Inputs:  names[i]: the number that identifies light i in results, below 2^31.
  LightTree(std::span<const LightBounds> bounds, std::span<const int> names);

  bool empty() const { return nodes_.empty(); }

  struct Choice {
    int light;
    float probability;
  };
  /// A node and all that is below it, or a light.
  using Part = std::int32_t;
  static constexpr Part kWhole = 0;
  /// Inputs:  u: uniform in [0,1); returns a new uniform number; part: one of those below it.
  std::optional<Choice> choose(const LitPoint& lit, float& u, Part part = kWhole) const;
  /// Probability with which choose() returns that light; 0 for lights of other trees.
  float probability(const LitPoint& lit, int light) const {
    return probability_of(lit, ~light, kWhole);
  }
  /// Probability with which choose() of a part gets to a part below it; 0 if that is not below it.
  float probability_of(const LitPoint& lit, Part part, Part of) const;
  /// At most `most` parts that hold all lights, divided where lights are strong and far apart.
  std::vector<Part> parts(std::size_t most) const;
  /// Calls f(light) for each light of a part.
  template <class F>
  void for_each_light(Part part, F&& f) const;

  /// Calls f(light) for each light whose box a ray hits within (0, t_most). `direction` need not
  /// be unit.
  template <class F>
  void for_each_on_way(const Vec3& from, const Vec3& direction, float t_most, F&& f) const;

 private:
  static constexpr int kWidth = 8;
  using Lanes = float __attribute__((vector_size(kWidth * sizeof(float))));
  /// A child of a node.
  struct Place {
    std::int32_t node = -1, lane = 0;
  };
  /// The bounds of up to eight children, one in each lane; lanes without a child have no strength.
  struct Node {
    Lanes x, y, z, radius2;  ///< of the sphere around the box
    Lanes axis_x, axis_y, axis_z, cosine, sine, cos_reach, behind, thickness;
    Lanes even, falling;
    std::array<Part, kWidth> child;  ///< a node, or ~light
    std::array<geom::Box3, kWidth> boxes;
    int count = 0;
    int openings = -1;  ///< place in openings_ of eight, if a child has one
    bool any_behind = false;
    Place parent;
  };
  struct Build;
  Place place_of(Part part) const;
  Lanes importances(const Node& node, const LitPoint& lit) const;
  static bool crosses(const geom::Box3& box, const Vec3& from, const Vec3& inverse, float t_most);

  std::vector<Node> nodes_;
  std::vector<Opening> openings_;
  std::vector<Place> places_;  ///< by name; no node if it is not in this tree
};

template <class F>
void LightTree::for_each_light(Part part, F&& f) const {
  if (part < 0) {
    f(~part);
    return;
  }
  const Node& node = nodes_[static_cast<std::size_t>(part)];
  for (int k = 0; k < node.count; ++k) for_each_light(node.child[static_cast<std::size_t>(k)], f);
}

template <class F>
void LightTree::for_each_on_way(const Vec3& from, const Vec3& direction, float t_most,
                                F&& f) const {
  if (nodes_.empty()) return;
  const Vec3 inverse(1 / direction.x, 1 / direction.y, 1 / direction.z);
  Place at{0, 0};
  // Without a stack: a node that is done is left to its parent.
  while (at.node >= 0) {
    const Node& node = nodes_[static_cast<std::size_t>(at.node)];
    if (at.lane == node.count) {
      at = {node.parent.node, node.parent.lane + 1};
      continue;
    }
    const auto lane = static_cast<std::size_t>(at.lane);
    const std::int32_t child = node.child[lane];
    const bool met = crosses(node.boxes[lane], from, inverse, t_most);
    if (met && child >= 0) {
      at = {child, 0};
      continue;
    }
    if (met) f(~child);
    ++at.lane;
  }
}

}  // namespace oriel
