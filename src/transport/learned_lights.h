// SPDX-License-Identifier: Apache-2.0
// Probabilities of lights for the places of a scene, learned from what reaches points of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lights/light_chances.h"
#include "transport/surface_tree.h"

namespace oriel {

/// Probabilities for each cell of a SurfaceTree.
///
/// Model:   of a light in proportion to the root of the mean square of its samples at the points of
///          the cell, occlusion included; the node above counts as a share of a further point. The
///          light sampler mixes them with its tree, by the share that gives the least noise at the
///          points of the cell, each with probabilities from the other points: where lights reach
///          neighbours differently, as inside and outside of a lampshade, the tree alone.
/// Source:  the idea: P. Vevoda, I. Kondapaneni, J. Krivanek, "Bayesian Online Regression for
///          Adaptive Direct Illumination Sampling", 2018, without its model of unseen lights, which
///          the mixture replaces.
/// Checked: ManyLamps.* in tests/cross_method
class LearnedLights {
 public:
  LearnedLights() = default;
  /// Inputs:  squares: mean square of the samples of each light at each point, point by point, in
  ///          the order of LightSampler::chosen_lights(); by_tree: probability of each light by the
  ///          light tree, likewise.
  LearnedLights(std::span<const SurfaceTree::Point> points, std::span<const float> squares,
                std::span<const float> by_tree);

  bool empty() const { return count_ == 0; }
  std::size_t bytes() const {
    return tree_.bytes() +
           (probability_.size() + until_.size() + unlearned_.size()) * sizeof(float);
  }
  /// Writes the probabilities to a CheckpointWriter, or reads them from a CheckpointReader.
  template <class Checkpoint>
  void visit_state(Checkpoint& checkpoint) {
    tree_.visit_state(checkpoint);
    checkpoint.value(count_);
    checkpoint.list(probability_);
    checkpoint.list(until_);
    checkpoint.list(unlearned_);
  }
  /// Whether they are probabilities of `lights` lights; of those that were read.
  bool is_valid(std::size_t lights) const;

  /// Inputs:  normal: unit. Nothing where no light was seen.
  LightChances at(const Vec3& position, const Vec3& normal) const {
    const std::size_t cell = tree_.find(position, normal), first = cell * count_;
    if (unlearned_[cell] == 1) return {};
    return {std::span(probability_).subspan(first, count_),
            std::span(until_).subspan(first, count_), unlearned_[cell]};
  }

 private:
  SurfaceTree tree_;
  std::size_t count_ = 0;  ///< of lights
  std::vector<float> probability_, until_;
  std::vector<float> unlearned_;  ///< of each cell; 1 where no light was seen
};

}  // namespace oriel
