// SPDX-License-Identifier: Apache-2.0
// Sharp caustics at what the camera sees: a search for chains, and photons for what it misses.
#pragma once

#include <span>
#include <utility>

#include "runtime/closure.h"
#include "sampling/sampler.h"
#include "transport/manifold/chain_light.h"
#include "transport/manifold/chain_starts.h"
#include "transport/photon/photon_discs.h"

namespace oriel {

/// Concentration of the chain of a photon, if the search at its place finds the chain from these
/// starts; otherwise 0.
float finds_chain(const World& world, std::span<const ChainStart> starts, const ChainPhoton& photon,
                  RayCounts& counts);

/// Light that arrives through one chain.
struct ChainArrival {
  Vec3 wi{0};         ///< unit, from the receiver
  Rgb irradiance{0};  ///< of a surface facing wi
  int light = 0;      ///< index into World::lights
};

/// The chains that a search finds.
struct ChainArrivals {
  int count = 0;
  ChainArrival of[ChainStarts::kMostStarts];
};

/// Searches the chains from one side of a surface. Inputs:  u: the place on each light, uniform in
/// [0,1)^2. Returns: all that were found; their mean over u is the irradiance.
void search_chains(const World& world, const ChainStarts::Found& at, const ChainReceiver& from,
                   const Vec2& u, ChainArrivals& arrivals, RayCounts& counts);

/// Divides the light of caustic photons into chains that a search finds, and a map of the others.
///
/// Model:   the search at a place is deterministic for a given place on the light: Newton's method
///          from each start of the place (ChainStarts, made of 7 of 8 photons). One photon of eight
///          is compared with the search at its place, to its place on the light. It is stored in
///          `missed`, with eight times its power, if the search does not find its chain, or if the
///          chain is concentrated more than the limit of its cell (foci, which would be noise). So
///          each chain is counted once, whatever the search misses. Photons with glossy or more
///          than ChainKind::kMost interfaces, or of casters where the search finds less than half
///          of the chains, are in `others` without a search.
/// Source:  J. Hanika, M. Droske, L. Fascione, "Manifold Next Event Estimation", 2015.
/// Checked: CausticPictures.*, Caustics.* in tests/cross_method
class ManifoldCaustics {
 public:
  ManifoldCaustics() = default;
  ManifoldCaustics(ChainStarts starts, PhotonDiscs missed, PhotonMap others)
      : starts_(std::move(starts)), missed_(std::move(missed)), others_(std::move(others)) {}

  bool empty() const { return starts_.empty(); }
  /// Chains that the search does not find at places with starts, and those that it is not for.
  const PhotonDiscs& missed() const { return missed_; }
  const PhotonMap& others() const { return others_; }
  /// Where chains from a place start, and the probability with which it is searched.
  ChainStarts::Found starts_at(const Vec3& position) const { return starts_.at(position); }

  template <class Checkpoint>
  void visit_state(Checkpoint& checkpoint) {
    starts_.visit_state(checkpoint);
    missed_.visit_state(checkpoint);
    others_.visit_state(checkpoint);
  }
  bool is_valid(const World& world) const;
  std::size_t bytes() const { return starts_.bytes() + missed_.bytes() + others_.bytes(); }

 private:
  ChainStarts starts_;
  PhotonDiscs missed_;
  PhotonMap others_;
};

}  // namespace oriel
