// SPDX-License-Identifier: Apache-2.0
// How many samples each pixel gets, from the errors of all pixels.
#pragma once

#include <cstdint>
#include <vector>

namespace oriel {

/// A pixel to allocate samples to.
struct PixelDemand {
  std::uint32_t samples = 0;  ///< drawn so far, at least 1
  float variance = 0;         ///< squared noise of one sample, that of n samples times n
};

/// Where an allocation ends.
struct AllocationLimits {
  double squared_noise = 0;        ///< target of the mean over pixels of variance / samples
  double least_growth = 1;         ///< least samples of all pixels, relative to those so far
  double growth = 1;               ///< the most of them
  std::uint32_t pixel_growth = 2;  ///< the same of each pixel
  std::uint32_t max_samples = 0;   ///< of each pixel
  std::uint32_t block = 16;        ///< samples of a pixel are multiples of it, or those so far
};

/// The number of samples that each pixel should reach.
///
/// Model:   samples in proportion to the root of the variance, which gives the least mean squared
///          error for a number of samples; between the samples so far and both limits of a
///          pixel; in blocks, since sample sequences are most uniform in powers of two.
///          The factor is the smallest that reaches the squared noise or the growth of all pixels,
///          and their least growth.
/// Returns: the samples so far if no pixel has variance and room for more.
/// Source:  J. Neyman, "On the Two Different Aspects of the Representative Method", J. Royal
///          Statistical Society 97, 1934 (optimum allocation).
/// Checked: Allocation.* in allocation_test.cpp
std::vector<std::uint32_t> allocate_samples(const std::vector<PixelDemand>& pixels,
                                            const AllocationLimits& limits);

/// Means over the square of 2 radius + 1 pixels around each pixel, clipped at the borders.
void blur_square(std::vector<float>& values, int width, int height, int radius);

/// The same without the pixel itself; its value if there are no others.
void average_neighbours(std::vector<float>& values, int width, int height, int radius);

}  // namespace oriel
