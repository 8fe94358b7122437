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
constexpr std::uint32_t kSamplesOfMean = kPilotPathsOfPixel / 4;

struct Pilot {
  /// Two means of samples for each of the two settings.
  std::array<std::array<Rgb, 2>, 2> light{{{Rgb(0), Rgb(0)}, {Rgb(0), Rgb(0)}}};
  std::array<RayCounts, 2> counts;
};

Pilot trace_pilot(const World& world, const Window& window,
                  const std::array<const PathSettings*, 2>& settings, std::uint32_t pixel,
                  std::uint32_t seed) {
  Pilot pilot;
  sampling::Sampler place(1, 0, pixel, seed);
  const Vec2 u = place.next_2d();
  const auto place_of = [](float u, int from, int size) {
    return std::floor(static_cast<float>(from) + u * static_cast<float>(size));
  };
  const Vec2 corner(place_of(u.x, window.x0, window.width()),
                    place_of(u.y, window.y0, window.height()));
  for (std::size_t k = 0; k < 2; ++k)
    for (std::uint32_t i = 0; i < 2; ++i)
      for (std::uint32_t sample = 0; sample < kSamplesOfMean; ++sample) {
        sampling::Sampler sampler(static_cast<int>(pixel), static_cast<int>(i), sample, seed);
        const Vec2 raster = corner + sampler.next_2d();
        const PathResult path = trace_path(world, world.camera.ray(raster), raster, *settings[k],
                                           sampler, pilot.counts[k]);
        if (std::isfinite(luminance(path.radiance)))
          pilot.light[k][i] += path.radiance / kSamplesOfMean;
      }
  return pilot;
}

/// Squared difference of the two means of settings k, relative to the pixel, mean of the channels.
double noise_of(const Pilot& pilot, std::size_t k, float mean) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    float level = 0;
    for (const auto& of_settings : pilot.light)
      for (const Rgb& light : of_settings) level += std::abs(light[c]) / 4;
    const float limit = kBrightest * mean;
    const auto limited = [&](const Rgb& light) { return clamp(light[c], -limit, limit); };
    const float difference = limited(pilot.light[k][0]) - limited(pilot.light[k][1]);
    const double relative = static_cast<double>(difference / (level + kDarkest * mean));
    sum += relative * relative / 3;
  }
  return sum;
}

double cost_of(const RayCounts& counts) {
  return static_cast<double>(counts.eye + counts.reflect + counts.refract + counts.gather) +
         kShadowCost * static_cast<double>(counts.shadow);
}

}  // namespace

PilotComparison compare_pilots(const World& world, const Window& window, const PathSettings& a,
                               const PathSettings& b, std::uint32_t seed, RayCounts& counts,
                               std::size_t pixels) {
  if (window.width() <= 0 || window.height() <= 0) return {};
  const std::array<const PathSettings*, 2> settings{&a, &b};
  pixels -= pixels % kPixelsOfGroup;
  std::vector<Pilot> pilots(pixels);
  parallel_for(pixels / kPixelsOfGroup, [&](std::size_t group) {
    for (std::size_t i = group * kPixelsOfGroup; i < (group + 1) * kPixelsOfGroup; ++i)
      pilots[i] = trace_pilot(world, window, settings, static_cast<std::uint32_t>(i), seed);
  });
  double sum = 0;  // double: thousands of terms
  std::array<RayCounts, 2> rays;
  for (const Pilot& pilot : pilots)
    for (std::size_t k = 0; k < 2; ++k) {
      for (const Rgb& light : pilot.light[k])
        sum += static_cast<double>(std::abs(light.x) + std::abs(light.y) + std::abs(light.z));
      rays[k] += pilot.counts[k];
    }
  for (const RayCounts& of_settings : rays) counts += of_settings;
  const float mean = static_cast<float>(sum / (12 * static_cast<double>(pixels)));
  if (!(mean > 0)) return {};
  std::array<double, 2> noise{};
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<double> of_pixels;
    of_pixels.reserve(pilots.size());
    for (const Pilot& pilot : pilots) of_pixels.push_back(noise_of(pilot, k, mean));
    std::sort(of_pixels.begin(), of_pixels.end());
    const auto kept = static_cast<std::ptrdiff_t>(kKeptShare * static_cast<double>(pixels));
    noise[k] = std::accumulate(of_pixels.begin(), of_pixels.begin() + kept, 0.0);
  }
  const auto ratio = [](double of_a, double of_b) {
    return of_a > 0 ? static_cast<float>(of_b / of_a) : of_b > 0 ? kBrightest : 1.0f;
  };
  return {ratio(noise[0], noise[1]), ratio(cost_of(rays[0]), cost_of(rays[1]))};
}

}  // namespace oriel
