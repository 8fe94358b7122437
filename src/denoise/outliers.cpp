// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "denoise/denoise_planes.h"

namespace oriel {
namespace denoising {
namespace {

/// See oriel::spread_outliers(). An outlier has an error of at least kOutlierError of its value,
/// and is brighter by kOutlierFactor than all but two of the pixels around it.
constexpr float kOutlierError = 0.2f, kOutlierFactor = 1.35f;
constexpr int kOutlierPeers = 2, kOutlierRadius = 2;
/// Error, relative to the value, of a pixel that fewer than five of its samples made: k equal
/// samples among many black ones give 1/sqrt(k).
constexpr float kRareError = 0.45f;
/// A neighbour belongs to another surface if it is brighter by kOtherSurface and its error is below
/// kKnownError of its value.
constexpr float kOtherSurface = 2, kKnownError = 0.3f;

/// Half the side of the window that gets the excess; it doubles from the first to the last size
/// until the window becomes brighter by at most kMaxGain.
constexpr int kFirstRadius = 3, kLastRadius = 48;
constexpr float kMaxGain = 0.1f;

float sum3(const Planes& p, std::size_t i) { return p.plane(0)[i] + p.plane(1)[i] + p.plane(2)[i]; }

/// What is known of a pixel's brightness.
struct Brightness {
  float mean;
  float lower;  ///< mean of the darker half of the samples: a rare sample is in one half only
  float error;
};

Brightness brightness_of(const Noisy& n, std::size_t i) {
  const float mean = sum3(n.color, i);
  float lower = mean, variance = n.variance.count ? 3 * sum3(n.variance, i) : 0.0f;
  if (n.half.count) {
    const float half = std::abs(sum3(n.half, i));
    lower = std::max(mean - half, 0.0f);
    variance = std::max(variance, half * half);
  }
  return {mean, lower, std::sqrt(variance)};
}

/// The brightness from which on a pixel is brighter than its surface.
float limit_of(const Noisy& n, int x, int y, float lower) {
  constexpr int kSide = 2 * kOutlierRadius + 1;
  std::array<Brightness, kSide * kSide - 1> around;
  std::size_t count = 0;
  for (int v = std::max(y - kOutlierRadius, 0);
       v <= std::min(y + kOutlierRadius, n.color.height - 1); ++v)
    for (int u = std::max(x - kOutlierRadius, 0);
         u <= std::min(x + kOutlierRadius, n.color.width - 1); ++u)
      if (u != x || v != y) around[count++] = brightness_of(n, std::size_t(v) * n.color.width + u);
  const auto end = around.begin() + static_cast<std::ptrdiff_t>(count);
  std::sort(around.begin(), end,
            [](const Brightness& a, const Brightness& b) { return a.lower > b.lower; });
  const float surface = std::max(kOtherSurface * lower, count ? around[count / 2].lower : 0.0f);
  int peers = 0;
  for (auto other = around.begin(); other != end; ++other) {
    if (other->lower > surface && other->error < kKnownError * other->mean) continue;
    if (++peers > kOutlierPeers) return kOutlierFactor * other->lower;
  }
  return 0;
}

/// The share of a pixel that is no outlier; 1 = all of it.
float kept_share(const Noisy& n, int x, int y) {
  const Brightness own = brightness_of(n, std::size_t(y) * n.color.width + x);
  if (!(own.mean > 0) || own.error < kOutlierError * own.mean) return 1;
  float limit = limit_of(n, x, y, own.lower);
  if (n.half.count && own.error < kRareError * own.mean) limit = std::max(limit, own.lower);
  return own.mean > limit ? limit / own.mean : 1;
}

/// Weights of the pixels around one, in proportion to their brightness and to a tent.
struct Neighbourhood {
  int x, y, radius;
  double sum = 0;  ///< of the weights; double: up to ten thousand terms
  const std::vector<float>& brightness;
  int width, height;

  float weight(int u, int v) const {
    const auto distance = static_cast<float>(std::max(std::abs(u - x), std::abs(v - y)));
    return (1 - distance / static_cast<float>(radius + 1)) *
           brightness[std::size_t(v) * std::size_t(width) + std::size_t(u)];
  }
  template <class F>
  void for_each(const F& f) const {
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
      for (int u = std::max(x - radius, 0); u <= std::min(x + radius, width - 1); ++u) f(u, v);
  }
};

/// The smallest window that becomes brighter by at most kMaxGain, else the largest.
Neighbourhood neighbourhood(int x, int y, float light, const std::vector<float>& brightness,
                            int width, int height) {
  Neighbourhood around{x, y, kFirstRadius, 0, brightness, width, height};
  while (true) {
    around.sum = 0;
    around.for_each([&](int u, int v) { around.sum += around.weight(u, v); });
    if (light <= kMaxGain * around.sum || 2 * around.radius > kLastRadius) return around;
    around.radius *= 2;
  }
}

/// A pixel that keeps a share of its light and spreads the rest.
struct Outlier {
  std::size_t pixel;
  float kept;
  Neighbourhood around;
};

void move_light(const std::vector<Outlier>& outliers, Planes& planes) {
  std::vector<std::array<float, 3>> light(outliers.size());
  for (std::size_t i = 0; i < outliers.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      float& own = planes.plane(c)[outliers[i].pixel];
      light[i][c] = own * (1 - outliers[i].kept);
      own -= light[i][c];
    }
  for (std::size_t i = 0; i < outliers.size(); ++i) {
    const Neighbourhood& around = outliers[i].around;
    around.for_each([&](int u, int v) {
      const auto share = static_cast<float>(around.weight(u, v) / around.sum);
      for (int c = 0; c < 3; ++c) planes.row(c, v)[u] += light[i][c] * share;
    });
  }
}

}  // namespace

void spread_outliers(Noisy& n) {
  const int width = n.color.width, height = n.color.height;
  std::vector<float> kept(n.color.size(), 1), brightness(n.color.size());
  parallel_for(std::size_t(height), [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      kept[i] = kept_share(n, int(i % width), int(y));
      brightness[i] = std::max(sum3(n.color, i) * kept[i], 0.0f);
    }
  });
  std::vector<Outlier> outliers;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i] >= 1) continue;
    const float light = sum3(n.color, i) * (1 - kept[i]);
    const Neighbourhood around =
        neighbourhood(int(i % width), int(i / width), light, brightness, width, height);
    // In a black neighbourhood the light stays where it is.
    if (around.sum > 0) outliers.push_back({i, kept[i], around});
  }
  move_light(outliers, n.color);
  for (Planes& part : n.parts) move_light(outliers, part);
  for (const Outlier& outlier : outliers)
    for (int c = 0; c < 3; ++c) {
      if (n.half.count) n.half.plane(c)[outlier.pixel] *= outlier.kept;
      if (n.variance.count) n.variance.plane(c)[outlier.pixel] *= outlier.kept * outlier.kept;
    }
}

}  // namespace denoising

Image spread_outliers(const DenoiseInput& input) {
  denoising::Noisy n = denoising::read_noisy(input);
  denoising::spread_outliers(n);
  Image out(n.color.width, n.color.height, 3);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < 3; ++c) out.at(x, y)[c] = n.color.row(c, y)[x];
  return out;
}

}  // namespace oriel
