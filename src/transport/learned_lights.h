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
///          light sampler mixes them with its tree (LightChances::kUnlearned).
/// Source:  the idea: P. Vevoda, I. Kondapaneni, J. Krivanek, "Bayesian Online Regression for
///          Adaptive Direct Illumination Sampling", 2018, without its model of unseen lights, which
///          the mixture replaces.
/// Checked: ManyLamps.* in tests/cross_method
class LearnedLights {
 public:
  LearnedLights() = default;
  /// Inputs:  bounds: of the scene; squares: mean square of the samples of each light at each
  /// point,
  ///          point by point, in the order of LightSampler::chosen_lights().
  LearnedLights(const geom::Box3& bounds, std::span<const SurfaceTree::Point> points,
                std::span<const float> squares);

  bool empty() const { return count_ == 0; }
  std::size_t bytes() const {
    return tree_.bytes() + (probability_.size() + until_.size()) * sizeof(float);
  }
  /// Writes the probabilities to a CheckpointWriter, or reads them from a CheckpointReader.
  template <class Checkpoint>
  void visit_state(Checkpoint& checkpoint) {
    tree_.visit_state(checkpoint);
    checkpoint.value(count_);
    checkpoint.list(probability_);
    checkpoint.list(until_);
  }
  /// Whether they are probabilities of `lights` lights; of those that were read.
  bool is_valid(std::size_t lights) const;

  /// Inputs:  normal: unit. Nothing where no light was seen.
  LightChances at(const Vec3& position, const Vec3& normal) const {
    const std::size_t first = tree_.find(position, normal) * count_;
    if (!(until_[first + count_ - 1] > 0)) return {};
    return {std::span(probability_).subspan(first, count_),
            std::span(until_).subspan(first, count_)};
  }

 private:
  SurfaceTree tree_;
  std::size_t count_ = 0;  ///< of lights
  std::vector<float> probability_, until_;
};

}  // namespace oriel
