// SPDX-License-Identifier: Apache-2.0
#include "denoise/denoise_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/math.h"
#include "base/parallel.h"
#include "base/vec.h"

namespace oriel::denoising {
namespace {

/// Minimum albedo for the division; darker surfaces have no meaningful irradiance.
constexpr float kSmallestAlbedo = 0.05f;

/// Scale of the logarithm of depth; with it a ratio of 1.25 counts as much as an angle of 60
/// degrees between normals.
constexpr float kDepthScale = 4;
/// Log-depth difference between background and the farthest hit.
constexpr float kNothing = 1;

/// Radius for smoothing the variance, and radius for scaling it to the variance of the halves.
/// Stratified samples converge faster than their sample variance suggests.
/// Source:  method of Rousselle et al. 2012; the radii average 9 and 441 pixels, which leaves 33 %
///          and 5 % noise in a variance.
constexpr int kVarianceRadius = 1, kLevelRadius = 10;

Planes read(const Image* image, int channels) {
  if (!image) return {};
  Planes out(image->width, image->height, channels);
  parallel_for(std::size_t(image->height), [&](std::size_t y) {
    for (int c = 0; c < channels; ++c)
      for (int x = 0; x < image->width; ++x) {
        const float v = image->at(x, int(y))[c];
        out.row(c, int(y))[x] = std::isfinite(v) ? v : 0.0f;
      }
  });
  return out;
}

void check(const DenoiseInput& input) {
  if (!input.color || input.color->empty())
    throw std::runtime_error("denoising requires a colour layer");
  if (!input.half_difference && !input.variance)
    throw std::runtime_error("denoising requires a noise estimate: the layer halves or variance");
  const auto fits = [&](const Image* image, int channels, const char* what) {
    if (image && (image->width != input.color->width || image->height != input.color->height ||
                  image->channels < channels))
      throw std::runtime_error(std::string("denoising: the layer ") + what +
                               " differs from colour in size, or has too few channels");
  };
  fits(input.color, 3, "colour");
  fits(input.half_difference, 3, "half differences");
  fits(input.variance, 3, "variance");
  fits(input.albedo, 3, "albedo");
  fits(input.normal, 3, "normals");
  fits(input.depth, 1, "depth");
  for (const Image* part : input.parts) fits(part, 3, "a light group");
}

Planes read_features(const DenoiseInput& input) {
  Planes out(input.color->width, input.color->height, kFeatures);
  const auto copy = [&](const Planes& from, int first) {
    std::copy(from.values.begin(), from.values.end(), out.plane(first));
  };
  if (input.albedo) copy(read(input.albedo, 3), 0);
  if (input.normal) copy(read(input.normal, 3), 3);
  if (input.depth) {
    Planes depth = read(input.depth, 1);
    const float furthest = *std::max_element(depth.values.begin(), depth.values.end());
    const float nothing = furthest > 0 ? math::log(furthest) + kNothing : 0.0f;
    for (float& d : depth.values) d = kDepthScale * (d > 0 ? math::log(d) : nothing);
    copy(depth, 6);
  }
  return out;
}

void divide_by_albedo(Noisy& n) {
  for (std::size_t i = 0; i < n.mean.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float albedo = n.features.plane(c)[i];
      const float divisor = albedo > kSmallestAlbedo ? albedo : kSmallestAlbedo;
      n.albedo.plane(c)[i] = divisor;
      n.mean.plane(c)[i] /= divisor;
      if (n.half.count) n.half.plane(c)[i] /= divisor;
      if (n.variance.count) n.variance.plane(c)[i] /= divisor * divisor;
    }
}

/// Variance of the mean: spatial distribution from the sample variance, scale from the halves.
Planes estimate_variance(const Noisy& n) {
  if (!n.half.count) return n.variance;
  Planes squares = n.half;
  for (float& v : squares.values) v *= v;
  if (!n.variance.count) return box_blur(squares, kVarianceRadius + 1);
  Planes out = n.variance;
  const Planes shown = box_blur(squares, kLevelRadius), told = box_blur(out, kLevelRadius);
  const Planes smooth = box_blur(out, kVarianceRadius);
  for (std::size_t i = 0; i < out.values.size(); ++i)
    if (told.values[i] > 0)
      out.values[i] =
          (out.values[i] + smooth.values[i]) / 2 * std::min(shown.values[i] / told.values[i], 2.0f);
  return out;
}

}  // namespace

Planes box_blur(const Planes& planes, int radius) {
  Planes across(planes.width, planes.height, planes.count), out = across;
  const std::size_t rows = std::size_t(planes.height) * planes.count;
  // Plain sums: running sums would carry rounding errors of bright pixels into dark ones.
  parallel_for(rows, [&](std::size_t row) {
    const float* from = planes.values.data() + row * planes.width;
    float* to = across.values.data() + row * planes.width;
    for (int x = 0; x < planes.width; ++x) {
      const int first = std::max(x - radius, 0), last = std::min(x + radius, planes.width - 1);
      float sum = 0;
      for (int i = first; i <= last; ++i) sum += from[i];
      to[x] = sum / float(last - first + 1);
    }
  });
  parallel_for(rows, [&](std::size_t row) {
    const int y = int(row % planes.height), c = int(row / planes.height);
    const int first = std::max(y - radius, 0), last = std::min(y + radius, planes.height - 1);
    float* to = out.row(c, y);
    for (int i = first; i <= last; ++i) {
      const float* from = across.row(c, i);
      for (int x = 0; x < planes.width; ++x) to[x] += from[x];
    }
    for (int x = 0; x < planes.width; ++x) to[x] /= float(last - first + 1);
  });
  return out;
}

Planes at_half_size(const Planes& planes) {
  Planes out((planes.width + 1) / 2, (planes.height + 1) / 2, planes.count);
  const std::size_t rows = std::size_t(out.height) * out.count;
  parallel_for(rows, [&](std::size_t row) {
    const int y = int(row % out.height), c = int(row / out.height);
    const float* above = planes.row(c, 2 * y);
    const float* below = planes.row(c, std::min(2 * y + 1, planes.height - 1));
    float* to = out.row(c, y);
    for (int x = 0; x < out.width; ++x) {
      const int left = 2 * x, right = std::min(left + 1, planes.width - 1);
      to[x] = (above[left] + above[right] + below[left] + below[right]) / 4;
    }
  });
  return out;
}

Planes at_size(const Planes& half_size, int width, int height) {
  // Of a pixel, those of half the size on both sides of its centre, and the weight of the second.
  struct Around {
    int first, second;
    float weight;
    Around(int at, int size)
        : first(std::max((at - 1) >> 1, 0)),
          second(std::min((at + 1) / 2, size - 1)),
          weight(at % 2 == 0 ? 0.75f : 0.25f) {}
  };
  Planes out(width, height, half_size.count);
  const std::size_t rows = std::size_t(height) * out.count;
  parallel_for(rows, [&](std::size_t row) {
    const int c = int(row / height);
    const Around v(int(row % height), half_size.height);
    const float* above = half_size.row(c, v.first);
    const float* below = half_size.row(c, v.second);
    float* to = out.row(c, int(row % height));
    for (int x = 0; x < width; ++x) {
      const Around u(x, half_size.width);
      const float left = lerp(above[u.first], below[u.first], v.weight);
      to[x] = lerp(left, lerp(above[u.second], below[u.second], v.weight), u.weight);
    }
  });
  return out;
}

Noisy at_half_size(const Noisy& noisy) {
  Noisy out;
  out.mean = at_half_size(noisy.mean);
  if (noisy.half.count) out.half = at_half_size(noisy.half);
  out.variance = at_half_size(noisy.variance);
  for (float& v : out.variance.values) v /= 4;  // the noise of pixels is independent
  out.features = at_half_size(noisy.features);
  return out;
}

Noisy read_noisy(const DenoiseInput& input) {
  check(input);
  Noisy n;
  n.color = read(input.color, 3);
  n.half = read(input.half_difference, 3);
  n.variance = read(input.variance, 3);
  for (const Image* part : input.parts) n.parts.push_back(read(part, 3));
  for (float& v : n.variance.values) v = std::max(v, 0.0f);
  return n;
}

Noisy prepare(const DenoiseInput& input, const DenoiseOptions& options) {
  Noisy n = read_noisy(input);
  n.features = read_features(input);
  if (options.spread_outliers) spread_outliers(n);
  n.mean = n.color;
  n.albedo = Planes(n.mean.width, n.mean.height, 3, 1);
  if (input.albedo && options.divide_by_albedo) divide_by_albedo(n);
  n.variance = estimate_variance(n);
  return n;
}

}  // namespace oriel::denoising
