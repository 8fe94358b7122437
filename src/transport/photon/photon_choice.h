// SPDX-License-Identifier: Apache-2.0
// The results of the photon shaders of a material.
#pragma once

#include <optional>

#include "runtime/shader_spec.h"
#include "sampling/sampler.h"

namespace oriel {

/// Collects the requests of photon shaders: the photon to store, and one of the requested
/// directions, chosen with equal probability.
class PhotonChoice final : public PhotonNext {
 public:
  PhotonChoice(sampling::Sampler& sampler, bool globillum)
      : sampler_(sampler), globillum_(globillum) {}
  void store(const Rgb& energy) override { stored = energy; }
  bool send(RayKind kind, const Rgb& energy, const Vec3& direction) override {
    // Caustic photons are not scattered diffusely.
    const bool diffuse =
        kind == RayKind::PhotonReflectDiffuse || kind == RayKind::PhotonTransmitDiffuse;
    if ((diffuse && !globillum_) || max_component(energy) <= 0) return false;
    ++requests;
    if (requests > 1 && sampler_.next_1d() * static_cast<float>(requests) >= 1) return true;
    scattering = {kind, energy, normalize(direction)};
    return true;
  }
  Vec2 next() override { return sampler_.next_2d(); }

  struct Scattering {
    RayKind kind = RayKind::PhotonAbsorb;
    Rgb energy{0};
    Vec3 direction{0, 0, 1};
  };
  std::optional<Rgb> stored;
  Scattering scattering;
  int requests = 0;

 private:
  sampling::Sampler& sampler_;
  bool globillum_;
};

}  // namespace oriel
