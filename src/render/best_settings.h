// SPDX-License-Identifier: Apache-2.0
// Settings of the paths of a picture, chosen by pilot paths.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "render/integrator.h"
#include "transport/path/pilot_paths.h"

namespace oriel {

/// Settings of paths that are chosen in steps.
///
/// Model:   each step compares one or several choices with the settings before it and keeps the
///          best one, if that gains enough. Each choice has a hundredth as many pilot paths as the
///          picture has paths, within limits.
class BestSettings {
 public:
  /// Gain from which on improve() keeps a choice; the comparison is noisy.
  static constexpr float kWorthwhile = 1.1f;

  struct Candidate {
    PathSettings settings;
    float usual_gain = 1;  ///< how many times as fast pictures usually reach the same noise
    float kept_gain = 1;   ///< share of what pilot paths find that pictures gain
  };

  /// What is passed, and what the settings point to, outlives it.
  BestSettings(const World& world, const IntegratorPreparation& p, const PathSettings& settings)
      : world_(world), p_(p), settings_(settings) {}

  const PathSettings& settings() const { return settings_; }
  /// Takes the settings if they gain enough. Returns whether they do.
  bool improve(const PathSettings& settings);
  /// Takes the candidate with the largest expected gain, if that is above 1. The expected gain is a
  /// geometric mean of the gain that pilot paths find and of the usual one; the weight of the first
  /// grows with the number of pilot paths.
  void choose(std::span<const Candidate> candidates);
  /// Whether the settings, which use photons, gain enough over `without`, whose rays find the same
  /// light by chance.
  bool need_photons(const PathSettings& without);

 private:
  const PilotPaths& own_pilots();
  std::size_t pilot_pixels() const;
  PilotPaths trace(const PathSettings& settings) const;

  const World& world_;
  const IntegratorPreparation& p_;
  PathSettings settings_;
  std::optional<PilotPaths> pilots_;  ///< of the settings, once they are compared
};

}  // namespace oriel
