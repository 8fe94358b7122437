// SPDX-License-Identifier: Apache-2.0
#include "render/budget.h"

#include <algorithm>

namespace oriel {
namespace {

/// 4^level, within what a pixel can be worth.
std::uint32_t samples_of_level(int level) { return 1u << (2 * std::clamp(level, 0, 9)); }

}  // namespace

RenderBudget render_budget(const scene::RenderOptions& options, const BudgetRequest& request) {
  RenderBudget budget;
  if (request.samples || request.noise || request.seconds) {
    const std::uint32_t most =
        request.noise && !request.seconds ? kMaxSamplesForNoise : kMaxSamples;
    budget.max_samples = std::clamp(request.samples.value_or(most), 1u, kMaxSamples);
    budget.noise = std::max(request.noise.value_or(0.0f), 0.0f);
    budget.seconds = std::max(request.seconds.value_or(0.0), 0.0);
    if (request.distributes && !(budget.noise > 0) && budget.max_samples >= kFewestDistributed)
      budget.distribution = request.samples ? Distribution::SecondHalf : Distribution::EveryPass;
    return budget;
  }
  const std::uint32_t most = samples_of_level(options.samples_max) * kPathSamplesPerSceneSample;
  budget.max_samples = std::clamp(most, kMinSceneSamples, kMaxSamples);
  budget.min_samples =
      std::clamp(samples_of_level(options.samples_min), kMinJudgedSamples, budget.max_samples);
  const Rgba& contrast = options.contrast;
  budget.every_pixel = true;
  budget.noise = std::max(std::min({contrast.r, contrast.g, contrast.b}), 0.0f) * kNoisePerContrast;
  return budget;
}

}  // namespace oriel
