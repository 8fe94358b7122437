// SPDX-License-Identifier: Apache-2.0
// Denoises a path-traced picture with feature layers of its first hits.
#pragma once

#include <string>
#include <vector>

#include "image/pixel_buffer.h"

namespace oriel {

/// Noise estimates and feature layers of a render. All images have the same size; null = not
/// available. At least one of half_difference and variance is required; both give the best result.
struct DenoiseInput {
  const Image* color = nullptr;  ///< linear, RGB first; further channels are copied
  /// half of (mean of one half of the samples - mean of the other)
  const Image* half_difference = nullptr;
  const Image* variance = nullptr;       ///< variance of the mean of each pixel, RGB
  const Image* albedo = nullptr;         ///< RGB, of the first surface
  const Image* normal = nullptr;         ///< XYZ, 0 = no hit
  const Image* depth = nullptr;          ///< 0 = no hit
  std::vector<const Image*> parts = {};  ///< light groups: RGB, they sum to the colour
};

enum class Denoiser {
  Own,   ///< see denoise(); same bytes on every machine
  Oidn,  ///< Open Image Denoise, see oidn.h
  Best   ///< Oidn if its library is there and works, else Own
};

/// Whether the library of Open Image Denoise is there.
bool has_oidn();

struct DenoiseOptions {
  Denoiser denoiser = Denoiser::Own;
  /// Patch difference, relative to noise, up to which patches count as equal; scales both
  /// bandwidths.
  float strength = 1;
  /// Denoises irradiance instead of colour. Disable it for tone-mapped pictures, where colour is
  /// not proportional to albedo.
  bool divide_by_albedo = true;
  bool spread_outliers = true;  ///< see spread_outliers()
};

/// Returns the denoised picture.
///
/// Model:   first-order regression of colour on position, albedo, normal and depth in a window of
///          15 x 15 pixels, weighted by the similarity of 7 x 7 patches (non-local means with noise
///          cancellation), of the picture and of those with half, a quarter... of its size, which
///          remove stains that are larger than the window. Each half of the samples is weighted by
///          patches of the other half, so that weights are independent of the noise. Of two
///          bandwidths each region uses the one that predicts the other half better. If only the
///          variance is available, the picture is its own guide. The result is the input plus a
///          correction, which is exactly 0 where the input is free of noise. Features are not
///          denoised, so depth of field and motion blur must have converged in them.
/// Returns: as many channels as color; values that are not finite count as black. The result does
///          not depend on the number of threads.
/// Errors:  std::runtime_error if sizes differ, colour is missing, or there is no noise estimate.
/// Source:  B. Bitterli, F. Rousselle, B. Moon et al., "Nonlinearly Weighted First-order Regression
///          for Denoising Monte Carlo Renderings", CGF 35(4), 2016; F. Rousselle, C. Knaus,
///          M. Zwicker, "Adaptive Rendering with Non-Local Means Filtering", TOG 31(6), 2012.
/// Checked: Denoise.*
Image denoise(const DenoiseInput& input, const DenoiseOptions& options = {});

struct DenoisedPicture {
  std::string denoiser;      ///< name and version of the one that was used
  std::string note;          ///< why Oidn was not used although its library is there, or empty
  Image color;               ///< see denoise()
  std::vector<Image> parts;  ///< of the input, RGB
};
/// Denoises the colour and its parts. The parts are filtered with the weights of the colour, and
/// sum to the denoised colour within rounding. With Open Image Denoise each part is denoised alone,
/// and changed in proportion to itself such that the sum holds.
///
/// Errors:  as denoise(); std::runtime_error if Oidn is asked for and not there or failing.
DenoisedPicture denoise_with_parts(const DenoiseInput& input, const DenoiseOptions& options = {});

/// The picture with the light of outliers spread over their neighbourhood.
///
/// Model:   an outlier is a pixel with an error of at least a fifth of its value that is brighter
///          than its surface, because few samples made it. The brightness of a surface is that of
///          the third brightest of the 24 neighbours, each as in the darker half of its samples,
///          without neighbours that are known to be much brighter: these are another surface. Light
///          of both halves stays if its error shows that at least five samples made it. The
///          excess is added to the neighbourhood in proportion to brightness and nearness, so the
///          sum of the picture does not change. The more samples, the smaller the error: the limit
///          is the picture itself.
/// Inputs:  colour, and half_difference or variance; the rest is not read.
/// Returns: RGB; pixels that no outlier changed have the bytes of the input.
/// Errors:  as denoise().
/// Checked: Outliers.* in outliers_test.cpp
Image spread_outliers(const DenoiseInput& input);

/// Finds the input layers of a render: beauty, halves, variance, albedo, normal, Z. The result
/// refers to them and is incomplete if layers are missing.
DenoiseInput denoise_input(const std::vector<Layer>& layers);

}  // namespace oriel
