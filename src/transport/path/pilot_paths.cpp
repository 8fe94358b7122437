// SPDX-License-Identifier: Apache-2.0
#include "transport/path/pilot_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "color/luminance.h"

namespace oriel {
namespace {

constexpr std::size_t kPixelsOfGroup = 64;
/// Samples are limited to this many times the mean of all, and the light of a part of the picture
/// counts as at least this share of it.
constexpr float kBrightest = 256, kDarkest = 0.1f;
/// Parts along each side of the picture, whose mean light differences are relative to.
constexpr std::size_t kParts = 8;
/// Cost of a shadow ray in rays of paths, which are followed by the shading of a surface.
constexpr double kShadowCost = 0.5;

struct Pilot {
  std::size_t part = 0;
  /// Luminance of two samples for each of the two settings.
  std::array<std::array<float, 2>, 2> light{};
  std::array<RayCounts, 2> counts;
};

Pilot trace_pilot(const World& world, const Window& window,
                  const std::array<const PathSettings*, 2>& settings, std::uint32_t pixel,
                  std::uint32_t seed) {
  Pilot pilot;
  sampling::Sampler place(1, 0, pixel, seed);
  const Vec2 u = place.next_2d();
  const Vec2 raster(static_cast<float>(window.x0) + u.x * static_cast<float>(window.width()),
                    static_cast<float>(window.y0) + u.y * static_cast<float>(window.height()));
  const auto along = [](float x) {
    return std::min(static_cast<std::size_t>(x * kParts), kParts - 1);
  };
  pilot.part = along(u.y) * kParts + along(u.x);
  const Camera::Ray eye = world.camera.ray(raster);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::uint32_t i = 0; i < 2; ++i) {
      sampling::Sampler sampler(static_cast<int>(pixel), static_cast<int>(k), i, seed);
      const PathResult path =
          trace_path(world, eye, raster, *settings[k], sampler, pilot.counts[k]);
      const float light = luminance(path.radiance);
      pilot.light[k][i] = std::isfinite(light) ? std::max(0.0f, light) : 0;
    }
  return pilot;
}

double cost_of(const RayCounts& counts) {
  return static_cast<double>(counts.eye + counts.reflect + counts.refract + counts.gather) +
         kShadowCost * static_cast<double>(counts.shadow);
}

}  // namespace

float efficiency_ratio(const World& world, const Window& window, const PathSettings& a,
                       const PathSettings& b, std::uint32_t seed, RayCounts& counts,
                       std::size_t pixels) {
  if (window.width() <= 0 || window.height() <= 0) return 1;
  const std::array<const PathSettings*, 2> settings{&a, &b};
  std::vector<Pilot> pilots(pixels);
  parallel_for(pixels / kPixelsOfGroup, [&](std::size_t group) {
    for (std::size_t i = group * kPixelsOfGroup; i < (group + 1) * kPixelsOfGroup; ++i)
      pilots[i] = trace_pilot(world, window, settings, static_cast<std::uint32_t>(i), seed);
  });
  double sum = 0;  // double: thousands of terms
  std::array<RayCounts, 2> rays;
  for (const Pilot& pilot : pilots)
    for (std::size_t k = 0; k < 2; ++k) {
      sum += static_cast<double>(pilot.light[k][0] + pilot.light[k][1]);
      rays[k] += pilot.counts[k];
    }
  for (const RayCounts& of_settings : rays) counts += of_settings;
  const float mean = static_cast<float>(sum / (4 * static_cast<double>(pixels))),
              limit = kBrightest * mean;
  if (!(mean > 0)) return 1;
  std::array<double, kParts * kParts> of_part{}, samples{};
  for (Pilot& pilot : pilots)
    for (auto& pair : pilot.light)
      for (float& light : pair) {
        light = std::min(light, limit);
        of_part[pilot.part] += static_cast<double>(light);
        ++samples[pilot.part];
      }
  std::array<double, 2> noise{};
  for (const Pilot& pilot : pilots) {
    const double level = of_part[pilot.part] / samples[pilot.part] + kDarkest * mean;
    for (std::size_t k = 0; k < 2; ++k) {
      const double difference = static_cast<double>(pilot.light[k][0] - pilot.light[k][1]) / level;
      noise[k] += difference * difference;
    }
  }
  const double of_a = noise[0] * cost_of(rays[0]), of_b = noise[1] * cost_of(rays[1]);
  return of_a > 0 ? static_cast<float>(of_b / of_a) : of_b > 0 ? kBrightest : 1.0f;
}

}  // namespace oriel
