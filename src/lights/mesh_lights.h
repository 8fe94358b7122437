// SPDX-License-Identifier: Apache-2.0
// Emissive triangles as lights: picks one of many by its importance at a point.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lights/light_chances.h"
#include "lights/light_tree.h"

namespace oriel {

/// A triangle of an instance of the world's accel.
struct EmissiveTriangle {
  std::uint32_t instance = 0, primitive = 0;
  float power = 0;  ///< luminance times area, of both sides; above 0
};

/// A tree over clusters of neighbouring triangles, each of which is chosen by its power within its
/// cluster. Few triangles have clusters of their own. For choices that are learned, the tree is
/// divided into parts, about one for each lamp.
///
/// Model:   12 bytes for each triangle, 4 more for each triangle of an instance with emission, and
///          about 200 for each of at most kMaxClusters clusters.
/// Checked: MeshLights.* in mesh_lights_test.cpp; tests/analytic/lights/emission_test.cpp
class MeshLights {
 public:
  static constexpr std::size_t kMaxClusters = 16384, kMaxParts = 64;

  MeshLights() = default;
  /// Inputs:  bounds: of each triangle; instances: how many the accel has, and for those with
  ///          triangles here how many triangles their mesh has, else 0.
  MeshLights(std::vector<EmissiveTriangle> triangles, std::span<const LightBounds> bounds,
             std::span<const std::uint32_t> triangles_of_instance);

  bool empty() const { return shares_.empty(); }
  std::size_t size() const { return shares_.size(); }
  std::size_t clusters() const { return starts_.empty() ? 0 : starts_.size() - 1; }

  struct Choice {
    std::uint32_t instance, primitive;
    float probability;
  };
  /// Inputs:  chances: of parts(), or none; u: uniform in [0,1)^2.
  std::optional<Choice> choose(const LitPoint& lit, const LightChances& chances, Vec2 u) const;
  /// Probability with which choose() returns that triangle; 0 for triangles that are not sampled.
  float probability(const LitPoint& lit, const LightChances& chances, std::uint32_t instance,
                    std::uint32_t primitive) const;

  std::size_t parts() const { return parts_.size(); }
  /// A triangle of a part, with its probability among those of the part.
  std::optional<Choice> choose_of(std::size_t part, const LitPoint& lit, Vec2 u) const;
  /// Probability with which the tree chooses a triangle of the part.
  float probability_of(std::size_t part, const LitPoint& lit) const {
    return tree_.probability_of(lit, parts_[part], LightTree::kWhole);
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;
  struct Share {
    std::uint32_t instance, primitive;
    float until;  ///< of the cluster's power: of the triangles so far, this one included
  };
  float share_of(std::size_t triangle, std::size_t cluster) const;
  float probability_of_cluster(const LitPoint& lit, const LightChances& chances, int cluster) const;
  Choice in_cluster(const LightTree::Choice& cluster, float u) const;

  LightTree tree_;  ///< of clusters
  std::vector<LightTree::Part> parts_;
  std::vector<std::uint8_t> part_of_;  ///< by cluster
  std::vector<Share> shares_;
  std::vector<std::uint32_t> starts_;     ///< by cluster: its first triangle; and the end
  std::vector<std::uint32_t> first_;      ///< by instance: where its numbers begin
  std::vector<std::uint32_t> number_of_;  ///< by triangle of such an instance: index into shares_
};

}  // namespace oriel
