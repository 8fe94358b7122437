// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/guide_points.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "color/luminance.h"
#include "lights/light_sampler.h"
#include "transport/estimator.h"

namespace oriel {
namespace {

/// Stream number of the rays.
constexpr int kGuideColumn = 0x677569;
/// Places per cell of the square at which the light of strata is read, on the average.
constexpr float kPlacesPerCell = 8;

/// Share of the environment in a direction that only rays find.
float environment_share(const World& world, const GatherPoint& at, const Vec3& direction) {
  LitVertex lit(world, at.point, Closure());
  lit.environment_samples = world.light_sampler->environment_samples(lit, true, false);
  if (!(lit.environment_samples > 0)) return 1;
  const auto found = world.light_sampler->find_environment(
      &lit, {.origin = at.point.position, .direction = direction});
  const float pdf = sampling::cosine_hemisphere_pdf(dot(direction, at.normal));
  return bsdf_sample_weight(Estimator::Mis, pdf, found.pdf);
}

/// The light of the strata on the square.
GuidePoint on_square(const World& world, const GatherPoint& at, const GatherRays& rays) {
  GuidePoint point{at.point.position, at.normal};
  const Frame frame = guide_frame(at.normal);
  const int strata = rays.hemisphere.count();
  const int side = std::max(
      1, static_cast<int>(std::ceil(std::sqrt(kPlacesPerCell * kGuideCells / float(strata)))));
  GuideSquare places{};
  for (int i = 0; i < strata; ++i) {
    const GatherSample& sample = rays.samples[static_cast<std::size_t>(i)];
    float light = luminance(sample.radiance);
    if (light > 0 && sample.distance >= kGatherFarthest)
      light *= environment_share(world, at, sample.direction);
    if (!std::isfinite(light)) light = 0;
    for (int k = 0; k < side * side; ++k) {
      const int row = k / side, column = k % side;
      const Vec2 u((float(column) + 0.5f) / float(side), (float(row) + 0.5f) / float(side));
      const Vec3 w = rays.hemisphere.direction(i, u);
      const std::size_t cell =
          guide_cell(sampling::square_of_disc(Vec2(dot(w, frame.s), dot(w, frame.t))));
      point.light[cell] += light;
      ++places[cell];
    }
  }
  for (std::size_t cell = 0; cell < kGuideCells; ++cell)
    if (places[cell] > 0) point.light[cell] /= places[cell];
  return point;
}

}  // namespace

std::vector<GuidePoint> guide_points(const World& world, const Bounces& coarse,
                                     const GatherSettings& settings, int rays, std::uint32_t seed,
                                     RayCounts& counts, const ProgressMonitor& monitor) {
  IndirectCaches maps;
  maps.bounces = &coarse.cache;
  maps.bounces_query = coarse.query;
  maps.bounces_held = coarse.held;
  GatherSettings of_rays = settings;
  of_rays.rays = rays;
  of_rays.path.maps = &maps;
  of_rays.path.diffuse_bounces = coarse.held;
  std::vector<GuidePoint> points(coarse.points.size());
  std::vector<RayCounts> traced(points.size());
  parallel_for(points.size(), [&](std::size_t i) {
    if (monitor.cancelled()) return;
    const sampling::Sampler stream(kGuideColumn, static_cast<int>(i), 0, seed);
    points[i] =
        on_square(world, coarse.points[i],
                  trace_gather_rays(world, coarse.points[i], of_rays, stream, traced[i], false));
  });
  for (const RayCounts& of_point : traced) counts += of_point;
  return monitor.cancelled() ? std::vector<GuidePoint>() : points;
}

}  // namespace oriel
