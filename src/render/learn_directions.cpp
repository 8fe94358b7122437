// SPDX-License-Identifier: Apache-2.0
#include "render/learn_directions.h"

#include <algorithm>

#include "transport/gather/gather_passes.h"
#include "transport/gather/guide_points.h"
#include "transport/path/pilot_paths.h"

namespace oriel {
namespace {

/// With fewer camera paths, records and rays cost more than the guide saves: records take about as
/// long as 65 000 paths.
constexpr double kLeastPaths = 1 << 20;
/// Rays of guide points as a share of the rays of all paths, of which a camera path has about
/// kRaysOfPath. More rays give a better guide: in a box, the squared error with 50, 200 and 400
/// rays for each point is .63, .56 and .50 of that without guide.
constexpr double kShareOfRays = 0.03, kRaysOfPath = 6;
constexpr double kFewestRays = 64, kMostRays = 512;
/// Gain of pilot paths from which on a guide is used. They overestimate it, since the samples of a
/// picture are stratified, and do not know of the time of look-ups, about a tenth. In eleven scenes
/// pilots with gains from 1.6 on saved time, and those below 1.3 did not.
constexpr float kWorthwhileGain = 1.4f;
constexpr std::size_t kPilotPixels = 8192;

Bounces coarse_records(const World& world, const IntegratorPreparation& p,
                       const GatherSettings& settings) {
  const GatherPasses passes{settings, {}, world.options.finalgather.presample_density, p.seed};
  return gather_bounces(world, first_gather_points(world, p.picture, passes, p.counts), settings,
                        p.seed, p.counts, p.monitor);
}

}  // namespace

DirectionGuide learn_directions(const World& world, const IntegratorPreparation& p,
                                const PathSettings& settings, const Bounces& coarse) {
  if (!world.options.guiding || p.paths < kLeastPaths) return {};
  p.monitor.report("guiding", 0);
  GatherSettings records = gather_settings(world.options, world.accel->bounds());
  records.path.diffuse_bounces = PathSettings::kAllBounces;
  const bool has_points = !coarse.points.empty();
  const Bounces own = has_points ? Bounces() : coarse_records(world, p, records);
  const Bounces& used = has_points ? coarse : own;
  if (used.points.empty() || p.monitor.cancelled()) return {};
  const double rays = p.paths * kRaysOfPath * kShareOfRays / double(used.points.size());
  const auto points =
      guide_points(world, used, records, static_cast<int>(std::clamp(rays, kFewestRays, kMostRays)),
                   p.seed, p.counts, p.monitor);
  DirectionGuide guide(world.accel->bounds(), points);
  if (guide.empty()) return guide;
  PathSettings guided = settings;
  guided.guide = &guide;
  const float gain =
      efficiency_ratio(world, p.picture, guided, settings, p.seed, p.counts, kPilotPixels);
  return gain < kWorthwhileGain ? DirectionGuide() : std::move(guide);
}

}  // namespace oriel
