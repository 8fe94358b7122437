// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/gather_passes.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/byte_stream.h"
#include "base/math.h"
#include "base/parallel.h"
#include "transport/gather/record_state.h"

namespace oriel {
namespace {

/// Distance of the gather points of the last pass at presample density 1, in pixels; an estimate.
constexpr float kFinestStep = 2;
/// Number of passes; each halves the grid spacing.
constexpr int kPasses = 5;
/// Maximum number of points per path, each with its own stream, and the stream number that
/// separates them from those of lobes.
constexpr std::uint32_t kMaxPointsOfPath = 16, kGatherBranch = 77;
/// Seed offset that separates these samples from those of the picture.
constexpr std::uint32_t kGatherSeed = 0xf9;

int finest_step(float density) {
  return std::clamp(
      static_cast<int>(std::lround(kFinestStep / std::sqrt(std::max(density, 0.01f)))), 1, 64);
}

/// Appends the gather points of a sample through the pixel centre. Returns the sampler in its state
/// afterwards.
sampling::Sampler visit_pixel(const World& world, int x, int y, int pass, std::uint32_t seed,
                              RayCounts& counts, std::vector<GatherPoint>& points) {
  sampling::Sampler sampler(x, y, static_cast<std::uint32_t>(pass), seed + kGatherSeed);
  const PathSettings visiting{.indirect = true};
  visit_gather_points(world, Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f),
                      visiting, sampler, counts, points);
  return sampler;
}

/// Completes rows of which this process made its own, and their rays. Returns false if the work
/// ends.
bool exchange_rows(WorkShare& share, std::vector<std::vector<GatherRecord>>& rows,
                   RayCounts& rays) {
  ByteWriter own;
  visit_counts(own, rays);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (!share.owns(r)) continue;
    own.value(std::uint64_t{r});
    save_records(own, rows[r]);
  }
  const std::vector<std::string> all = share.exchange(own.take());
  rays = {};
  for (const std::string& bytes : all) {
    ByteReader in(bytes);
    RayCounts of_process;
    visit_counts(in, of_process);
    rays += of_process;
    while (!in.rest().empty()) {
      std::uint64_t r = 0;
      in.value(r);
      rows.at(static_cast<std::size_t>(r)) = restore_records(in);
    }
  }
  return !all.empty();
}

}  // namespace

std::vector<GatherPoint> first_gather_points(const World& world, const Window& window,
                                             const GatherPasses& passes, RayCounts& counts) {
  const int step = finest_step(passes.density) << (kPasses - 1);
  std::vector<GatherPoint> points;
  for (int y = window.y0 + step / 2; y < window.y1; y += step)
    for (int x = window.x0 + step / 2; x < window.x1; x += step)
      visit_pixel(world, x, y, 0, passes.seed, counts, points);
  return points;
}

void gather_for_picture(const World& world, const Window& window, const GatherPasses& passes,
                        GatherCache& cache, RayCounts& counts, const ProgressMonitor& monitor,
                        const std::function<void()>& after_pass, WorkShare* share) {
  const int finest = finest_step(passes.density);
  // A pass has four times as many points as the one before; most of them need no record.
  double done = 0, part = math::pow(4.0, -kPasses) * 3 / (1 - math::pow(4.0, -kPasses));
  // Processes that share the work end together, see WorkShare::exchange().
  for (int pass = 0; pass < kPasses && (share || !monitor.cancelled()); ++pass, part *= 4) {
    const int step = finest << (kPasses - 1 - pass);
    std::vector<int> rows;
    for (int y = window.y0 + step / 2; y < window.y1; y += step) rows.push_back(y);
    std::vector<std::vector<GatherRecord>> made(rows.size());
    std::size_t own_rows = rows.size();
    for (std::size_t r = 0; share && r < rows.size(); ++r) own_rows -= share->owns(r) ? 0 : 1;
    std::mutex mutex;
    std::size_t rows_done = 0;
    RayCounts of_pass;
    parallel_for(rows.size(), [&](std::size_t r) {
      if (monitor.cancelled() || (share && !share->owns(r))) return;
      RayCounts mine;
      std::vector<GatherPoint> points;
      for (int x = window.x0 + step / 2; x < window.x1; x += step) {
        points.clear();
        const auto sampler = visit_pixel(world, x, rows[r], pass, passes.seed, mine, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
          if (cache.interpolate(query_at(passes.covered, points[i].point, points[i].normal)))
            continue;
          const auto stream =
              sampler.split(static_cast<std::uint32_t>(i), kMaxPointsOfPath, kGatherBranch);
          made[r].push_back(gather_at(world, points[i], passes.records, stream, mine));
        }
      }
      const std::lock_guard lock(mutex);
      of_pass += mine;
      monitor.report("gather points", done + part * static_cast<double>(++rows_done) /
                                                 static_cast<double>(own_rows));
    });
    if (share && !exchange_rows(*share, made, of_pass)) return;
    counts += of_pass;
    // At once, because each insertion rebuilds the arrays of look-ups.
    std::vector<GatherRecord> records;
    for (const auto& row : made) records.insert(records.end(), row.begin(), row.end());
    cache.insert(records);
    cache.settle_radii();
    done += part;
    after_pass();
  }
}

}  // namespace oriel
