// SPDX-License-Identifier: Apache-2.0
// The heart of the denoiser: patch weights from one picture, regression of another.
#pragma once

#include <array>

#include "denoise/denoise_planes.h"

namespace oriel::denoising {

/// A picture and how noisy it is, 3 channels each.
struct Estimate {
  Planes mean, variance;
};

inline constexpr int kBandwidths = 2;
/// In standard deviations of the difference of two pixels.
/// Source: Bitterli et al. 2016 take 0.5 and 1. The narrower one here was measured on
///         scenes/interior at 16 and 64 samples: a seventh less relative error.
inline constexpr std::array<float, kBandwidths> kBandwidth = {0.35f, 1.0f};

/// What to add to `target` for each bandwidth, 3 channels.
///
/// Inputs:  guide: its patches make the weights; free of the target's noise, or the target itself.
std::array<Planes, kBandwidths> regress(const Estimate& target, const Estimate& guide,
                                        const Planes& features, float strength);

}  // namespace oriel::denoising
