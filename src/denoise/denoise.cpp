// SPDX-License-Identifier: Apache-2.0
#include "denoise/denoise.h"

#include <algorithm>
#include <array>

#include "base/parallel.h"
#include "denoise/denoise_planes.h"
#include "denoise/denoise_regression.h"

namespace oriel {
namespace {

using denoising::Estimate;
using denoising::kBandwidths;
using denoising::Noisy;
using denoising::Planes;

/// The bandwidth is selected by the mean error within the first radius, since errors of single
/// pixels are too noisy; the selection is then blurred with the second radius.
constexpr int kErrorRadius = 4, kChoiceRadius = 2;
/// Bandwidth without an error estimate: the wider one, because a picture that is its own guide fits
/// its own noise too closely.
constexpr int kBandwidthAlone = 1;

/// f(i) for every value of every plane, in parallel.
template <class F>
void for_each_value(const Planes& planes, const F& f) {
  const std::size_t rows = std::size_t(planes.height) * planes.count;
  parallel_for(rows, [&](std::size_t row) {
    for (std::size_t i = row * planes.width; i < (row + 1) * planes.width; ++i) f(i);
  });
}

/// The mean of one half of the samples, with twice the variance of the whole.
Estimate half_of(const Noisy& noisy, float sign) {
  Estimate e{noisy.mean, noisy.variance};
  for_each_value(e.mean, [&](std::size_t i) {
    e.mean.values[i] += sign * noisy.half.values[i];
    e.variance.values[i] *= 2;
  });
  return e;
}

/// Excess squared error of the wider bandwidth against the other half, in units of variance.
Planes excess_of_wider(const Estimate& a, const Estimate& b,
                       const std::array<Planes, kBandwidths>& to_a,
                       const std::array<Planes, kBandwidths>& to_b) {
  Planes excess(a.mean.width, a.mean.height, 1);
  for_each_value(excess, [&](std::size_t i) {
    for (int c = 0; c < 3; ++c) {
      const std::size_t k = c * excess.size() + i;
      const auto error = [&](int width) {
        const float difference = a.mean.values[k] - b.mean.values[k];
        const float of_a = difference + to_a[width].values[k];
        const float of_b = difference - to_b[width].values[k];
        return of_a * of_a + of_b * of_b;
      };
      const float level = a.mean.values[k] * a.mean.values[k] + b.mean.values[k] * b.mean.values[k];
      excess.values[i] += (error(1) - error(0)) /
                          (a.variance.values[k] + b.variance.values[k] + 1e-6f * level + 1e-30f);
    }
  });
  return denoising::box_blur(excess, kErrorRadius);
}

/// Denoises each half with the other half as the guide.
Planes cross_filtered(const Noisy& noisy, float strength) {
  const Estimate a = half_of(noisy, 1), b = half_of(noisy, -1);
  const auto to_a = denoising::regress(a, b, noisy.features, strength);
  const auto to_b = denoising::regress(b, a, noisy.features, strength);
  Planes choice = excess_of_wider(a, b, to_a, to_b);
  for_each_value(choice, [&](std::size_t i) { choice.values[i] = choice.values[i] < 0 ? 1 : 0; });
  choice = denoising::box_blur(choice, kChoiceRadius);

  Planes out(a.mean.width, a.mean.height, 3);
  for_each_value(out, [&](std::size_t i) {
    const float wide = choice.values[i % choice.size()];
    const float narrow_correction = to_a[0].values[i] + to_b[0].values[i];
    const float wide_correction = to_a[1].values[i] + to_b[1].values[i];
    out.values[i] = ((1 - wide) * narrow_correction + wide * wide_correction) / 2;
  });
  return out;
}

Planes self_filtered(const Noisy& noisy, float strength) {
  const Estimate whole{noisy.mean, noisy.variance};
  return denoising::regress(whole, whole, noisy.features, strength)[kBandwidthAlone];
}

}  // namespace

DenoiseInput denoise_input(const std::vector<Layer>& layers) {
  const auto image = [&](const char* name) {
    const Layer* layer = find_layer(layers, name);
    return layer ? &layer->image : nullptr;
  };
  const Layer* beauty = find_linear_beauty(layers);
  return {beauty ? &beauty->image : nullptr,
          image("halves"),
          image("variance"),
          image("albedo"),
          image("normal"),
          image("Z")};
}

Image denoise(const DenoiseInput& input, const DenoiseOptions& options) {
  const Noisy noisy = denoising::prepare(input, options);
  const Planes correction = noisy.half.count > 0 ? cross_filtered(noisy, options.strength)
                                                 : self_filtered(noisy, options.strength);
  Image out = *input.color;
  parallel_for(std::size_t(out.height), [&](std::size_t row) {
    for (int x = 0; x < out.width; ++x) {
      const int y = int(row);
      float* to = out.at(x, y);
      for (int c = 0; c < 3; ++c) {
        const float divisor = noisy.albedo.row(c, y)[x];
        const float before = noisy.color.row(c, y)[x];
        const float change = correction.row(c, y)[x];
        // Clamp to non-negative values; a linear fit may be negative near a steep edge.
        to[c] = std::max(before + change * divisor, std::min(before, 0.0f));
      }
    }
  });
  return out;
}

}  // namespace oriel
