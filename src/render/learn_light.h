// SPDX-License-Identifier: Apache-2.0
// What the paths of a picture learn of its light beforehand.
#pragma once

#include "render/best_settings.h"
#include "render/integrator.h"
#include "transport/direction_guide.h"
#include "transport/gather/gather_bounces.h"
#include "transport/learned_lights.h"
#include "transport/path/path.h"

namespace oriel {

struct LearnedLight {
  LearnedLights lights;           ///< for the choice of lights
  LearnedLights emitters;         ///< for the choice of parts of the mesh lights
  DirectionGuide guide;           ///< for diffuse bounces
  std::int32_t diffuse_rays = 1;  ///< see PathSettings
  /// Whether photons should bring the light that rays find rarely. Not part of the state.
  bool needs_photons = false;
  std::size_t bytes() const { return lights.bytes() + emitters.bytes() + guide.bytes(); }

  /// Writes it to a CheckpointWriter, or reads it from a CheckpointReader.
  template <class Checkpoint>
  void visit_state(Checkpoint& checkpoint) {
    lights.visit_state(checkpoint);
    emitters.visit_state(checkpoint);
    guide.visit_state(checkpoint);
    checkpoint.value(diffuse_rays);
  }
  /// Whether it can be used for the world; of what was read.
  bool is_valid(const World& world) const;
};

/// Whether a picture of that many camera paths has enough of them to learn.
bool may_learn(const World& world, double paths);
/// Paths of the picture that learning refers to: no more than a noise target needs, by pilot paths,
/// so that learning is not more work than the picture. Inputs:  settings: of paths that learn.
/// Checked: GuidedPictures.LearnLittleForANoiseTargetThatIsMetSoon
double needed_paths(const World& world, const IntegratorPreparation& p,
                    const PathSettings& settings);

/// Learns at the points of coarse records which lights reach them and from where light comes. A
/// part is empty if the picture has so few paths that learning costs more than it saves, if pilot
/// paths show no gain, or if cancelled.
///
/// Inputs:  best: of the paths, which learned nothing; without_photons: the caches of the paths
///          without photons of light that rays find rarely, null if there are none.
/// Checked: Guiding.*, GuidedPictures.*, ManyLamps.* in tests/cross_method
LearnedLight learn_light(const World& world, const IntegratorPreparation& p, BestSettings best,
                         const IndirectCaches* without_photons);

}  // namespace oriel
