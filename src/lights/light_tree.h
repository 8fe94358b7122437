// SPDX-License-Identifier: Apache-2.0
// The light tree: picks one of many lights by its importance at a point, and finds the lights whose
// bounds a ray hits.
#pragma once

#include <cstdint>
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

/// An estimate of the irradiance from what the bounds hold; 0 only where it cannot be lit.
/// Source:  Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree
///          Splitting", Proc. ACM CGIT 1(2), 2018, eq. 3, without visibility.
float importance(const LightBounds& bounds, const LitPoint& lit);

/// A binary tree of lights, split so that lights of similar position and direction share a node.
///
/// Model:   each step descends into one child, with a probability proportional to its importance;
///          depth and cost grow with the logarithm of the number of lights.
/// Source:  as above, 4.4 (cost of a split by power, area and orientation).
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
  /// Inputs:  u: uniform in [0,1); returns a new uniform number.
  std::optional<Choice> choose(const LitPoint& lit, float& u) const;
  /// Probability with which choose() returns that light; 0 for lights of other trees.
  float probability(const LitPoint& lit, int light) const;

  /// Calls f(light) for each light whose box a ray hits within (0, t_most). `direction` need not
  /// be unit.
  template <class F>
  void for_each_on_way(const Vec3& from, const Vec3& direction, float t_most, F&& f) const;

 private:
  struct Node : LightBounds {
    int second = 0;  ///< index of the second child; the first follows the node
    int light = -1;  ///< of a leaf
  };
  struct Build;
  static bool crosses(const Node& node, const Vec3& from, const Vec3& inverse, float t_most);

  static constexpr int kDeepest = 64;
  std::vector<Node> nodes_;
  std::vector<std::uint64_t> ways_;  ///< by name: bit d = second child at depth d
  std::vector<std::uint8_t> known_;  ///< by name: whether it is in this tree
};

template <class F>
void LightTree::for_each_on_way(const Vec3& from, const Vec3& direction, float t_most,
                                F&& f) const {
  if (nodes_.empty()) return;
  const Vec3 inverse(1 / direction.x, 1 / direction.y, 1 / direction.z);
  int waiting[kDeepest + 1];
  int count = 0, at = 0;
  while (true) {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    const bool met = crosses(node, from, inverse, t_most);
    if (met && node.light < 0) {
      waiting[count++] = node.second;
      ++at;
      continue;
    }
    if (met) f(node.light);
    if (count == 0) return;
    at = waiting[--count];
  }
}

}  // namespace oriel
