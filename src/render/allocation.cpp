// SPDX-License-Identifier: Apache-2.0
#include "render/allocation.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace oriel {
namespace {

/// Pixels whose sums one thread computes; independent of the number of threads, as are the sums.
constexpr std::size_t kPixelsOfSum = 4096;

/// Halvings of the interval, on a logarithmic scale, in which the factor is sought.
constexpr int kHalvings = 48;

/// Samples of all pixels, and squared noise summed over them; double: sums of millions of terms.
struct AllocationSums {
  double samples = 0, squared_noise = 0;
};

std::uint32_t most_samples(const PixelDemand& pixel, const AllocationLimits& limits) {
  const std::uint64_t most = std::uint64_t{pixel.samples} * limits.pixel_growth;
  return std::max(static_cast<std::uint32_t>(std::min<std::uint64_t>(most, limits.max_samples)),
                  pixel.samples);
}

/// The samples of a pixel for the factor, to the nearest block.
std::uint32_t samples_for(const PixelDemand& pixel, double factor, const AllocationLimits& limits) {
  const std::uint32_t most = most_samples(pixel, limits);
  const double wanted = factor * std::sqrt(double{pixel.variance});
  if (!(wanted > pixel.samples)) return pixel.samples;
  if (wanted >= most) return most;
  const auto blocks = static_cast<std::uint32_t>(std::lround(wanted / limits.block));
  return std::clamp(blocks * limits.block, pixel.samples, most);
}

AllocationSums sums_for(const std::vector<PixelDemand>& pixels, double factor,
                        const AllocationLimits& limits) {
  std::vector<AllocationSums> parts((pixels.size() + kPixelsOfSum - 1) / kPixelsOfSum);
  parallel_for(parts.size(), [&](std::size_t k) {
    const std::size_t end = std::min((k + 1) * kPixelsOfSum, pixels.size());
    for (std::size_t i = k * kPixelsOfSum; i < end; ++i) {
      const double samples = samples_for(pixels[i], factor, limits);
      parts[k].samples += samples;
      parts[k].squared_noise += pixels[i].variance / samples;
    }
  });
  AllocationSums sum;
  for (const AllocationSums& part : parts)
    sum.samples += part.samples, sum.squared_noise += part.squared_noise;
  return sum;
}

/// Sums over windows of a row or column, clipped at its ends.
void sum_windows(const float* from, float* to, int count, std::size_t step, int radius) {
  for (int i = 0; i < count; ++i) {
    const int first = std::max(i - radius, 0), last = std::min(i + radius, count - 1);
    float sum = 0;
    for (int k = first; k <= last; ++k) sum += from[static_cast<std::size_t>(k) * step];
    to[static_cast<std::size_t>(i) * step] = sum;
  }
}

/// Replaces each value by mean(value, sum over the square around it, number of pixels in the
/// square).
template <class Mean>
void replace_by_squares(std::vector<float>& values, int width, int height, int radius,
                        const Mean& mean) {
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  std::vector<float> across(values.size()), sums(values.size());
  parallel_for(rows, [&](std::size_t y) {
    sum_windows(&values[y * columns], &across[y * columns], width, 1, radius);
  });
  parallel_for(columns,
               [&](std::size_t x) { sum_windows(&across[x], &sums[x], height, columns, radius); });
  const auto length = [radius](std::size_t at, int count) {
    const int i = static_cast<int>(at);
    return std::min(i + radius, count - 1) - std::max(i - radius, 0) + 1;
  };
  parallel_for(rows, [&](std::size_t y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const std::size_t i = y * columns + x;
      values[i] = mean(values[i], sums[i], length(x, width) * length(y, height));
    }
  });
}

}  // namespace

void blur_square(std::vector<float>& values, int width, int height, int radius) {
  replace_by_squares(values, width, height, radius,
                     [](float, float sum, int pixels) { return sum / static_cast<float>(pixels); });
}

void average_neighbours(std::vector<float>& values, int width, int height, int radius) {
  replace_by_squares(values, width, height, radius, [](float own, float sum, int pixels) {
    // The difference may be below 0 by rounding.
    return pixels > 1 ? std::max(sum - own, 0.0f) / static_cast<float>(pixels - 1) : own;
  });
}

std::vector<std::uint32_t> allocate_samples(const std::vector<PixelDemand>& pixels,
                                            const AllocationLimits& limits) {
  // Factors that give no pixel more samples, and each pixel the most.
  double low = 0, high = 0, drawn = 0;
  for (const PixelDemand& pixel : pixels) {
    drawn += pixel.samples;
    const std::uint32_t most = most_samples(pixel, limits);
    const double deviation = std::sqrt(double{pixel.variance});
    if (!(deviation > 0) || most == pixel.samples) continue;
    const double least = pixel.samples / deviation;
    low = low > 0 ? std::min(low, least) : least;
    high = std::max(high, most / deviation);
  }
  const auto reached = [&](double factor) {
    const AllocationSums sum = sums_for(pixels, factor, limits);
    return sum.samples > drawn && sum.samples >= limits.least_growth * drawn &&
           (sum.samples >= limits.growth * drawn ||
            sum.squared_noise <= limits.squared_noise * static_cast<double>(pixels.size()));
  };
  for (int i = 0; i < kHalvings && low < high; ++i) {
    const double middle = std::sqrt(low * high);
    (reached(middle) ? high : low) = middle;
  }
  std::vector<std::uint32_t> samples(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) samples[i] = samples_for(pixels[i], high, limits);
  return samples;
}

}  // namespace oriel
