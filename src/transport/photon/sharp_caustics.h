// SPDX-License-Identifier: Apache-2.0
// The caustics of a path-traced picture that photons bring, since paths rarely or never find them.
#pragma once

#include <cstdint>
#include <vector>

#include "transport/photon/photon_map.h"

namespace oriel {

struct World;

/// Two kinds of caustics that photons bring.
enum class CausticLights : std::uint8_t {
  Missed,      ///< by mirrors, of lights that rays cannot hit, or hardly since they are small
  RarelyFound  ///< by mirrors, of all other lights; by narrow glossy lobes, of small lights
};

/// How an object scatters light that comes from a light; bits.
enum CausticWay : std::uint8_t {
  kByMirror = 1u << 0,  ///< by a mirror or clear glass
  kByGloss = 1u << 1,   ///< by glossy reflection
};

/// Divides caustics between photons and paths: each way of light belongs to exactly one of them.
///
/// Model:   photons bring the light of some lights that is first scattered by one of the casters,
///          up to the first diffuse surface. Paths bring all other light: they find large lights
///          and the environment through mirrors and glass, and sample lights on rough surfaces. A
///          light is missed by paths if rays of mirrors cannot hit it, or, with `caustic on`, if
///          its extent is small compared with the scene. An instance is a caster by mirror if its
///          surface shader has a mirror or clear glass lobe of at least kLeastMirror at one of a
///          few places, its flags allow caustics, and no photon shader replaces its material; by
///          gloss if a narrow glossy lobe has at least kLeastGloss and light samples on it have no
///          rules that photons do not follow: lists of lights, surfaces without shadows, limited
///          reflections. Without `caustic on` photons pass glass straight, as rays do.
/// Checked: SharpCaustics.*, CausticPictures.* in tests/cross_method
class SharpCaustics {
 public:
  struct Sphere {
    Vec3 centre{0};
    float radius = 0;
  };

  SharpCaustics() = default;
  explicit SharpCaustics(const World& world, CausticLights which = CausticLights::Missed);

  bool empty() const { return light_count_ == 0; }
  /// The number of lights that casters scatter.
  std::size_t light_count() const { return light_count_; }
  /// Bits CausticWay: how casters scatter the light.
  unsigned ways_of(int light) const { return lights_[static_cast<std::size_t>(light)]; }
  /// The same for an instance: how it scatters some of the lights.
  unsigned ways_by(int instance) const { return casters_[static_cast<std::size_t>(instance)]; }
  /// Whether photons bring the light that the instance scatters first in that way.
  bool bring(int light, int instance, CausticWay way) const {
    return (ways_of(light) & ways_by(instance) & way) != 0;
  }
  /// Bounds of the casters of a light over the shutter interval, world.
  std::vector<Sphere> spheres(int light) const;

 private:
  struct Caster {
    Sphere bounds;
    unsigned ways = 0;
  };

  std::vector<std::uint8_t> lights_, casters_;  // bits CausticWay
  std::vector<Caster> bounds_;
  std::size_t light_count_ = 0;
};

/// Photons of the lights of SharpCaustics.
struct SharpPhotons {
  SharpCaustics of;
  PhotonMap map;
  PhotonLookup lookup;
};

}  // namespace oriel
