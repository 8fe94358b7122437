// SPDX-License-Identifier: Apache-2.0
// The mirrors and clear interfaces that a photon passed on its way from a light to a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/closure.h"
#include "runtime/shading_point.h"
#include "transport/photon/photon_map.h"

namespace oriel {

/// What all chains of the same kind share: the light and, counted from the receiver, the interfaces
/// with what each of them does.
struct ChainKind {
  static constexpr int kMost = 4;  ///< maximum number of interfaces
  std::int32_t light = -1;         ///< index into World::lights
  std::uint16_t count = 0;
  std::uint16_t refracted = 0;  ///< bit i: interface i refracts; otherwise it reflects
  std::int32_t instance[kMost] = {-1, -1, -1, -1};  ///< indices into World::instances
  /// Refractive index on the far side, as seen from the receiver, over that on the near side.
  float eta[kMost] = {1, 1, 1, 1};

  bool refracts(int i) const { return (refracted >> i & 1) != 0; }
  bool operator==(const ChainKind&) const = default;
};

/// The chain of a stored photon.
struct PhotonChain {
  ChainKind kind;
  /// Only mirrors and refracting interfaces, at most ChainKind::kMost, from a light without motion.
  bool simple = false;
  std::uint32_t index = 0;  ///< of the emission
  float offset = 0;         ///< ShadingPoint::ray_offset of the receiver
  Vec3 origin{0};           ///< on the light; of directional lights the unit direction to it
  Vec3 last{0};             ///< where the photon left the last interface
};

/// Records the chain of a photon on its way.
class ChainRecorder {
 public:
  /// Inputs:  light: index into World::lights; -1: chains are not wanted.
  explicit ChainRecorder(int light) : light_(light) { chain_.simple = light >= 0; }
  /// A lobe scattered the photon.
  void add(const Lobe& lobe, const ShadingPoint& point, const Vec3& direction);
  /// Something else scattered it.
  void give_up() { chain_.simple = false; }
  /// The chain, its interfaces counted from the receiver. Inputs: see PhotonChain.
  PhotonChain to(float offset, std::uint32_t index, const Vec3& origin) const;

 private:
  int light_;
  PhotonChain chain_;  // its interfaces are counted from the light
};

/// A photon of a caustic map, with its share of the power, and its chain.
struct ChainPhoton {
  Photon photon;
  PhotonChain chain;
};

/// All photons of a caustic map before merging, and the number of emitted photons of each light.
struct ChainLog {
  std::vector<ChainPhoton> photons;
  std::vector<std::uint64_t> emitted;  ///< by light
};

}  // namespace oriel
