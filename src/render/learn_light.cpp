// SPDX-License-Identifier: Apache-2.0
#include "render/learn_light.h"

#include <algorithm>

#include "lights/light_sampler.h"
#include "transport/gather/gather_passes.h"
#include "transport/gather/guide_points.h"
#include "transport/gather/light_points.h"
#include "transport/path/pilot_paths.h"

namespace oriel {
namespace {

/// With fewer camera paths, learning costs more than it saves: it takes about as long as 200 000
/// paths of a room.
constexpr double kLeastPaths = 1 << 20;
/// Rays of a coarse record before BounceSolver halves them. Records only steer paths, so that many
/// rough ones serve better than few exact ones.
constexpr int kRaysOfRecord = 64;
/// Camera paths for each record, at least, so that learning is not more work than the picture.
constexpr double kPathsOfRecord = 1200;
/// Rays of each guide point for a first guide, by which pilot paths decide, and rays of all points
/// of the final guide for each camera path. More rays give a better guide: in a box, the squared
/// error with 64, 128, 256 and 512 rays for each of 927 points is .71, .63, .57 and .52 of that
/// without guide. A ray takes about half as long as a path.
constexpr int kFirstRays = 64, kMostRays = 512;
constexpr double kRaysForEachPath = 0.06;
/// Pilot paths compare noise and rays, but not the time of look-ups, about a tenth; a later guide
/// of more rays is better. In rooms lit by lamps or by the sky they find 1.6 to 1.8; guides of
/// scenes where they find 1.3 save no time.
constexpr float kWorthwhileGain = 1.5f;
/// The same gain for learned lights, whose look-ups cost little, and for two diffuse rays.
constexpr float kWorthwhileLights = 1.1f, kWorthwhileRays = 1.05f;
/// Pilot paths of a comparison as a share of all paths, and their pixels.
constexpr double kPilotShare = 0.02;
constexpr double kFewestPilotPixels = 512, kMostPilotPixels = 4096;
/// Samples of each light at a point, rays of all points for each camera path, and most lights.
constexpr double kMostSamples = 8, kLightRaysForEachPath = 0.18;
constexpr std::size_t kMostLights = 512;
/// Diffuse rays at the first surface where indirect light is most of the noise; a power of two,
/// which keeps samples stratified. In a box and in a room lit by the sky, 2 save 15 and 19 % of the
/// time to equal error, 3 save 11 %, 4 save 7 %.
constexpr int kMoreRays = 2;

std::size_t most_records(double paths) {
  return static_cast<std::size_t>(std::min<double>(kMostBounceRecords, paths / kPathsOfRecord));
}

Bounces coarse_records(const World& world, const IntegratorPreparation& p,
                       const GatherSettings& settings) {
  const GatherPasses passes{settings, {}, world.options.finalgather.presample_density, p.seed};
  return gather_bounces(world, first_gather_points(world, p.picture, passes, p.counts), settings,
                        p.seed, p.counts, p.monitor, most_records(p.paths));
}

/// Whether pilot paths gain by settings `a` over `b`.
bool gains(const World& world, const IntegratorPreparation& p, const PathSettings& a,
           const PathSettings& b, float worthwhile) {
  const double wanted = kPilotShare * p.paths / kPilotPathsOfPixel;
  const auto pixels =
      static_cast<std::size_t>(std::clamp(wanted, kFewestPilotPixels, kMostPilotPixels));
  return compare_pilots(world, p.picture, a, b, p.seed, p.counts, pixels).efficiency() >=
         worthwhile;
}

LearnedLights learn_lights(const World& world, const IntegratorPreparation& p,
                           const PathSettings& settings, const Bounces& records) {
  const std::size_t lights = world.light_sampler->chosen_lights().size();
  if (lights == 0 || lights > kMostLights) return {};
  const double rays =
      p.paths * kLightRaysForEachPath / (double(records.points.size()) * double(lights));
  LearnedLights learned =
      measure_lights(world, records.points, static_cast<int>(std::clamp(rays, 1.0, kMostSamples)),
                     p.seed, p.counts);
  if (learned.empty()) return learned;
  PathSettings with = settings;
  with.lights = &learned;
  return gains(world, p, with, settings, kWorthwhileLights) ? std::move(learned) : LearnedLights();
}

DirectionGuide learn_directions(const World& world, const IntegratorPreparation& p,
                                const PathSettings& settings, const Bounces& records) {
  const auto guide_of = [&](int rays) {
    return DirectionGuide(world.accel->bounds(),
                          guide_points(world, records, rays, p.seed, p.counts, p.monitor));
  };
  DirectionGuide guide = guide_of(kFirstRays);
  if (guide.empty()) return guide;
  PathSettings with = settings;
  with.guide = &guide;
  if (!gains(world, p, with, settings, kWorthwhileGain)) return {};
  const double rays = p.paths * kRaysForEachPath / double(records.points.size());
  if (rays < 1.5 * kFirstRays) return guide;
  return guide_of(static_cast<int>(std::min<double>(rays, kMostRays)));
}

}  // namespace

bool LearnedLight::is_valid(const World& world) const {
  return lights.is_valid(world.light_sampler->chosen_lights().size()) && guide.is_valid() &&
         (diffuse_rays == 1 || diffuse_rays == kMoreRays);
}

LearnedLight learn_light(const World& world, const IntegratorPreparation& p,
                         const PathSettings& settings) {
  if (!world.options.guiding || p.paths < kLeastPaths) return {};
  p.monitor.report("guiding", 0);
  GatherSettings of_records = gather_settings(world.options, world.accel->bounds());
  of_records.rays = std::min(of_records.rays, kRaysOfRecord);
  of_records.path.diffuse_bounces = PathSettings::kAllBounces;
  // Not those of a cache of bounces: they refer to the window, and a resumed render lacks their
  // points.
  const Bounces records = coarse_records(world, p, of_records);
  if (records.points.empty() || p.monitor.cancelled()) return {};
  LearnedLight learned;
  learned.lights = learn_lights(world, p, settings, records);
  PathSettings so_far = settings;
  if (!learned.lights.empty()) so_far.lights = &learned.lights;
  learned.guide = learn_directions(world, p, so_far, records);
  if (p.monitor.cancelled()) return {};
  if (!learned.guide.empty()) so_far.guide = &learned.guide;
  PathSettings more = so_far;
  more.diffuse_rays = kMoreRays;
  if (gains(world, p, more, so_far, kWorthwhileRays)) learned.diffuse_rays = kMoreRays;
  return learned;
}

}  // namespace oriel
