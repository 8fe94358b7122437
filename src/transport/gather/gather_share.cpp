// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/gather_share.h"

#include <algorithm>

namespace oriel {
namespace {

/// Differences below this fraction of the mean brightness get no further rays; maximum number of
/// further rays of a stratum. Estimates.
constexpr float kMinContrast = 0.5f;
constexpr int kMaxExtraRays = 64;
/// Above the rounding of a sum of shares, and far below one ray.
constexpr float kAboveRounding = 1e-3f;

}  // namespace

std::vector<int> share_rays(std::span<const GatherSample> samples, int rings, int sectors,
                            int more) {
  std::vector<int> rays(samples.size(), 0);
  if (more <= 0) return rays;
  const auto found = [&](int ring, int sector) {
    const int i = ring * sectors + (sector + sectors) % sectors;
    return gather_brightness(samples[static_cast<std::size_t>(i)].radiance);
  };
  for (const int color : {0, 1}) {
    std::vector<float> contrast(samples.size(), 0);
    float total = 0, level = 0;
    for (int j = 0; j < rings; ++j)
      for (int k = 0; k < sectors; ++k) {
        if ((j + k) % 2 != color) continue;
        // At the border the missing neighbour is skipped; this stratum does not replace it.
        float low = found(j, k - 1), high = low, sum = low;
        const auto look = [&](float l) {
          low = std::min(low, l), high = std::max(high, l), sum += l;
        };
        look(found(j, k + 1));
        if (j > 0) look(found(j - 1, k));
        if (j + 1 < rings) look(found(j + 1, k));
        const float c = high - low;
        const int own = j * sectors + k;
        contrast[static_cast<std::size_t>(own)] = c;
        total += c;
        level += sum;
      }
    const float floor = kMinContrast * level / static_cast<float>(2 * samples.size());
    const float budget = 0.5f * static_cast<float>(more);
    if (!(total > 0)) continue;
    // Rounded down against the running total. It starts above 0 because it often reaches a whole
    // number, at the end always for an even budget, which rounding errors must not decide about.
    float run = kAboveRounding;
    int given = 0;
    for (std::size_t i = 0; i < contrast.size(); ++i) {
      if (contrast[i] <= floor) continue;
      run += contrast[i] / total * budget;
      const int n = std::min(kMaxExtraRays, static_cast<int>(run) - given);
      rays[i] = n;
      given += n;
    }
  }
  return rays;
}

}  // namespace oriel
