// SPDX-License-Identifier: Apache-2.0
// Photon settings of a light: number, energy and aim.
#pragma once

#include <cstdint>
#include <optional>

#include "base/vec.h"
#include "geom/mesh.h"

namespace oriel {

/// Number of photons of a map; the first limit reached ends emission, 0 = no limit. Both 0: none.
struct PhotonCount {
  std::uint64_t store = 0;  ///< number of photons stored in the map
  std::uint64_t emit = 0;   ///< number of emitted photons
  bool any() const { return store > 0 || emit > 0; }
};

/// An oriented box.
struct AimBox {
  Vec3 centre{0};
  Vec3 half[3] = {Vec3(0), Vec3(0), Vec3(0)};  ///< from the centre to three of its faces

  AimBox() = default;
  AimBox(const geom::Box3& box)
      : centre(box.center()),
        half{Vec3(box.size().x / 2, 0, 0), Vec3(0, box.size().y / 2, 0),
             Vec3(0, 0, box.size().z / 2)} {}
};

/// Energy and aim.
struct EmissionRequest {
  /// Total flux as in `energy`, in the unit of physical_light's colour: a physical light whose
  /// energy equals its colour agrees with its direct light. The shader then determines only the
  /// distribution. Unset: the shader determines both, and photons agree with direct light.
  std::optional<Rgb> energy;
  /// World box whose silhouette infinitely distant lights aim at; unset: the whole scene.
  std::optional<AimBox> aim;
};

struct LightPhotons {
  PhotonCount global, caustic;
  EmissionRequest emission;
  bool only = false;  ///< photons only: the light gives no direct light
  bool none = false;  ///< no photons: energy 0 0 0, or the light is off
  /// An `energy` statement, or a shader that computes the energy. In scenes with photon settings of
  /// their own, only such lights emit photons.
  bool has_energy = false;
  bool any() const { return global.any() || caustic.any(); }
};

}  // namespace oriel
