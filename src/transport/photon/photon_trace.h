// SPDX-License-Identifier: Apache-2.0
// Photons from lights to surfaces: what fills the photon maps.
#pragma once

#include <cstdint>
#include <vector>

#include "lights/photon_source.h"
#include "transport/counts.h"
#include "transport/photon/photon_file.h"
#include "transport/progress_monitor.h"

namespace oriel {

/// A light of which this many photons left none to store is given up.
inline constexpr std::uint64_t kHopelessPhotons = 100000;

struct PhotonSettings {
  bool globillum = true, caustics = true;
  LightPhotons each;                 ///< counts of lights that write none of their own
  LightPhotons environment;          ///< none unless asked: hosts leave the sky to final gathering
  scene::TraceDepth depth{5, 5, 5};  ///< bounces of all kinds, diffuse reflection included
  float merge_global = 0, merge_caustic = 0;  ///< see PhotonMap
  /// Whether lights without energy send none, as in scenes that ask for photons themselves.
  bool by_energy = false;
  std::uint32_t seed = 0;
};

/// Whether a light sends photons: it is on, and has energy where that counts.
/// Source:  manual 2.5 (automatic_photon_energy): without energy "photon emission is disabled".
/// Checked: PhotonEnergy.* in tests/analytic/photons/photon_energy_test.cpp
bool sends_photons(const Light& light, const PhotonSettings& settings);

/// Where the power went, mean over the photons of each light, summed over lights.
struct PhotonBalance {
  using Sum = Imath::Vec3<double>;  ///< double: millions of terms
  Sum emitted{0.0}, absorbed{0.0}, escaped{0.0};
  Sum stopped{0.0};  ///< by trace depth, or since no map asks for more
  std::uint64_t photons = 0;

  PhotonBalance& operator+=(const PhotonBalance& o);
};

/// Sends the photons of all lights.
///
/// Model:   photons scatter by the same closures and lobes as paths. What levels and shading
///          normals do goes by the direction a photon leaves in, as if paths were walked back, so
///          that both find the same light; clear lobes and refraction are taken as they are for
///          the direction it comes from. One of the lobes is followed with the chance of the power
///          it keeps, so that powers stay about equal. Straight through cut-outs, and through
///          materials that shadow rays pass, unless they make refractive caustics; through glass
///          that blocks shadow rays refracted. Absorbed by media as paths are. Each surface with a
///          diffuse or translucent component stores those that came by mirrors, glass and glossy
///          surfaces alone in the caustic map, those with a diffuse bounce behind them in the
///          global map, direct light in neither. Caustic and global photons of a light are the
///          same photons as far as both are asked for. Lists of lights of instances and materials
///          do not apply, nor do limits of reflection rays (cut-off, falloff, own depth).
///          Flags of objects do: photons pass what is excluded, are stored where it receives and
///          scattered on where it casts. Where the flags for the two maps differ, each map has
///          photons of its own, and the balance is that of the global ones.
/// Returns: maps that depend on the world and the settings alone, not on threads; where `watch` is
///          cancelled, of the photons sent until then. Segments are counted as gather rays.
/// Checked: PhotonTrace.*, ObjectFlags.* in tests/analytic.
PhotonMaps trace_photons(const World& world, const PhotonSettings& settings, RayCounts& counts,
                         PhotonBalance* balance = nullptr, const ProgressMonitor& monitor = {});

}  // namespace oriel
