// SPDX-License-Identifier: Apache-2.0
#include "transport/gather_points.h"

#include <algorithm>
#include <cmath>

#include "transport/path_walk.h"

namespace oriel {
namespace {

/// Share of the scene's diagonal that a record may reach, and of that what it reaches at least,
/// where the scene does not say.
constexpr float kMaxRadius = 0.1f, kMinRadius = 0.1f;

}  // namespace

void visit_gather_points(const World& world, Vec2 raster, const PathSettings& settings,
                         sampling::Sampler& sampler, RayCounts& counts,
                         std::vector<GatherPoint>& points) {
  PathResult nothing;
  Path(world, raster, settings, sampler, counts, nothing).visit(world.camera.ray(raster), points);
}

GatherSettings gather_settings(const scene::FinalGatherOptions& options, float diagonal) {
  GatherSettings s;
  s.rays = std::max(options.rays, 4);
  s.filter = options.filter;
  s.reach = options.falloff_stop;
  s.radii.in_pixels = options.radius_in_pixels && options.max_radius > 0;
  s.radii.max = options.max_radius > 0 ? options.max_radius : kMaxRadius * diagonal;
  s.radii.min = options.min_radius > 0 ? options.min_radius : kMinRadius * s.radii.max;
  s.path.diffuse_bounces = std::max(0, options.depth.diffuse);
  return s;
}

GatherRecord gather_at(const World& world, const GatherPoint& at, const GatherSettings& settings,
                       const sampling::Sampler& sampler, RayCounts& counts) {
  sampling::Sampler turn = sampler;
  const int rays =
      std::max(4, static_cast<int>(std::lround(static_cast<float>(settings.rays) * at.quality)));
  const auto hemisphere = GatherHemisphere::for_rays(at.normal, rays, turn.next_1d());
  const float reach = settings.reach > 0 ? settings.reach : kInfinity;
  const float side = dot(at.normal, at.point.geometric_normal) < 0 ? -1.0f : 1.0f;
  std::vector<GatherSample> samples(static_cast<std::size_t>(hemisphere.count()));
  for (int i = 0; i < hemisphere.count(); ++i) {
    auto stream = sampler.split(static_cast<std::uint32_t>(i),
                                static_cast<std::uint32_t>(hemisphere.count()), 0);
    GatherSample& s = samples[static_cast<std::size_t>(i)];
    s.direction = hemisphere.direction(i, stream.next_2d());
    if (side * dot(s.direction, at.point.geometric_normal) <= 0) continue;
    const PathResult r =
        trace_gather_ray(world, at.point, s.direction, reach, settings.path, stream, counts);
    s.radiance = r.radiance;
    if (r.depth > 0) {
      s.distance = r.depth;
      s.normal = r.normal;
    }
  }
  return make_gather_record(at.point.position, hemisphere, samples,
                            settings.radii.in_scene(pixel_width(at.point)), settings.filter);
}

}  // namespace oriel
