// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/gather_bounces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "base/math.h"
#include "base/parallel.h"
#include "color/luminance.h"

namespace oriel {
namespace {

// The values below are estimates; the fine records average the errors of these coarse ones.
/// Rays per record that find points for further records.
constexpr int kFeelers = 16;
/// Maximum number of points per generation whose rays are traced.
constexpr std::size_t kMaxViewers = 1024;
/// Interpolation error above which a point gets its own record, and above which a record is not
/// used.
constexpr float kCoverError = 0.7f, kWorstBounceError = 0.8f;
/// Maximum number of records per look-up.
constexpr int kPoints = 4;
/// Rays of a coarse record as a fraction of those of a fine one, and their maximum.
constexpr float kRays = 0.5f;
constexpr int kMaxRays = 100;
/// Minimum radius of a record as a fraction of the diagonal of the space that the picture shows.
constexpr float kMinRecordRadius = 0.02f;
/// Of the rays between surfaces of a room, a tenth are longer than its diagonal / kDiagonalPerRay.
/// Ten rooms, empty and furnished, had 1.45 to 1.9. Rays to land behind windows should be fewer.
constexpr double kLongRays = 0.1;
constexpr float kDiagonalPerRay = 1.9f;
/// Maximum number of rounds; relative change of a round at which the remaining bounces are
/// extrapolated.
constexpr int kMaxRounds = 16;
constexpr double kSettled = 0.015;
/// Maximum of the extrapolated sum, relative to the last change. It corresponds to a room that
/// reflects nine tenths of its light.
constexpr double kMaxTail = 9;
/// Points of the first batch. Each batch has twice as many as the one before, so that few points of
/// one batch lie side by side.
constexpr std::size_t kFirstBatch = 64;
/// Points whose cover is tested by one task.
constexpr std::size_t kTestedAtOnce = 64;
/// Stream numbers of the two kinds of rays.
constexpr int kFeelerColumn = 0x66656c, kRecordColumn = 0x726563;

/// Radii for a space with this diagonal; the picture's may be in pixels.
GatherRadii coarse_radii(float diagonal) {
  GatherRadii radii = default_gather_radii(diagonal);
  radii.min = kMinRecordRadius * diagonal;
  return radii;
}

/// Diagonal of the space that rays of these lengths cross: of a room, not of the land around it.
float diagonal_of_space(const World& world, std::vector<float> lengths) {
  const float of_scene = length(world.accel->bounds().size());
  if (lengths.empty()) return of_scene;
  const auto longest = lengths.begin() + static_cast<std::ptrdiff_t>(
                                             (1 - kLongRays) * static_cast<double>(lengths.size()));
  std::nth_element(lengths.begin(), longest, lengths.end());
  return std::min(of_scene, kDiagonalPerRay * *longest);
}

class BounceSolver {
 public:
  BounceSolver(const World& world, const GatherSettings& settings, std::uint32_t seed,
               RayCounts& counts, const ProgressMonitor& monitor, std::size_t most)
      : world_(world),
        settings_(settings),
        seed_(seed),
        counts_(counts),
        monitor_(monitor),
        most_(most) {
    settings_.rays =
        std::clamp(static_cast<int>(static_cast<float>(settings.rays) * kRays), 16, kMaxRays);
    settings_.path.diffuse_bounces = 0;
    cover_.accuracy = kCoverError;
  }

  /// Adds a record at each point that rays from `from` hit and that no record covers yet.
  void place(const std::vector<GatherPoint>& from, int generation) {
    std::vector<float> lengths;
    const std::vector<GatherPoint> met = feel(from, generation, lengths);
    if (generation == 0)
      settings_.radii = cover_.radii = coarse_radii(diagonal_of_space(world_, std::move(lengths)));
    std::size_t batch = kFirstBatch;
    for (std::size_t begin = 0; begin < met.size() && !monitor_.cancelled();) {
      const std::size_t end = std::min(met.size(), begin + batch);
      const std::vector<std::uint8_t> covered = cover_of({met.data() + begin, end - begin});
      std::vector<GatherPoint> wanted;
      for (std::size_t i = begin; i < end && points_.size() + wanted.size() < most_; ++i)
        if (!covered[i - begin]) wanted.push_back(met[i]);
      const std::vector<GatherRecord> made = gather(wanted, points_.size());
      cache_.insert(made);
      cache_.settle_radii();
      points_.insert(points_.end(), wanted.begin(), wanted.end());
      records_.insert(records_.end(), made.begin(), made.end());
      begin = end;
      batch *= 2;
      monitor_.report("bounces", 0.2 * (generation + double(begin) / double(met.size())));
    }
  }
  const std::vector<GatherPoint>& points() const { return points_; }

  /// The placed records contain one bounce; each round adds another.
  Bounces solve(int wanted) {
    Bounces b;
    b.query = bounces_query(settings_.radii);
    const bool all = wanted >= PathSettings::kAllBounces;
    double change_before = 0;
    std::vector<GatherRecord> before;
    // Caustics are read by the rays of all rounds.
    IndirectCaches maps = settings_.path.maps ? *settings_.path.maps : IndirectCaches();
    for (b.held = 1; b.held < (all ? kMaxRounds : wanted) && !monitor_.cancelled(); ++b.held) {
      maps.bounces = &cache_;
      maps.bounces_query = b.query;
      maps.bounces_held = all ? PathSettings::kAllBounces : b.held;
      settings_.path.maps = &maps;
      settings_.path.diffuse_bounces = maps.bounces_held;
      before = std::exchange(records_, all ? gather_again() : gather(points_, 0));
      double change = 0, total = 0;
      for (std::size_t i = 0; i < records_.size(); ++i) {
        change += std::abs(luminance(records_[i].irradiance - before[i].irradiance));
        total += luminance(records_[i].irradiance);
      }
      const bool settled = change <= kSettled * total;
      if (settled && change_before > change) {
        const double ratio = change / change_before, rounds_left = wanted - b.held - 1;
        const double tail = ratio * (1 - math::pow(ratio, rounds_left)) / (1 - ratio);
        add_tail(before, static_cast<float>(std::min(kMaxTail, tail)));
      }
      cache_ = {};
      cache_.insert(records_);
      cache_.settle_radii();
      monitor_.report("bounces", 0.4 + 0.6 * b.held / (all ? 6 : wanted));
      if (settled) {
        b.held = wanted;
        break;
      }
      change_before = change;
    }
    if (all) b.held = PathSettings::kAllBounces;
    b.cache = std::move(cache_);
    b.points = std::move(points_);
    return b;
  }

 private:
  /// Whether the current records cover each point.
  std::vector<std::uint8_t> cover_of(std::span<const GatherPoint> points) const {
    std::vector<std::uint8_t> covered(points.size());
    parallel_for_blocks(points.size(), kTestedAtOnce, [&](std::size_t i) {
      covered[i] =
          cache_.interpolate(query_at(cover_, points[i].point, points[i].normal)).has_value();
    });
    return covered;
  }

  /// Points hit by rays from other points. Of too many points, an evenly spaced subset is traced.
  /// `lengths`: receives the distances between them.
  std::vector<GatherPoint> feel(const std::vector<GatherPoint>& from, int generation,
                                std::vector<float>& lengths) {
    const std::size_t step = from.size() / kMaxViewers + 1,
                      lookers = (from.size() + step - 1) / step;
    std::vector<std::vector<GatherPoint>> met(lookers);
    const PathSettings visiting{.indirect = true};
    each(lookers, [&](std::size_t i, RayCounts& counts) {
      const GatherPoint& p = from[i * step];
      sampling::Sampler turn(kFeelerColumn + generation, static_cast<int>(i), 0, seed_);
      const auto hemisphere = GatherHemisphere::for_rays(p.normal, kFeelers, turn.next_1d());
      for (int k = 0; k < hemisphere.count(); ++k) {
        auto stream = turn.split(static_cast<std::uint32_t>(k),
                                 static_cast<std::uint32_t>(hemisphere.count()), 0);
        const Vec3 direction = hemisphere.direction(k, stream.next_2d());
        visit_gather_ray(world_, p, direction, visiting, stream, counts, met[i]);
      }
    });
    std::vector<GatherPoint> all;
    for (std::size_t i = 0; i < lookers; ++i) {
      all.insert(all.end(), met[i].begin(), met[i].end());
      for (const GatherPoint& p : met[i])
        lengths.push_back(length(p.point.position - from[i * step].point.position));
    }
    return all;
  }

  std::vector<GatherRecord> gather(const std::vector<GatherPoint>& points, std::size_t first) {
    std::vector<GatherRecord> records(points.size());
    each(points.size(), [&](std::size_t i, RayCounts& counts) {
      // Every round traces the same rays, so that rounds differ by light and not by noise.
      const sampling::Sampler stream(kRecordColumn, static_cast<int>(first + i), 0, seed_);
      records[i] = gather_at(world_, points[i], settings_, stream, counts);
    });
    return records;
  }

  /// The records with the light that the current ones have, by rays that are traced in the first
  /// round only.
  std::vector<GatherRecord> gather_again() {
    const bool first = rays_.empty();
    if (first) rays_.resize(points_.size());
    std::vector<GatherRecord> records(points_.size());
    each(points_.size(), [&](std::size_t i, RayCounts& counts) {
      const sampling::Sampler stream(kRecordColumn, static_cast<int>(i), 0, seed_);
      if (first) rays_[i] = trace_gather_rays(world_, points_[i], settings_, stream, counts, true);
      records[i] = rays_[i].complete
                       ? gathered_record(world_, points_[i], settings_, rays_[i], &cache_)
                       : gather_at(world_, points_[i], settings_, stream, counts);
    });
    return records;
  }

  void add_tail(const std::vector<GatherRecord>& before, float tail) {
    for (std::size_t i = 0; i < records_.size(); ++i) {
      Rgb& e = records_[i].irradiance;
      const Rgb grown = e - before[i].irradiance;
      std::vector<Rgb>& shares = records_[i].shares;
      for (std::size_t k = 0; k < shares.size() && before[i].shares.size() == shares.size(); ++k)
        for (int c = 0; c < 3; ++c) {
          const float own = e[c] * shares[k][c];
          const float own_grown = own - before[i].irradiance[c] * before[i].shares[k][c];
          shares[k][c] = own + std::max(0.0f, own_grown) * tail;
        }
      if (!shares.empty()) normalise_shares(shares);
      for (int c = 0; c < 3; ++c) e[c] += std::max(0.0f, grown[c]) * tail;
    }
  }

  /// Runs the work in parallel and sums the ray counts.
  template <class Work>
  void each(std::size_t count, const Work& work) {
    std::vector<RayCounts> counts(count);
    parallel_for(count, [&](std::size_t i) {
      if (monitor_.cancelled()) return;
      RayCounts mine;
      work(i, mine);
      counts[i] = mine;
    });
    for (const RayCounts& own : counts) counts_ += own;
  }

  const World& world_;
  GatherSettings settings_;
  std::uint32_t seed_;
  RayCounts& counts_;
  const ProgressMonitor& monitor_;
  std::size_t most_;
  GatherQuery cover_;
  GatherCache cache_;
  std::vector<GatherPoint> points_;
  std::vector<GatherRecord> records_;  ///< of the points
  std::vector<GatherRays> rays_;       ///< of the points, with what they read
};

}  // namespace

GatherQuery bounces_query(const GatherRadii& radii) {
  GatherQuery query;
  query.radii = radii;
  query.by_error = true;
  query.points = kPoints;
  query.accuracy = kWorstBounceError;
  return query;
}

Bounces gather_bounces(const World& world, const std::vector<GatherPoint>& seen,
                       const GatherSettings& settings, std::uint32_t seed, RayCounts& counts,
                       const ProgressMonitor& monitor, std::size_t most) {
  BounceSolver solver(world, settings, seed, counts, monitor, most);
  solver.place(seen, 0);
  const std::vector<GatherPoint> met = solver.points();
  solver.place(met, 1);
  return solver.solve(settings.path.diffuse_bounces);
}

}  // namespace oriel
