// SPDX-License-Identifier: Apache-2.0
// Takes the noise out of a path-traced picture with the help of what its first hits looked like.
#pragma once

#include "image/pixel_buffer.h"

namespace oriel {

/// What a render knows of its own noise and of the surfaces in it. All images of one size; null =
/// not known. One of half_difference and variance is needed, both are best.
struct DenoiseInput {
  const Image* color = nullptr;            ///< linear, RGB first; channels after RGB come out as is
  const Image* half_difference = nullptr;  ///< half of (mean of one half of the samples - other's)
  const Image* variance = nullptr;         ///< of each pixel's mean, RGB
  const Image* albedo = nullptr;           ///< RGB, of the first surface
  const Image* normal = nullptr;           ///< XYZ, 0 where nothing was hit
  const Image* depth = nullptr;            ///< 0 where nothing was hit
};

struct DenoiseOptions {
  /// How far from the noise two patches may be and still count as equal; scales both bandwidths.
  float strength = 1;
  /// Filters irradiance instead of colour. For pictures that exposure has bent, where colour is not
  /// proportional to albedo any more, leave it off.
  bool divide_by_albedo = true;
  bool spread_outliers = true;  ///< see spread_outliers()
};

/// The picture without noise.
///
/// Model:   first-order regression of colour on position, albedo, normal and depth in a window of
///          19 x 19 pixels, weighted by how alike 7 x 7 patches are (non-local means with the noise
///          cancelled). Each half of the samples is weighed by patches of the other half, so that
///          noise does not vouch for itself; of two bandwidths each region takes the one whose
///          result predicts the other half better. Where only the variance is known the picture
///          weighs itself. The result is the input plus a correction that is exactly 0 where there
///          is nothing to correct. Features are taken as they are: blur of lens and motion must
///          have converged in them.
/// Returns: as many channels as color; not finite values count as black. The same bytes for any
///          number of threads.
/// Errors:  std::runtime_error when sizes differ, colour is missing, or nothing tells the noise.
/// Source:  B. Bitterli, F. Rousselle, B. Moon et al., "Nonlinearly Weighted First-order Regression
///          for Denoising Monte Carlo Renderings", CGF 35(4), 2016; F. Rousselle, C. Knaus,
///          M. Zwicker, "Adaptive Rendering with Non-Local Means Filtering", TOG 31(6), 2012.
/// Checked: Denoise.*
Image denoise(const DenoiseInput& input, const DenoiseOptions& options = {});

/// The picture with the light of outliers spread over their neighbourhood.
///
/// Model:   an outlier is a pixel whose error is at least kOutlierError of its value and which is
///          kOutlierFactor times as bright as all but kOutlierPeers of its 24 neighbours: one rare
///          sample made it. Its excess is added to the neighbourhood in proportion to brightness
///          and nearness, so the sum of the picture does not change. The more samples, the smaller
///          the error: the limit is the picture itself.
/// Inputs:  colour, and half_difference or variance; the rest is not read.
/// Returns: RGB; pixels that no outlier changed have the bytes of the input.
/// Errors:  as denoise().
/// Checked: Outliers.* in outliers_test.cpp
Image spread_outliers(const DenoiseInput& input);

/// The input that the layers of a render hold: beauty, halves, variance, albedo, normal, Z. It
/// refers to them, and is incomplete where they are.
DenoiseInput denoise_input(const std::vector<Layer>& layers);

}  // namespace oriel
