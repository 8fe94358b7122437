// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "denoise/denoise_planes.h"

namespace oriel {
namespace denoising {
namespace {

/// See oriel::spread_outliers(). A pixel that is bright in truth is so in many samples.
constexpr float kOutlierError = 0.3f, kOutlierFactor = 1.5f;
constexpr int kOutlierPeers = 2;

/// Half the side of the window that gets the excess; it doubles from the first to the last size
/// until the window becomes brighter by at most kMaxGain.
constexpr int kFirstRadius = 6, kLastRadius = 48;
constexpr float kMaxGain = 0.1f;

float sum3(const Planes& p, std::size_t i) { return p.plane(0)[i] + p.plane(1)[i] + p.plane(2)[i]; }

/// The share of a pixel that is no outlier; 1 = all of it.
float kept_share(const Noisy& n, int x, int y) {
  const std::size_t i = std::size_t(y) * n.color.width + x;
  const float own = sum3(n.color, i);
  float error = n.variance.count ? sum3(n.variance, i) : 0.0f;
  if (n.half.count) {
    const float half = std::abs(sum3(n.half, i));
    error = std::max(error, half * half / 3);
  }
  if (!(own > 0) || 3 * error < kOutlierError * kOutlierError * own * own) return 1;
  std::array<float, kOutlierPeers + 1> brightest = {};  // in falling order
  for (int v = std::max(y - 2, 0); v <= std::min(y + 2, n.color.height - 1); ++v)
    for (int u = std::max(x - 2, 0); u <= std::min(x + 2, n.color.width - 1); ++u) {
      if (u == x && v == y) continue;
      float b = sum3(n.color, std::size_t(v) * n.color.width + u);
      for (float& rank : brightest)
        if (b > rank) std::swap(b, rank);
    }
  // A rare sample is in one half only.
  const float both = n.half.count ? own - std::abs(sum3(n.half, i)) : 0.0f;
  const float limit = std::max(kOutlierFactor * brightest.back(), both);
  return own > limit ? limit / own : 1;
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
