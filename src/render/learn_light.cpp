// SPDX-License-Identifier: Apache-2.0
#include "render/learn_light.h"

#include <algorithm>
#include <array>
#include <utility>

#include "lights/light_sampler.h"
#include "render/progressive.h"
#include "transport/gather/gather_passes.h"
#include "transport/gather/guide_points.h"
#include "transport/gather/light_points.h"

namespace oriel {
namespace {

/// With fewer camera paths, learning costs more than it saves.
constexpr double kLeastPaths = 1 << 18;
/// Rays of a coarse record before BounceSolver halves them. Records only steer paths, so that many
/// rough ones serve better than few exact ones.
constexpr int kRaysOfRecord = 64;
/// Camera paths for each record, at least, so that learning is not more work than the picture. The
/// squared error of guided pictures with 1200 is at most 3 % lower, and with 4800 up to 17 %
/// higher.
constexpr double kPathsOfRecord = 2400;
/// Rays of each guide point for a first guide, by which pilot paths decide, and rays of all points
/// of the final guide for each camera path. More rays give a better guide: in a box, the squared
/// error with 64, 128, 256 and 512 rays for each of 927 points is .71, .63, .57 and .52 of that
/// without guide. A ray takes about half as long as a path.
constexpr int kFirstRays = 64, kMostRays = 512;
constexpr double kRaysForEachPath = 0.06;
/// Samples of each light at a point, rays of all points for each camera path, and most lights.
constexpr double kMostSamples = 8, kLightRaysForEachPath = 0.18;
constexpr std::size_t kMostLights = 512;
/// Diffuse rays at the first surface with a guide, powers of two, which keep samples stratified,
/// and what they usually gain: geometric means of 22 scenes, most of them drawn at random. With
/// eight rays the mean is 1.43. Without a guide, two rays gain .74 to 1.09 in eleven of thirteen
/// scenes; in the other two a guide gains more.
/// Pilot paths compare noise and rays, but not the time of look-ups in the guide: in nine scenes,
/// pictures with a guide gain .81 to 1.05 of what pilot paths find (mean .9), with a guide and two
/// diffuse rays .88 to 1.15.
struct UsualGain {
  int diffuse_rays;
  float gain, kept;  ///< see BestSettings::Candidate
};
constexpr std::array<UsualGain, 3> kUsualGains{{{1, 1.16f, 0.9f}, {2, 1.44f, 1}, {4, 1.51f, 1}}};

std::size_t most_records(double paths) {
  return static_cast<std::size_t>(std::min<double>(kMostBounceRecords, paths / kPathsOfRecord));
}

Bounces coarse_records(const World& world, const IntegratorPreparation& p,
                       const GatherSettings& settings) {
  const GatherPasses passes{settings, {}, world.options.finalgather.presample_density, p.seed};
  return gather_bounces(world, first_gather_points(world, p.picture, passes, p.counts), settings,
                        p.seed, p.counts, p.monitor, most_records(p.paths));
}

/// Samples of each of so many lights at a point.
int light_samples(const IntegratorPreparation& p, const Bounces& records, std::size_t lights) {
  const double rays =
      p.paths * kLightRaysForEachPath / (double(records.points.size()) * double(lights));
  return static_cast<int>(std::clamp(rays, 1.0, kMostSamples));
}

LearnedLights learn_lights(const World& world, const IntegratorPreparation& p,
                           const Bounces& records) {
  const std::size_t lights = world.light_sampler->chosen_lights().size();
  if (lights == 0 || lights > kMostLights) return {};
  return measure_lights(world, records.points, light_samples(p, records, lights), p.seed, p.counts);
}

LearnedLights learn_emitters(const World& world, const IntegratorPreparation& p,
                             const Bounces& records) {
  const std::size_t parts = world.light_sampler->mesh_lights().parts();
  if (parts < 2) return {};
  return measure_emitters(world, records.points, light_samples(p, records, parts), p.seed,
                          p.counts);
}

/// Improves a guide by more rays at its points. Inputs:  points: by kFirstRays.
DirectionGuide improved_guide(const World& world, const IntegratorPreparation& p,
                              const Bounces& records, std::vector<GuidePoint> points, int rays) {
  const std::vector<GuidePoint> more =
      guide_points(world, records, rays, 1, p.seed, p.counts, p.monitor);
  for (std::size_t i = 0; i < more.size(); ++i) points[i].add(more[i]);
  return DirectionGuide(points);
}

}  // namespace

bool LearnedLight::is_valid(const World& world) const {
  return lights.is_valid(world.light_sampler->chosen_lights().size()) &&
         emitters.is_valid(world.light_sampler->mesh_lights().parts()) && guide.is_valid() &&
         std::any_of(kUsualGains.begin(), kUsualGains.end(),
                     [&](const UsualGain& usual) { return usual.diffuse_rays == diffuse_rays; });
}

bool may_learn(const World& world, double paths) {
  return world.options.guiding && paths >= kLeastPaths;
}

double needed_paths(const World& world, const IntegratorPreparation& p,
                    const PathSettings& settings) {
  if (!(p.noise > 0) || !may_learn(world, p.paths)) return p.paths;
  const PilotPaths pilots(world, p.picture, settings, p.seed, p.counts);
  const double of_pixel =
      std::max<double>(pilots.noise_of_path() / sqr(p.noise), kMinJudgedSamples);
  return std::min(p.paths, of_pixel * p.picture.width() * p.picture.height());
}

LearnedLight learn_light(const World& world, const IntegratorPreparation& p, BestSettings best,
                         const IndirectCaches* without_photons) {
  if (!may_learn(world, p.paths)) return {};
  p.monitor.report("guiding", 0);
  GatherSettings of_records = gather_settings(world.options, world.accel->bounds());
  of_records.rays = std::min(of_records.rays, kRaysOfRecord);
  of_records.path.diffuse_bounces = PathSettings::kAllBounces;
  // Not those of a cache of bounces: they refer to the window, and a resumed render lacks their
  // points.
  const Bounces records = coarse_records(world, p, of_records);
  if (records.points.empty() || p.monitor.cancelled()) return {};
  LearnedLight learned;
  PathSettings with = best.settings();
  const auto keep_if_better = [&](LearnedLights& part, const LearnedLights* PathSettings::*used) {
    if (part.empty()) return;
    with = best.settings();
    with.*used = &part;
    if (!best.improve(with)) part = {};
  };
  learned.lights = learn_lights(world, p, records);
  keep_if_better(learned.lights, &PathSettings::lights);
  learned.emitters = learn_emitters(world, p, records);
  keep_if_better(learned.emitters, &PathSettings::emitters);
  std::vector<GuidePoint> points =
      guide_points(world, records, kFirstRays, 0, p.seed, p.counts, p.monitor);
  learned.guide = DirectionGuide(points);
  if (!learned.guide.empty()) {
    std::vector<BestSettings::Candidate> candidates;
    with = best.settings();
    with.guide = &learned.guide;
    for (const UsualGain& usual : kUsualGains) {
      with.diffuse_rays = usual.diffuse_rays;
      candidates.push_back({with, usual.gain, usual.kept});
    }
    best.choose(candidates);
  }
  if (without_photons) {
    with = best.settings();
    with.maps = without_photons;
    learned.needs_photons = best.need_photons(with);
  }
  if (!best.settings().guide) learned.guide = {};
  learned.diffuse_rays = best.settings().diffuse_rays;
  const double rays = p.paths * kRaysForEachPath / double(records.points.size());
  if (!learned.guide.empty() && rays >= 1.5 * kFirstRays)
    learned.guide =
        improved_guide(world, p, records, std::move(points),
                       static_cast<int>(std::min<double>(rays, kMostRays)) - kFirstRays);
  if (p.monitor.cancelled()) return {};
  return learned;
}

}  // namespace oriel
