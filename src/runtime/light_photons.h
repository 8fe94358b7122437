// SPDX-License-Identifier: Apache-2.0
// What a scene says about the photons of a light: how many, how strong, where to.
#pragma once

#include <cstdint>
#include <optional>

#include "base/vec.h"
#include "geom/mesh.h"

namespace oriel {

/// How many photons for a map; what is reached first ends them, 0 = no limit. Neither: none.
struct PhotonCount {
  std::uint64_t store = 0;  ///< that are stored in the map
  std::uint64_t emit = 0;   ///< that are sent
  bool any() const { return store > 0 || emit > 0; }
};

/// Strength and aim.
struct EmissionRequest {
  /// Total flux as `energy` writes it: the unit is that of physical_light's colour, so that a
  /// physical light whose energy is its colour agrees with its direct light. The shader then only
  /// tells how it spreads. Unset: the shader tells all, photons agree with direct light.
  std::optional<Rgb> energy;
  /// World box at which infinitely far sources aim; unset or empty: the whole scene.
  std::optional<geom::Box3> aim;
};

struct LightPhotons {
  PhotonCount global, caustic;
  EmissionRequest emission;
  bool only = false;  ///< photons alone: the light gives no direct light
  bool any() const { return global.any() || caustic.any(); }
};

}  // namespace oriel
