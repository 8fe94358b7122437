// SPDX-License-Identifier: Apache-2.0
// Settings of the paths of a picture, chosen by pilot paths.
#pragma once

#include <optional>

#include "render/integrator.h"
#include "transport/path/pilot_paths.h"

namespace oriel {

/// Settings of paths that are chosen in steps.
///
/// Model:   each step compares some choices with the settings before it and keeps the best one, if
///          that gains enough. Each choice has a hundredth as many pilot paths as the picture has
///          paths, within limits.
class BestSettings {
 public:
  /// Gain from which on a choice is kept; the comparison is noisy.
  static constexpr float kWorthwhile = 1.1f;

  /// What is passed, and what the settings point to, outlives it.
  BestSettings(const World& world, const IntegratorPreparation& p, const PathSettings& settings)
      : world_(world), p_(p), settings_(settings) {}

  const PathSettings& settings() const { return settings_; }
  /// Compares the settings with those before this step. Returns whether they gain clearly more than
  /// all others of the step; these are kept for settle().
  bool improve(const PathSettings& settings);
  /// Whether the settings, which use photons, gain enough over `without`, whose rays find the same
  /// light by chance.
  bool need_photons(const PathSettings& without);
  /// Ends a step: its best choice becomes the settings, if one gained enough.
  void settle();

 private:
  PilotPaths trace(const PathSettings& settings) const;

  const World& world_;
  const IntegratorPreparation& p_;
  PathSettings settings_;
  std::optional<PilotPaths> pilots_;  ///< of the settings, once they are compared
  struct Next {
    PathSettings settings;
    PilotPaths pilots;
    float gain;
  };
  std::optional<Next> next_;
};

}  // namespace oriel
