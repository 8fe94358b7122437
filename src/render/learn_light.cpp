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
/// The same gain for learned lights, whose look-ups cost little.
constexpr float kWorthwhileLights = 1.1f;
/// Samples of each light at a point, and most lights.
constexpr double kMostSamples = 8;
constexpr std::size_t kMostLights = 512;

Bounces coarse_records(const World& world, const IntegratorPreparation& p,
                       const GatherSettings& settings) {
  const GatherPasses passes{settings, {}, world.options.finalgather.presample_density, p.seed};
  return gather_bounces(world, first_gather_points(world, p.picture, passes, p.counts), settings,
                        p.seed, p.counts, p.monitor);
}

/// Whether pilot paths gain by settings `a` over `b`.
bool gains(const World& world, const IntegratorPreparation& p, const PathSettings& a,
           const PathSettings& b, float worthwhile) {
  return efficiency_ratio(world, p.picture, a, b, p.seed, p.counts, kPilotPixels) >= worthwhile;
}

LearnedLights learn_lights(const World& world, const IntegratorPreparation& p,
                           const PathSettings& settings, const Bounces& records) {
  const std::size_t lights = world.light_sampler->chosen_lights().size();
  if (lights == 0 || lights > kMostLights) return {};
  const double rays =
      p.paths * kRaysOfPath * kShareOfRays / (double(records.points.size()) * double(lights));
  LearnedLights learned =
      measure_lights(world, records.points, static_cast<int>(std::clamp(rays, 1.0, kMostSamples)),
                     p.seed, p.counts);
  if (learned.empty()) return learned;
  PathSettings with = settings;
  with.lights = &learned;
  return gains(world, p, with, settings, kWorthwhileLights) ? std::move(learned) : LearnedLights();
}

DirectionGuide learn_directions(const World& world, const IntegratorPreparation& p,
                                const PathSettings& settings, const Bounces& records,
                                const GatherSettings& of_records) {
  const double rays = p.paths * kRaysOfPath * kShareOfRays / double(records.points.size());
  const auto points = guide_points(world, records, of_records,
                                   static_cast<int>(std::clamp(rays, kFewestRays, kMostRays)),
                                   p.seed, p.counts, p.monitor);
  DirectionGuide guide(world.accel->bounds(), points);
  if (guide.empty()) return guide;
  PathSettings with = settings;
  with.guide = &guide;
  return gains(world, p, with, settings, kWorthwhileGain) ? std::move(guide) : DirectionGuide();
}

}  // namespace

bool LearnedLight::is_valid(const World& world) const {
  return lights.is_valid(world.light_sampler->chosen_lights().size()) && guide.is_valid();
}

LearnedLight learn_light(const World& world, const IntegratorPreparation& p,
                         const PathSettings& settings) {
  if (!world.options.guiding || p.paths < kLeastPaths) return {};
  p.monitor.report("guiding", 0);
  GatherSettings of_records = gather_settings(world.options, world.accel->bounds());
  of_records.path.diffuse_bounces = PathSettings::kAllBounces;
  // Not those of a cache of bounces: they refer to the window, and a resumed render lacks their
  // points.
  const Bounces records = coarse_records(world, p, of_records);
  if (records.points.empty() || p.monitor.cancelled()) return {};
  LearnedLight learned;
  learned.lights = learn_lights(world, p, settings, records);
  PathSettings so_far = settings;
  if (!learned.lights.empty()) so_far.lights = &learned.lights;
  learned.guide = learn_directions(world, p, so_far, records, of_records);
  return learned;
}

}  // namespace oriel
