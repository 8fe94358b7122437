// SPDX-License-Identifier: Apache-2.0
#include "transport/path/resolve_outputs.h"

#include <algorithm>

namespace oriel {
namespace {

/// Least occlusion factor written where there is light: its quotient must stay finite.
constexpr float kMinOcclusion = 1e-4f;

Rgb quotient(const Rgb& a, const Rgb& b) {
  const auto one = [](float x, float y) { return y != 0 ? x / y : 0.0f; };
  return Rgb(one(a.x, b.x), one(a.y, b.y), one(a.z, b.z));
}

}  // namespace

MaterialOutputs resolve_outputs(const AovValues& means, const Rgb& beauty) {
  MaterialOutputs out;
  std::size_t next = 0;
  const auto put = [&](const Rgb& c) { out[next++] = c; };
  const auto result = [&](Aov c) { return means.result[static_cast<std::size_t>(c)]; };

  put(beauty);
  for (std::size_t i = 0; i < kLevels; ++i) {
    put(means.result[i]);
    put(quotient(means.result[i], means.level[i]));
    put(means.level[i]);
  }
  const Rgb indirect = result(Aov::Indirect);
  const Rgb post = quotient(indirect, means.level[static_cast<std::size_t>(Aov::Diffuse)]);
  Rgb occlusion = means.occlusion, dimming = means.dimming;
  for (int i = 0; i < 3; ++i) {
    if (post[i] == 0) continue;
    dimming[i] = std::max(dimming[i], kMinOcclusion);
    occlusion[i] = std::max(occlusion[i], kMinOcclusion);
  }
  put(indirect);
  put(quotient(post, dimming));
  put(post);
  put(occlusion);
  put(result(Aov::Added));
  const Rgb background = result(Aov::Background);
  put(background);
  put(quotient(background, Rgb(1 - means.opacity)));
  put(Rgb(means.opacity));
  put(result(Aov::Other));
  return out;
}

}  // namespace oriel
