// SPDX-License-Identifier: Apache-2.0
#include "transport/path/pilot_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/parallel.h"
#include "color/luminance.h"

namespace oriel {
namespace {

constexpr std::size_t kPixelsOfGroup = 64;
/// Light of a sample is limited to this many times the mean of all. Noise is relative to the
/// pixel's light plus this share of the mean.
constexpr float kBrightest = 256, kDarkest = 0.03f;
/// Share of the pixels that noise is computed from; those with the largest differences are left
/// out, so that a few do not decide.
constexpr double kKeptShare = 0.99;
/// Cost of a shadow ray in rays of paths, which are followed by the shading of a surface.
constexpr double kShadowCost = 0.5;
/// Samples of a pixel are stratified, which reduces the noise of some settings more than that of
/// others.
constexpr std::uint32_t kSamplesOfMean = kPilotPathsOfPixel / 2;

std::array<Rgb, 2> trace_pilot(const World& world, const Window& window,
                               const PathSettings& settings, std::uint32_t pixel,
                               std::uint32_t seed, RayCounts& counts) {
  std::array<Rgb, 2> means{Rgb(0), Rgb(0)};
  sampling::Sampler place(1, 0, pixel, seed);
  const Vec2 u = place.next_2d();
  const auto place_of = [](float u, int from, int size) {
    return std::floor(static_cast<float>(from) + u * static_cast<float>(size));
  };
  const Vec2 corner(place_of(u.x, window.x0, window.width()),
                    place_of(u.y, window.y0, window.height()));
  for (std::uint32_t i = 0; i < 2; ++i)
    for (std::uint32_t sample = 0; sample < kSamplesOfMean; ++sample) {
      sampling::Sampler sampler(static_cast<int>(pixel), static_cast<int>(i), sample, seed);
      const Vec2 raster = corner + sampler.next_2d();
      const PathResult path =
          trace_path(world, world.camera.ray(raster), raster, settings, sampler, counts);
      if (std::isfinite(luminance(path.radiance))) means[i] += path.radiance / kSamplesOfMean;
    }
  return means;
}

double cost_of(const RayCounts& counts) {
  return static_cast<double>(counts.eye + counts.reflect + counts.refract + counts.gather) +
         kShadowCost * static_cast<double>(counts.shadow);
}

}  // namespace

PilotPaths::PilotPaths(const World& world, const Window& window, const PathSettings& settings,
                       std::uint32_t seed, RayCounts& counts, std::size_t pixels) {
  if (window.width() <= 0 || window.height() <= 0) return;
  pixels -= pixels % kPixelsOfGroup;
  pixels_.resize(pixels);
  std::vector<RayCounts> traced(pixels / kPixelsOfGroup);
  parallel_for(traced.size(), [&](std::size_t group) {
    for (std::size_t i = group * kPixelsOfGroup; i < (group + 1) * kPixelsOfGroup; ++i)
      pixels_[i] =
          trace_pilot(world, window, settings, static_cast<std::uint32_t>(i), seed, traced[group]);
  });
  for (const RayCounts& of_group : traced) {
    counts += of_group;
    cost_ += cost_of(of_group);
  }
}

double PilotPaths::noise_of(const Means& means, const Means& others, float mean_of_all) {
  double sum = 0;
  const float limit = kBrightest * mean_of_all;
  for (int c = 0; c < 3; ++c) {
    // The middle of the four means, which a single very bright path does not change.
    std::array levels{std::abs(means[0][c]), std::abs(means[1][c]), std::abs(others[0][c]),
                      std::abs(others[1][c])};
    std::sort(levels.begin(), levels.end());
    const float level = (levels[1] + levels[2]) / 2;
    const float difference =
        std::clamp(means[0][c], -limit, limit) - std::clamp(means[1][c], -limit, limit);
    const double relative = static_cast<double>(difference / (level + kDarkest * mean_of_all));
    sum += relative * relative / 3;
  }
  return sum;
}

PilotComparison PilotPaths::compare(const PilotPaths& others) const {
  const std::array<const PilotPaths*, 2> both{this, &others};
  double sum = 0;  // double: thousands of terms
  for (const PilotPaths* pilots : both)
    for (const Means& means : pilots->pixels_)
      for (const Rgb& light : means)
        sum += static_cast<double>(std::abs(light.x) + std::abs(light.y) + std::abs(light.z));
  if (!(sum > 0)) return {};
  const float mean_of_all = static_cast<float>(sum / (12 * static_cast<double>(pixels_.size())));
  std::array<double, 2> noise{};
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<double> of_pixels;
    for (std::size_t i = 0; i < pixels_.size(); ++i)
      of_pixels.push_back(noise_of(both[k]->pixels_[i], both[1 - k]->pixels_[i], mean_of_all));
    std::sort(of_pixels.begin(), of_pixels.end());
    const auto kept =
        static_cast<std::ptrdiff_t>(kKeptShare * static_cast<double>(of_pixels.size()));
    noise[k] = std::accumulate(of_pixels.begin(), of_pixels.begin() + kept, 0.0);
  }
  const auto ratio = [](double own, double of_others) {
    return own > 0 ? static_cast<float>(of_others / own) : of_others > 0 ? kBrightest : 1.0f;
  };
  return {ratio(noise[0], noise[1]), ratio(cost_, others.cost_)};
}

}  // namespace oriel
