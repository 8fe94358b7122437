// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/guide_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "color/luminance.h"
#include "lights/light_sampler.h"
#include "transport/estimator.h"

namespace oriel {
namespace {

/// Stream number of the rays.
constexpr int kGuideColumn = 0x677569;

/// Rays from which on each cell has its own.
constexpr int kManyRays = kGuideCells * 3 / 4;

/// How the rays of a point divide the square: side x side strata, each of whole cells of
/// GuideSquare, with `each` rays in a stratum.
struct Strata {
  int side, each;
  explicit Strata(int rays)
      : side(static_cast<int>(rays < kManyRays ? kGuideSide / 2 : kGuideSide)),
        each(std::max(1, (rays + side * side / 2) / (side * side))) {}
  int count() const { return side * side; }
};

/// Share of the environment in a direction that only rays find.
float environment_share(const World& world, const GatherPoint& at, const Vec3& direction) {
  LitVertex lit(world, at.point, Closure());
  lit.environment = world.light_sampler->environment_chances(lit, true, false);
  if (!(lit.environment.samples > 0)) return 1;
  const auto found = world.light_sampler->find_environment(
      &lit, {.origin = at.point.position, .direction = direction});
  const float pdf = sampling::cosine_hemisphere_pdf(dot(direction, at.normal));
  return bsdf_sample_weight(Estimator::Mis, pdf, found.pdf);
}

class GuideRays {
 public:
  GuideRays(const World& world, const Bounces& coarse, int rays) : world_(world), strata_(rays) {
    maps_.bounces = &coarse.cache;
    maps_.bounces_query = coarse.query;
    maps_.bounces_held = coarse.held;
    settings_.maps = &maps_;
    settings_.diffuse_bounces = coarse.held;
  }

  GuidePoint light_at(const GatherPoint& at, const sampling::Sampler& sampler,
                      RayCounts& counts) const {
    GuidePoint point{at.point.position, at.normal};
    point.rays = strata_.count() * strata_.each;
    const Frame frame = guide_frame(at.normal);
    const int side = strata_.side, cells = static_cast<int>(kGuideSide) / side;
    for (int i = 0; i < strata_.count(); ++i) {
      const int row = i / side, column = i % side;
      Rgb radiance(0);
      for (int k = 0; k < strata_.each; ++k) {
        auto stream =
            sampler.split(static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(strata_.each),
                          static_cast<std::uint32_t>(i));
        const Vec2 u = (Vec2(float(column), float(row)) + stream.next_2d()) / float(side);
        const Vec3 w = frame.to_world(sampling::sample_cosine_hemisphere(u));
        radiance += found(at, w, stream, counts) / static_cast<float>(strata_.each);
      }
      point.mean += radiance / static_cast<float>(strata_.count());
      for (int y = row * cells; y < (row + 1) * cells; ++y)
        for (int x = column * cells; x < (column + 1) * cells; ++x)
          point.light[static_cast<std::size_t>(y) * kGuideSide + static_cast<std::size_t>(x)] =
              luminance(radiance);
    }
    return point;
  }

 private:
  /// Radiance of one ray that light samples do not find.
  Rgb found(const GatherPoint& at, const Vec3& direction, sampling::Sampler& stream,
            RayCounts& counts) const {
    if (!(dot(direction, at.point.geometric_normal) > 0)) return Rgb(0);
    const PathResult ray =
        trace_gather_ray(world_, at.point, direction, kFarthest, settings_, stream, counts);
    if (!std::isfinite(luminance(ray.radiance))) return Rgb(0);
    const bool missed = !(ray.depth > 0) && !is_black(ray.radiance);
    return missed ? ray.radiance * environment_share(world_, at, direction) : ray.radiance;
  }

  static constexpr float kFarthest = std::numeric_limits<float>::infinity();
  const World& world_;
  Strata strata_;
  IndirectCaches maps_;
  PathSettings settings_;
};

}  // namespace

std::vector<GuidePoint> guide_points(const World& world, const Bounces& coarse, int rays,
                                     std::uint32_t pass, std::uint32_t seed, RayCounts& counts,
                                     const ProgressMonitor& monitor) {
  const GuideRays of_point(world, coarse, rays);
  std::vector<GuidePoint> points(coarse.points.size());
  std::vector<RayCounts> traced(points.size());
  parallel_for(points.size(), [&](std::size_t i) {
    if (monitor.cancelled()) return;
    const sampling::Sampler stream(kGuideColumn, static_cast<int>(i), pass, seed);
    points[i] = of_point.light_at(coarse.points[i], stream, traced[i]);
  });
  for (const RayCounts& own : traced) counts += own;
  return monitor.cancelled() ? std::vector<GuidePoint>() : points;
}

}  // namespace oriel
