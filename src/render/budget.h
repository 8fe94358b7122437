// SPDX-License-Identifier: Apache-2.0
// Stop criteria of a render, from the scene's sampling options and the user's request.
#pragma once

#include <optional>

#include "render/progressive.h"
#include "scene/render_options.h"

namespace oriel {

/// Paths per sample of the scene's options. These options were made for renderers that trace many
/// gather, shadow and reflection rays per sample; a path has one of each. An estimate: `samples 0
/// 2` gives at most 256 paths, which the noise target reduces.
inline constexpr std::uint32_t kPathSamplesPerSceneSample = 16;

/// Minimum number of samples from a scene's own options.
inline constexpr std::uint32_t kMinSceneSamples = 64;

/// Maximum number of samples of a pixel.
inline constexpr std::uint32_t kMaxSamples = 1u << 20;

/// The same if only a noise target is requested; ends renders whose noise decreases too slowly. A
/// diffuse interior needs a few hundred samples for a target of .02.
inline constexpr std::uint32_t kMaxSamplesForNoise = 4096;

/// Noise per unit of `contrast`: two neighbouring pixels whose noise is this share of the contrast
/// differ by less than the contrast in 95 of 100 cases, 1 / (1.96 sqrt(2)).
inline constexpr float kNoisePerContrast = 0.3608f;

/// The user's request, which replaces the scene's options.
struct BudgetRequest {
  std::optional<std::uint32_t> samples = {};  ///< of each pixel; with `noise`, the maximum
  std::optional<float> noise = {};            ///< target of picture_noise()
  std::optional<double> seconds = {};
  bool distributes = false;  ///< see Distribution
};

/// The budget of a render.
///
/// Model:   without a request `samples min max` gives at most 4^max x kPathSamplesPerSceneSample
///          and at least 4^min samples; the lowest channel of `contrast` is the noise target of
///          every pixel. Any request replaces all of it; of several, the first that is met ends the
///          render. A request for a distribution has an effect without a noise
///          target, and if `samples` are enough for it.
/// Checked: Budget.* in progressive_test.cpp
RenderBudget render_budget(const scene::RenderOptions& options, const BudgetRequest& request);

}  // namespace oriel
