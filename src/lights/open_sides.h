// SPDX-License-Identifier: Apache-2.0
// How much of the light that a surface emits on each side reaches places where rays miss the
// surface.
#pragma once

#include <cstdint>
#include <vector>

#include "lights/emission.h"

namespace oriel {

/// Estimates for the triangles of one instance that emits on both sides, as all materials of the
/// library do. The inside of a closed lamp and the side close to a ceiling need no light samples:
/// rays from the surfaces that they light find them.
///
/// Model:   of 16 cosine-distributed rays from neighbouring triangles, the share that hits nothing,
///          or a surface from which a further cosine-distributed ray does not hit an emissive one.
///          Rays pass surfaces that may transmit light.
/// Checked: Emission.InsidesOfLampsAreRarelySampled, .SidesCloseToAPlateAreRarelySampled
class OpenSides {
 public:
  struct Shares {
    float front = 0, back = 0;  ///< of the accel's normal; in [0, 1]
  };

  /// Inputs:  emission: by material; groups: of triangles with neighbouring
  ///          numbers, which share an estimate; at least 1.
  OpenSides(const World& world, std::uint32_t instance, const std::vector<EmissionKind>& emission,
            std::size_t groups);

  Shares at(std::uint32_t triangle) const {
    return shares_[triangle * shares_.size() / triangles_];
  }

 private:
  std::size_t triangles_;
  std::vector<Shares> shares_;  ///< by group
};

}  // namespace oriel
