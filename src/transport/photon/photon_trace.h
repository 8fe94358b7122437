// SPDX-License-Identifier: Apache-2.0
// Traces photons from lights to surfaces and builds the photon maps.
#pragma once

#include <cstdint>
#include <vector>

#include "lights/photon_source.h"
#include "transport/counts.h"
#include "transport/photon/photon_chain.h"
#include "transport/photon/photon_file.h"
#include "transport/photon/sharp_caustics.h"
#include "transport/progress_monitor.h"

namespace oriel {

/// Number of photons without a stored one after which a light is given up.
inline constexpr std::uint64_t kHopelessPhotons = 100000;

struct PhotonSettings {
  bool globillum = true, caustics = true;
  LightPhotons each;                          ///< for lights without counts of their own
  LightPhotons environment;                   ///< default none: final gathering brings the sky
  scene::TraceDepth depth{5, 5, 5};           ///< bounces of all kinds, diffuse reflection included
  float merge_global = 0, merge_caustic = 0;  ///< see PhotonMap
  /// Lights without energy emit no photons, as in scenes whose own statements enable photons.
  bool by_energy = false;
  std::uint32_t seed = 0;
  /// Only photons of its lights that its casters scatter first are wanted; null = all. For caustics
  /// alone. Borrowed.
  const SharpCaustics* sharp = nullptr;
  /// Receives the photons of the caustic map with their chains; optional, only with `sharp`.
  ChainLog* chains = nullptr;
  /// Maximum number of stored photons that lights request by counts of their own, in both maps. If
  /// they request more, each stores the same share of its request.
  std::uint64_t most = UINT64_MAX;
};

/// The number of stored photons that the lights request together by counts of their own, and
/// optionally the light with the largest request; a limit of emitted photons counts as such.
std::uint64_t requested_photons(const World& world, const PhotonSettings& settings,
                                const Light** largest = nullptr);

/// Whether a light emits photons: it is on, and has energy if energy is required.
/// Source:  manual 2.5 (automatic_photon_energy): without energy "photon emission is disabled".
/// Checked: PhotonEnergy.* in tests/analytic/photons/photon_energy_test.cpp
bool sends_photons(const Light& light, const PhotonSettings& settings);

/// Power balance: mean over the photons of each light, summed over lights.
struct PhotonBalance {
  using Sum = Imath::Vec3<double>;  ///< double: millions of terms
  Sum emitted{0.0}, absorbed{0.0}, escaped{0.0};
  Sum stopped{0.0};  ///< at the trace depth, or because no map needs more
  std::uint64_t photons = 0;

  PhotonBalance& operator+=(const PhotonBalance& o);
};

/// Traces the photons of all lights.
///
/// Model:   photons scatter by the same closures and lobes as paths. Lobe weights and shading
///          normals are evaluated for the outgoing direction, as a path in the opposite direction
///          does, so that both methods agree; clear lobes and refraction are evaluated for the
///          incoming direction. A lobe is followed with the probability of the power that it keeps,
///          so the powers of photons stay about equal. Photons pass straight through cut-outs, and
///          through materials that shadow rays pass unless these make refractive caustics; glass
///          that blocks shadow rays refracts them. Media absorb them as they absorb paths. Each
///          surface with a diffuse or translucent lobe stores photons: in the caustic map those
///          that came by mirrors, glass and glossy surfaces only, in the global map those with a
///          diffuse bounce; direct light is not stored. If both maps are requested, they share the
///          photons of a light. Light lists of instances and materials do not apply, and neither do
///          limits of reflection rays (cut-off, falloff, own depth). Object flags apply: photons
///          pass excluded objects, are stored on receivers and scattered by casters. If the flags
///          for the two maps differ, each map has its own photons, and the balance is that of the
///          global ones.
/// Returns: maps that depend on the world and the settings, not on the number of threads. If
///          cancelled: the maps of the photons so far. Segments are counted as gather rays.
/// Checked: PhotonTrace.*, ObjectFlags.* in tests/analytic.
PhotonMaps trace_photons(const World& world, const PhotonSettings& settings, RayCounts& counts,
                         PhotonBalance* balance = nullptr, const ProgressMonitor& monitor = {});

}  // namespace oriel
