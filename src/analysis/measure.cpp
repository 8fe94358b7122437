// SPDX-License-Identifier: Apache-2.0
#include "analysis/measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/math.h"
#include "base/parallel.h"
#include "color/luminance.h"
#include "render/eye_rays.h"
#include "transport/surface.h"

namespace oriel {
namespace {

using Clock = std::chrono::steady_clock;

/// Relative rounding error of rays and shading in float; intervals are at least this wide.
constexpr double kRounding = 1e-5;
/// Determined by simulation, see take_readings().
constexpr double kDegreesKept = 0.5;

/// Running mean and variance of batch means.
/// Source:  B. Welford, Technometrics 4(3), 1962.
struct BatchMeans {
  std::uint32_t batches = 0;
  double mean = 0, m2 = 0;  // double: a million batches

  void add(double value) {
    const double before = value - mean;
    mean += before / ++batches;
    m2 += before * (value - mean);
  }
  Reading reading(const MeasureRequest& request) const {
    Reading r;
    r.value = mean;
    r.samples = std::uint64_t{batches} * kBatchSamples;
    if (batches < 2) return r;
    const double degrees = batches - 1;
    r.half_width =
        std::max(student_95(kDegreesKept * degrees) * std::sqrt(m2 / (degrees * batches)),
                 kRounding * std::abs(mean));
    r.precise = r.half_width <= std::max(request.precision * std::abs(mean), request.floor);
    return r;
  }
};

/// A batch to evaluate: index `batch` of quantity `index`.
struct Work {
  std::size_t index;
  std::uint32_t batch;
};

double draw_batch(const Work& work, const Quantity& quantity, std::uint32_t seed) {
  double sum = 0;
  RayCounts counts;
  for (std::uint32_t s = 0; s < kBatchSamples; ++s) {
    sampling::Sampler sampler(static_cast<int>(work.index), static_cast<int>(work.batch), s, seed);
    const double value = quantity(work.index, sampler, counts);
    if (std::isfinite(value)) sum += value;
  }
  return sum / kBatchSamples;
}

}  // namespace

double student_95(double degrees) {
  constexpr double kZ = 1.959963984540054;  // normal quantile of .975
  constexpr double kZ3 = kZ * kZ * kZ, kZ5 = kZ3 * kZ * kZ, kZ7 = kZ5 * kZ * kZ;
  const double n = degrees;
  return kZ + (kZ3 + kZ) / (4 * n) + (5 * kZ5 + 16 * kZ3 + 3 * kZ) / (96 * n * n) +
         (3 * kZ7 + 19 * kZ5 + 17 * kZ3 - 15 * kZ) / (384 * n * n * n);
}

std::vector<Reading> take_readings(std::size_t count, const Quantity& quantity,
                                   const MeasureRequest& request, const std::atomic<bool>* cancel) {
  const Clock::time_point start = Clock::now();
  std::vector<BatchMeans> means(count);
  std::vector<Reading> readings(count);
  const std::uint64_t most = std::min<std::uint64_t>(
      std::max<std::uint64_t>((request.max_samples + kBatchSamples - 1) / kBatchSamples, 4),
      1u << 31);
  bool first = true;
  const auto over = [&] {
    if (cancel && *cancel) return true;
    return !first && request.seconds > 0 &&
           std::chrono::duration<double>(Clock::now() - start).count() > request.seconds;
  };
  while (!over()) {
    std::vector<Work> work;
    for (std::size_t i = 0; i < count; ++i) {
      if (readings[i].precise) continue;
      const std::uint32_t have = means[i].batches;
      const auto want = static_cast<std::uint32_t>(
          std::min<std::uint64_t>(most, have == 0 ? kFirstBatches : std::uint64_t{have} * 2));
      for (std::uint32_t b = have; b < want; ++b) work.push_back({i, b});
    }
    if (work.empty()) break;
    std::vector<double> drawn(work.size());
    parallel_for(work.size(), [&](std::size_t w) {
      if (!over()) drawn[w] = draw_batch(work[w], quantity, request.seed);
    });
    // Discard an interrupted pass: the batches that had finished are a biased selection.
    if (over()) break;
    for (std::size_t w = 0; w < work.size(); ++w) means[work[w].index].add(drawn[w]);
    for (std::size_t i = 0; i < count; ++i) readings[i] = means[i].reading(request);
    first = false;
  }
  return readings;
}

std::vector<Reading> measure_illuminance(const World& world,
                                         const std::vector<IrradianceSensor>& sensors, float unit,
                                         const MeasureRequest& request,
                                         const PathSettings& settings,
                                         const std::atomic<bool>* cancel) {
  const auto one = [&](std::size_t i, sampling::Sampler& sampler, RayCounts& counts) {
    return double{unit *
                  luminance(sample_irradiance(world, sensors[i], settings, sampler, counts))};
  };
  return take_readings(sensors.size(), one, request, cancel);
}

Reading mean_reading(const std::vector<Reading>& readings) {
  Reading mean;
  if (readings.empty()) return mean;
  double squares = 0;
  mean.precise = true;
  for (const Reading& r : readings) {
    mean.value += r.value;
    squares += r.half_width * r.half_width;
    mean.samples += r.samples;
    mean.precise = mean.precise && r.precise;
  }
  const auto n = static_cast<double>(readings.size());
  mean.value /= n;
  mean.half_width = std::max(std::sqrt(squares) / n, kRounding * std::abs(mean.value));
  return mean;
}

Spot find_spot(const World& world, Vec2 raster) {
  const Camera::Ray eye = world.camera.ray(raster);
  geom::Ray ray;
  ray.org = eye.origin;
  ray.dir = eye.direction;
  ray.mask = geom::RayMask::Camera;
  ray.time = eye.time;
  ray.tnear = world.camera.clip_near > 0 ? world.camera.clip_near / eye.cos_to_film : 0;
  Spot spot;
  geom::Hit hit;
  if (!world.accel->intersect(ray, hit)) return spot;
  ShadingPoint point;
  fill_point(world, ray, hit, {}, RayKind::Eye, point);
  spot.surface = true;
  spot.sensor = {point.position, point.geometric_normal, point.ray_offset};
  spot.distance = length(point.position - eye.origin);
  spot.material = material_of(world, hit).name;
  spot.instance = world.instances[static_cast<std::size_t>(point.instance)].name;
  return spot;
}

std::vector<Reading> measure_luminance(const World& world, const std::vector<Vec2>& pixels,
                                       float unit, const MeasureRequest& request,
                                       const std::atomic<bool>* cancel) {
  const auto one = [&](std::size_t i, sampling::Sampler& sampler, RayCounts& counts) {
    const Vec2 raster = pixels[i] + sampler.next_2d();
    return double{unit * luminance(trace_eye_rays(world, raster, sampler, counts).radiance)};
  };
  return take_readings(pixels.size(), one, request, cancel);
}

Rgb open_sky_irradiance(const World& world, const Vec3& up) {
  constexpr int kRings = 128, kSectors = 512;  // a resolution of one degree or finer
  const NodeList& shaders = world.environment;
  if (shaders.empty()) return Rgb(0);
  const Frame frame(up);
  Imath::Vec3<double> sum(0.0);  // double: 65536 terms
  for (int ring = 0; ring < kRings; ++ring) {
    // Equal shares of cosine-weighted solid angle.
    const float sin2 = (static_cast<float>(ring) + .5f) / kRings;
    const float r = std::sqrt(sin2), z = std::sqrt(1 - sin2);
    for (int sector = 0; sector < kSectors; ++sector) {
      const float phi = kTwoPi * (static_cast<float>(sector) + .5f) / kSectors;
      const Vec3 w = frame.to_world(Vec3(r * math::cos(phi), r * math::sin(phi), z));
      const Rgb c =
          rgb(environment_radiance(shaders, world, Vec3(0), w, RayKind::FinalGather, false));
      sum += Imath::Vec3<double>(c.x, c.y, c.z);
    }
  }
  return Rgb(Imath::V3f(sum / double{kRings * kSectors})) * kPi;
}

}  // namespace oriel
