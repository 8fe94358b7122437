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

/// A box, turned as it may be.
struct AimBox {
  Vec3 centre{0};
  Vec3 half[3] = {Vec3(0), Vec3(0), Vec3(0)};  ///< from the centre to three of its sides

  AimBox() = default;
  AimBox(const geom::Box3& box)
      : centre(box.center()),
        half{Vec3(box.size().x / 2, 0, 0), Vec3(0, box.size().y / 2, 0),
             Vec3(0, 0, box.size().z / 2)} {}
};

/// Strength and aim.
struct EmissionRequest {
  /// Total flux as `energy` writes it: the unit is that of physical_light's colour, so that a
  /// physical light whose energy is its colour agrees with its direct light. The shader then only
  /// tells how it spreads. Unset: the shader tells all, photons agree with direct light.
  std::optional<Rgb> energy;
  /// World box at whose silhouette infinitely far sources aim; unset: the whole scene.
  std::optional<AimBox> aim;
};

struct LightPhotons {
  PhotonCount global, caustic;
  EmissionRequest emission;
  bool only = false;  ///< photons alone: the light gives no direct light
  bool none = false;  ///< whatever is asked: energy 0 0 0, or the light is off
  /// An `energy` statement, or a shader that works the energy out. Scenes that ask for photons
  /// themselves get them of such lights alone.
  bool has_energy = false;
  bool any() const { return global.any() || caustic.any(); }
};

}  // namespace oriel
