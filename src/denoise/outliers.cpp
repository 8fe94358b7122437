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
  const float limit = kOutlierFactor * brightest.back();
  return own > limit ? limit / own : 1;
}

/// Adds the light to the window around a pixel, in proportion to what is there and to a tent.
void add_around(Planes& color, const std::vector<float>& brightness, int x, int y,
                const std::array<float, 3>& light) {
  const float total = light[0] + light[1] + light[2];
  for (int r = kFirstRadius;; r *= 2) {
    const int x0 = std::max(x - r, 0), x1 = std::min(x + r, color.width - 1);
    const int y0 = std::max(y - r, 0), y1 = std::min(y + r, color.height - 1);
    const auto weight = [&](int u, int v) {
      const auto distance = static_cast<float>(std::max(std::abs(u - x), std::abs(v - y)));
      return (1 - distance / static_cast<float>(r + 1)) *
             brightness[std::size_t(v) * color.width + u];
    };
    double sum = 0;  // double: up to ten thousand terms
    for (int v = y0; v <= y1; ++v)
      for (int u = x0; u <= x1; ++u) sum += weight(u, v);
    const bool last = 2 * r > kLastRadius;
    if (!last && !(total <= kMaxGain * sum)) continue;
    // In a black neighbourhood the light stays where it is.
    if (!(sum > 0)) {
      for (int c = 0; c < 3; ++c) color.row(c, y)[x] += light[c];
      return;
    }
    for (int v = y0; v <= y1; ++v)
      for (int u = x0; u <= x1; ++u) {
        const auto share = static_cast<float>(weight(u, v) / sum);
        for (int c = 0; c < 3; ++c) color.row(c, v)[u] += light[c] * share;
      }
    return;
  }
}

}  // namespace

void spread_outliers(Noisy& n) {
  std::vector<float> kept(n.color.size(), 1);
  parallel_for(std::size_t(n.color.height), [&](std::size_t row) {
    for (int x = 0; x < n.color.width; ++x)
      kept[row * n.color.width + x] = kept_share(n, x, int(row));
  });
  struct Excess {
    int x, y;
    std::array<float, 3> light;
  };
  std::vector<Excess> all;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i] >= 1) continue;
    Excess& e = all.emplace_back();
    e.x = int(i % n.color.width), e.y = int(i / n.color.width);
    for (int c = 0; c < 3; ++c) {
      float& own = n.color.plane(c)[i];
      e.light[c] = own * (1 - kept[i]);
      own -= e.light[c];
      if (n.half.count) n.half.plane(c)[i] *= kept[i];
      if (n.variance.count) n.variance.plane(c)[i] *= kept[i] * kept[i];
    }
  }
  std::vector<float> brightness(n.color.size());
  for (std::size_t i = 0; i < brightness.size(); ++i)
    brightness[i] = std::max(sum3(n.color, i), 0.0f);
  for (const Excess& e : all) add_around(n.color, brightness, e.x, e.y, e.light);
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
