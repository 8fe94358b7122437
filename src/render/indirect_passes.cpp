// SPDX-License-Identifier: Apache-2.0
#include "render/indirect_passes.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/parallel.h"

namespace oriel {
namespace {

/// Pixels between gather points of the last pass at presample density 1; a guess.
constexpr float kFinestStep = 4;
/// Passes, each twice as fine as the one before.
constexpr int kPasses = 4;
/// Largest error of a record that may speak for a point (GatherQuery::accuracy). At 1, a room lit
/// through a window is some percent too bright beside it; a guess.
constexpr float kGatherError = 0.5f;
/// Photons kept of each light, and most that are sent for them.
constexpr std::uint64_t kPhotonsPerLight = 100000, kMostSent = 2000000;

/// Streams of the points of one path, and what tells them from those of its lobes.
constexpr std::uint32_t kMostPointsOfPath = 16, kGatherBranch = 77;

}  // namespace

IndirectPlan plan_indirect(const scene::RenderOptions& options) {
  using Method = scene::IndirectMethod;
  const Method m = options.indirect;
  IndirectPlan plan;
  plan.gather = m == Method::FinalGather || m == Method::FinalGatherPhotons;
  plan.global = m == Method::Photons || m == Method::FinalGatherPhotons;
  plan.caustic = (plan.gather || plan.global) && options.caustic.on;
  return plan;
}

IndirectPasses::IndirectPasses(const World& world, const Window& window, std::uint32_t seed,
                               RayCounts& counts, const std::atomic<bool>* cancel)
    : plan_(plan_indirect(world.options)) {
  const scene::RenderOptions& options = world.options;
  const geom::Box3 box = world.accel->bounds();
  if (plan_.global || plan_.caustic) {
    PhotonSettings settings;
    settings.globillum = plan_.global;
    settings.caustics = plan_.caustic;
    settings.each.global = settings.each.caustic = {kPhotonsPerLight, kMostSent};
    settings.environment = settings.each;
    settings.depth = options.photon_depth;
    settings.merge_global = options.globillum.merge;
    settings.merge_caustic = options.caustic.merge;
    settings.seed = seed;
    photons_ = trace_photons(world, settings, counts);
    if (plan_.global) maps_.global = &photons_.global;
    if (plan_.caustic) maps_.caustic = &photons_.caustic;
    maps_.global_lookup = photon_lookup(options.globillum, box, PhotonKind::Global);
    maps_.caustic_lookup = photon_lookup(options.caustic, box, PhotonKind::Caustic);
  }
  if (plan_.gather) gather(world, window, seed, counts, cancel);
}

void IndirectPasses::gather(const World& world, const Window& window, std::uint32_t seed,
                            RayCounts& counts, const std::atomic<bool>* cancel) {
  const scene::FinalGatherOptions& options = world.options.finalgather;
  const geom::Box3 box = world.accel->bounds();
  GatherSettings settings = gather_settings(options, length(box.max - box.min));
  const IndirectMaps photons = maps_;
  settings.path.maps = photons.global || photons.caustic ? &photons : nullptr;

  GatherQuery covered;  // whether a record speaks for a point well enough
  covered.accuracy = kGatherError;
  covered.radii = settings.radii;
  const float density = std::max(options.presample_density, 0.01f);
  const int finest =
      std::clamp(static_cast<int>(std::lround(kFinestStep / std::sqrt(density))), 1, 64);
  const PathSettings visiting{.indirect = true};
  for (int pass = 0; pass < kPasses; ++pass) {
    const int step = finest << (kPasses - 1 - pass);
    std::vector<int> rows;
    for (int y = window.y0 + step / 2; y < window.y1; y += step) rows.push_back(y);
    std::vector<std::vector<GatherRecord>> made(rows.size());
    std::mutex mutex;
    parallel_for(rows.size(), [&](std::size_t r) {
      if (cancel && *cancel) return;
      RayCounts mine;
      std::vector<GatherPoint> points;
      for (int x = window.x0 + step / 2; x < window.x1; x += step) {
        sampling::Sampler sampler(x, rows[r], static_cast<std::uint32_t>(pass), seed + 0xf9u);
        points.clear();
        visit_gather_points(world,
                            Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(rows[r]) + 0.5f),
                            visiting, sampler, mine, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
          if (cache_.interpolate(query_at(covered, points[i].point, points[i].normal))) continue;
          const auto stream =
              sampler.split(static_cast<std::uint32_t>(i), kMostPointsOfPath, kGatherBranch);
          made[r].push_back(gather_at(world, points[i], settings, stream, mine));
        }
      }
      const std::lock_guard lock(mutex);
      counts += mine;
    });
    for (const auto& row : made) cache_.insert(row);
    cache_.clamp_to_neighbours();
  }
  maps_.gather = &cache_;
  maps_.query = covered;
  maps_.gather_scale = rgb(options.scale);
}

}  // namespace oriel
