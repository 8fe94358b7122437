// SPDX-License-Identifier: Apache-2.0
// Paths from a receiver by mirrors and clear interfaces to a given end, found by Newton's method.
#pragma once

#include <optional>

#include "geom/surface.h"
#include "runtime/world.h"
#include "transport/counts.h"
#include "transport/photon/photon_chain.h"

namespace oriel {

// Conventions
//   World space. A chain is traced from the receiver to the light; interface 0 is next to the
//   receiver. Derivatives are by the two coordinates of the first direction on the unit sphere,
//   radians.

/// Where chains start.
struct ChainReceiver {
  Vec3 position{0};
  Vec3 normal{0, 0, 1};  ///< geometric, unit, on the side that chains leave
  float offset = 0;      ///< ShadingPoint::ray_offset
  float time = 0;
};

/// Where chains end: a point, or a unit direction at infinity.
struct ChainTarget {
  Vec3 at{0};
  bool endless = false;
};

/// A chain that was traced for a first direction, with its derivatives.
struct SpecularChain {
  Vec3 first{0};  ///< unit, from the receiver
  geom::Ray ray[ChainKind::kMost];
  geom::Hit hit[ChainKind::kMost];
  Vec3 normal[ChainKind::kMost];  ///< shading normals, against the ray
  Vec3 position{0};               ///< of the last interface
  Vec3 direction{0};              ///< unit, that the ray leaves it in
  geom::Ray last;                 ///< the ray that leaves it, without an end
  Vec3 by[2];                     ///< derivatives of the position
  Vec3 turn[2];                   ///< derivatives of the direction
};

/// Traces the interfaces of a kind. False: another surface is hit, or an interface does something
/// else, such as total reflection in place of refraction.
///
/// Source:  H. Igehy, "Tracing Ray Differentials", 1999.
/// Checked: CausticPictures.*, Caustics.* in tests/cross_method
bool trace_chain(const World& world, const ChainReceiver& from, const ChainKind& kind,
                 const Vec3& first, SpecularChain& chain, RayCounts& counts);

/// The chain of a kind that ends at the target, found from a first direction near to that of the
/// solution. Nothing if the iteration does not converge.
///
/// Source:  J. Hanika, M. Droske, L. Fascione, "Manifold Next Event Estimation", 2015. Here
///          Newton's method moves the first direction, so that every step is an exact chain.
std::optional<SpecularChain> find_chain(const World& world, const ChainReceiver& from,
                                        const ChainKind& kind, const Vec3& first,
                                        const ChainTarget& target, RayCounts& counts);

/// Solid angle at the receiver for each area at the target perpendicular to the chain, or for each
/// solid angle of directions to an endless target; times the squared ratio of refractive indices,
/// such that it is that of irradiance to intensity. 0 where it is infinite.
float concentration(const ChainKind& kind, const SpecularChain& chain, const ChainTarget& target);

}  // namespace oriel
