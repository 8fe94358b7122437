// SPDX-License-Identifier: Apache-2.0
// Data of the denoiser: planes of floats, and the noisy picture.
#pragma once

#include <cstddef>
#include <vector>

#include "base/parallel.h"
#include "denoise/denoise.h"

namespace oriel::denoising {

/// Planar channels, so that loops over the pixels of a row vectorise.
struct Planes {
  int width = 0, height = 0, count = 0;
  std::vector<float> values;

  Planes() = default;
  Planes(int w, int h, int n, float value = 0)
      : width(w), height(h), count(n), values(std::size_t(w) * h * n, value) {}
  std::size_t size() const { return std::size_t(width) * height; }
  float* plane(int i) { return values.data() + size() * i; }
  const float* plane(int i) const { return values.data() + size() * i; }
  float* row(int i, int y) { return plane(i) + std::size_t(y) * width; }
  const float* row(int i, int y) const { return plane(i) + std::size_t(y) * width; }
};

/// f(i) for every value of every plane, in parallel.
template <class F>
void for_each_value(const Planes& planes, const F& f) {
  const std::size_t rows = std::size_t(planes.height) * planes.count;
  parallel_for(rows, [&](std::size_t row) {
    for (std::size_t i = row * planes.width; i < (row + 1) * planes.width; ++i) f(i);
  });
}

/// Means over squares of 2 radius + 1 pixels, clipped at the border.
Planes box_blur(const Planes& planes, int radius);

/// Means of squares of 2 x 2 pixels; at odd sides the last row or column counts twice.
Planes at_half_size(const Planes& planes);
/// A picture of half the size, enlarged to `width` x `height` by bilinear interpolation.
Planes at_size(const Planes& half_size, int width, int height);

/// Albedo 3, normal 3, logarithm of depth.
inline constexpr int kFeatures = 7;

/// The preprocessed input of the regression.
struct Noisy {
  Planes color;               ///< 3: the input, without outliers
  Planes mean;                ///< 3: colour, or irradiance where albedo is divided out
  Planes half;                ///< 3: half the difference of the halves; empty: not known
  Planes variance;            ///< 3: of the mean
  Planes features;            ///< kFeatures, scaled such that a difference of 1 is large
  Planes albedo;              ///< 3: divisor of the mean
  std::vector<Planes> parts;  ///< 3 each: parts of the colour, not divided
};

/// Mean, halves, variance and features at half the size, for the regression.
Noisy at_half_size(const Noisy& noisy);
/// Reads colours, halves and variance: replaces values that are not finite.
Noisy read_noisy(const DenoiseInput& input);
/// Spreads the light of outliers, see oriel::spread_outliers(), and the same shares of the parts;
/// halves and variance are scaled with their pixel.
void spread_outliers(Noisy& n);
/// Reads the whole input: spreads outliers, divides by albedo, estimates the variance.
Noisy prepare(const DenoiseInput& input, const DenoiseOptions& options);

}  // namespace oriel::denoising
