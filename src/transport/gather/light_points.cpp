// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/light_points.h"

#include <cmath>

#include "base/parallel.h"
#include "color/luminance.h"
#include "lights/light_sampler.h"
#include "transport/shadow.h"

namespace oriel {
namespace {

/// Stream number of the samples.
constexpr int kLightColumn = 0x6c696774;

/// Mean square of the irradiance by samples of a light.
float mean_square(const World& world, const GatherPoint& at, int light, int samples,
                  sampling::Sampler& sampler, RayCounts& counts) {
  ShadingPoint point = at.point;
  float sum = 0;
  for (int i = 0; i < samples; ++i) {
    const auto s =
        sample_light(world.lights[static_cast<std::size_t>(light)], point, sampler.next_2d());
    if (!s) continue;
    const float cosine = dot(s->wi, at.normal);
    if (!(cosine > 0)) continue;
    const float unshadowed = luminance(s->irradiance) * cosine;
    if (!(unshadowed > 0)) continue;
    const Rgb open =
        s->shadow ? shadow_transmittance(world, point, s->wi, s->reach, counts, light).all : Rgb(1);
    const float value = unshadowed * lerp(luminance(open), 1.0f, s->shadow_factor);
    if (std::isfinite(value * value)) sum += value * value;
  }
  return sum / static_cast<float>(samples);
}

}  // namespace

LearnedLights measure_lights(const World& world, std::span<const GatherPoint> points, int samples,
                             std::uint32_t seed, RayCounts& counts) {
  const std::span<const int> lights = world.light_sampler->chosen_lights();
  if (lights.empty() || points.empty()) return {};
  std::vector<float> squares(points.size() * lights.size()), by_tree(squares.size());
  std::vector<SurfaceTree::Point> places(points.size());
  std::vector<RayCounts> traced(points.size());
  parallel_for(points.size(), [&](std::size_t i) {
    places[i] = {points[i].point.position, points[i].normal};
    sampling::Sampler sampler(kLightColumn, static_cast<int>(i), 0, seed);
    for (std::size_t k = 0; k < lights.size(); ++k)
      if (gives_direct_light(world.lights[static_cast<std::size_t>(lights[k])])) {
        const std::size_t at = i * lights.size() + k;
        squares[at] = mean_square(world, points[i], lights[k], samples, sampler, traced[i]);
        by_tree[at] = world.light_sampler->probability_by_tree(
            {places[i].position, places[i].normal}, lights[k]);
      }
  });
  for (const RayCounts& of_point : traced) counts += of_point;
  return {places, squares, by_tree};
}

}  // namespace oriel
