// SPDX-License-Identifier: Apache-2.0
// Which of many lights matter at a point: one of them by chance, and all that a ray may meet.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"
#include "geom/mesh.h"

namespace oriel {

struct Light;
struct World;
class PortalTable;

/// Directions within an angle of an axis.
struct DirectionCone {
  Vec3 axis{0, 0, 1};
  float cosine = -1;  ///< of the half-angle; -1 = all directions
  bool all() const { return cosine <= -1; }
};

/// The smallest cone that holds both, nearly.
DirectionCone joined(const DirectionCone& a, const DirectionCone& b);

/// A rectangle about portals of one plane, where what is behind is too uneven to go by its mean.
struct Opening {
  const PortalTable* table = nullptr;  ///< null: go by the mean
  // Along the table's axes, world.
  float x0 = 0, x1 = 0, y0 = 0, y1 = 0, z = 0;
  float scale = 1;  ///< of the table's luminance
};

/// Where a light is, where it shines to and how much, without asking its shader again.
struct LightBounds {
  geom::Box3 box;         ///< about the shape, world
  DirectionCone normals;  ///< of the emitting surface, or axes of cones
  float cos_reach = -1;   ///< how far from these it shines; -1 = everywhere
  // Irradiance facing it at distance d: even + falling / d^2.
  float even = 0, falling = 0;
  Opening opening;
};

/// Of two lights taken for one.
LightBounds joined(const LightBounds& a, const LightBounds& b);

/// Where light is asked for.
struct LitPoint {
  Vec3 position{0};
  /// Unit; lights wholly behind its plane bring nothing. Null: lit from everywhere.
  Vec3 normal{0};
};

/// An estimate of the irradiance from what the bounds hold; 0 only where it cannot be lit.
/// Source:  Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree
///          Splitting", Proc. ACM CGIT 1(2), 2018, eq. 3, without visibility.
float importance(const LightBounds& bounds, const LitPoint& lit);

/// A binary tree of lights, split so that near, alike and weak lights stand together.
///
/// Model:   descends by the importance of both sides, so that a light is chosen with the product of
///          the shares on the way to it; depth and cost grow with the logarithm of the number.
/// Source:  as above, 4.4 (cost of a split by power, area and orientation).
/// Checked: LightTree.* (chances sum to one, choices follow them, no light that counts has none).
class LightTree {
 public:
  LightTree() = default;
  /// Inputs:  names[i]: what light i is called in answers, any number below 2^31.
  LightTree(std::span<const LightBounds> bounds, std::span<const int> names);

  bool empty() const { return nodes_.empty(); }
  int size() const { return static_cast<int>(names_.size()); }
  const std::vector<int>& names() const { return names_; }

  struct Choice {
    int light;
    float probability;
  };
  /// Inputs:  u: uniform in [0,1); becomes a number to use again.
  std::optional<Choice> choose(const LitPoint& lit, float& u) const;
  /// With which choose() finds that light; 0 for lights of other trees.
  float probability(const LitPoint& lit, int light) const;

  /// Calls f(light) for each whose box a ray meets within (0, t_most). `direction` need not be
  /// unit.
  template <class F>
  void for_each_on_way(const Vec3& from, const Vec3& direction, float t_most, F&& f) const;

 private:
  struct Node : LightBounds {
    int second = 0;  ///< index of the second child; the first stands behind the node
    int light = -1;  ///< of a leaf
  };
  struct Build;
  static bool crosses(const Node& node, const Vec3& from, const Vec3& inverse, float t_most);

  static constexpr int kDeepest = 64;
  std::vector<Node> nodes_;
  std::vector<int> names_;
  std::vector<std::uint64_t> ways_;  ///< by name: bit d = second child at depth d
  std::vector<std::uint8_t> known_;  ///< by name: whether it is in this tree
};

/// The bounds of a light, its shader asked at a few points. Portals: by the mean of what is behind.
/// Inputs:  reach: about the radius of the scene.
/// Errors:  lights that show nothing there have both strengths 0.
LightBounds bounds_of(const Light& light, const World& world, float reach);

/// The lights of a scene by the way they are chosen.
struct LightGroups {
  std::vector<int> infinite;  ///< without a place
  LightTree finite;           ///< with one
  LightTree portals;
};
LightGroups group_lights(const World& world);

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
