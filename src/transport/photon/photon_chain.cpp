// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/photon_chain.h"

namespace oriel {

void ChainRecorder::add(const Lobe& lobe, const ShadingPoint& point, const Vec3& direction) {
  ChainKind& kind = chain_.kind;
  const bool clear = lobe.kind == LobeKind::Mirror || lobe.kind == LobeKind::ClearRefraction;
  chain_.simple &= clear && kind.count < ChainKind::kMost;
  if (!chain_.simple) return;
  const int i = kind.count++;
  kind.instance[i] = point.instance;
  if (dot(direction, point.geometric_normal) < 0) {
    kind.refracted |= static_cast<std::uint16_t>(1 << i);
    kind.eta[i] = lobe.eta;
  }
  chain_.last = point.position;
}

PhotonChain ChainRecorder::to(float offset, std::uint32_t index, const Vec3& origin) const {
  PhotonChain chain = chain_;
  ChainKind& kind = chain.kind;
  kind.light = light_;
  kind.refracted = 0;
  for (int i = 0; i < kind.count; ++i) {
    const int from = kind.count - 1 - i;
    kind.instance[i] = chain_.kind.instance[from];
    kind.eta[i] = 1 / chain_.kind.eta[from];
    if (chain_.kind.refracts(from)) kind.refracted |= static_cast<std::uint16_t>(1 << i);
  }
  chain.index = index;
  chain.offset = offset;
  chain.origin = origin;
  return chain;
}

}  // namespace oriel
