// SPDX-License-Identifier: Apache-2.0
// Aims the photons of a light at objects that cast caustics.
#pragma once

#include <cstdint>
#include <vector>

#include "lights/photon_source.h"
#include "transport/photon/sharp_caustics.h"

namespace oriel {

/// Chooses random numbers of emission whose photons may meet one of several spheres.
///
/// Model:   the unit square of random numbers that decides about the direction (of directional
///          lights: about the place) is divided into cells. A cell is used if the line of a photon
///          in it comes near one of the spheres; the distance includes the extent of the cell and
///          of the light. Photons outside of these cells meet no sphere, so they are not sent.
///          Without a gain all cells are used.
/// Checked: PhotonAim.* in tests/cross_method
class PhotonAim {
 public:
  PhotonAim() = default;  ///< all cells
  PhotonAim(const PhotonSource& source, const std::vector<SharpCaustics::Sphere>& spheres);

  /// Share of the square that is used, 0 to 1. Power is multiplied by it.
  float share() const { return share_; }
  /// Moves the random numbers of a photon into the cells in use.
  void aim(Vec2& u_place, Vec2& u_direction) const;

 private:
  bool by_place_ = false;
  float share_ = 1;
  std::vector<std::uint32_t> cells_;  // in use; empty: all
};

}  // namespace oriel
