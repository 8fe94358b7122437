// SPDX-License-Identifier: Apache-2.0
// The light and the surfaces of a chain: its end at a light, and what arrives through it.
#pragma once

#include <optional>

#include "transport/manifold/specular_chain.h"

namespace oriel {

/// Whether chains can end at the light: it does not move, and its shader determines its light from
/// every place.
bool can_end_chains(const Light& light);

/// A place on a light where chains end.
struct ChainLight {
  ChainTarget target;
  Vec3 normal{0};  ///< of lights with an extent
  float area = 0;  ///< likewise: inverse density of the place
  Vec2 u{0};       ///< random numbers of the place
};

/// Inputs:  u: uniform in [0,1)^2; the place is uniform in area.
ChainLight place_on_light(const Light& light, const Vec2& u);

/// Light that leaves the last interface's place on a light along the chain: intensity of a place,
/// irradiance of an endless light; of lights with an extent divided by the density of the place.
/// In the unit of PhotonSource::power().
Rgb light_of_chain(const World& world, const Light& light, const ChainLight& end,
                   const SpecularChain& chain);

/// Share of the light that passes a chain: Fresnel, tints and absorption, by the closures that
/// photons meet. Nothing if a surface does anything else than its kind says, or if something is
/// between the last interface and the light.
/// Checked: CausticPictures.* in tests/cross_method
std::optional<Rgb> passed_by_chain(const World& world, const ChainReceiver& from,
                                   const ChainKind& kind, const SpecularChain& chain,
                                   const ChainTarget& target, RayCounts& counts);

}  // namespace oriel
