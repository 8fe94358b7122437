// SPDX-License-Identifier: Apache-2.0
// The caustics of a path-traced picture that photons bring, since paths rarely or never find them.
#pragma once

#include <cstdint>
#include <vector>

#include "transport/photon/photon_map.h"

namespace oriel {

struct World;

/// The lights whose caustics photons bring.
enum class CausticLights : std::uint8_t {
  Missed,  ///< rays of mirrors cannot hit them, or hardly since they are small
  Found    ///< all others: rays hit them, but rarely by way of curved mirrors and glass
};

/// Divides caustics between photons and paths: each way of light belongs to exactly one of them.
///
/// Model:   photons bring the light of `lights` that is first scattered by a mirror or clear glass
///          of one of the `casters`, up to the first diffuse surface. Paths bring all other light:
///          they find large lights and the environment through mirrors and glass, and sample lights
///          on rough surfaces. A light is missed by paths if rays of mirrors cannot hit it, or,
///          with `caustic on`, if its extent is small compared with the scene. An instance is a
///          caster if its surface shader has a mirror or clear glass lobe of at least kLeastWeight
///          at one of a few places, its flags allow caustics, and no photon shader replaces its
///          material. Without `caustic on` photons pass glass straight, as rays do.
/// Checked: CausticPictures.* in tests/cross_method
class SharpCaustics {
 public:
  struct Sphere {
    Vec3 centre{0};
    float radius = 0;
  };

  SharpCaustics() = default;
  explicit SharpCaustics(const World& world, CausticLights which = CausticLights::Missed);

  bool empty() const { return light_count_ == 0 || spheres_.empty(); }
  std::size_t light_count() const { return light_count_; }
  bool has_light(int light) const { return lights_[static_cast<std::size_t>(light)] != 0; }
  bool casts(int instance) const { return casters_[static_cast<std::size_t>(instance)] != 0; }
  /// Bounds of the casters over the shutter interval, world.
  const std::vector<Sphere>& spheres() const { return spheres_; }

 private:
  std::vector<std::uint8_t> lights_, casters_;
  std::vector<Sphere> spheres_;
  std::size_t light_count_ = 0;
};

/// Photons of the lights of SharpCaustics.
struct SharpPhotons {
  SharpCaustics of;
  PhotonMap map;
  PhotonLookup lookup;
};

}  // namespace oriel
