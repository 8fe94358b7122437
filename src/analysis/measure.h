// SPDX-License-Identifier: Apache-2.0
// Measurements: means of random samples with a given precision and reliable confidence intervals.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "sampling/sampler.h"
#include "transport/counts.h"
#include "transport/path/irradiance_sensor.h"

namespace oriel {

/// Stopping criteria of a reading; the first one that is met applies.
struct MeasureRequest {
  double precision = .02;  ///< half width of the interval relative to the value
  double floor = 0;        ///< absolute half width that is sufficient, in the unit of the value
  std::uint64_t max_samples = std::uint64_t{1} << 20;  ///< per reading; rounded up to whole batches
  double seconds = 0;  ///< for all readings together, checked after the first pass; 0 = no limit
  std::uint32_t seed = 0;
};

/// A mean with its confidence interval.
struct Reading {
  double value = 0;
  double half_width = 0;  ///< half width of the 95 % confidence interval
  std::uint64_t samples = 0;
  bool precise = false;  ///< whether the requested precision was reached
};

/// Returns one sample of quantity i. Called from many threads.
using Quantity =
    std::function<double(std::size_t i, sampling::Sampler& sampler, RayCounts& counts)>;

/// Measures `count` quantities.
///
/// Model:   samples are drawn in batches of kBatchSamples with independent random numbers,
///          stratified within a batch. The interval is Student's t over the batch means. Each pass
///          doubles the number of batches of the readings that are not precise yet. Stopping when
///          the interval happens to be narrow biases it; to compensate, half of the degrees of
///          freedom are discarded, and the number of batches grows instead of their size. In
///          simulations 95 of 100 intervals of hit-or-miss quantities contained the true value, and
///          93 to 95 of long-tailed quantities (91 to 94 with all degrees and batches of twice the
///          size). Rare light that no sample has found is not covered by the interval: light that
///          one path in ten thousand finds requires more samples. Deterministic unless the time
///          limit ends it.
/// Checked: MeasureStatistics.* in measure_test.cpp
std::vector<Reading> take_readings(std::size_t count, const Quantity& quantity,
                                   const MeasureRequest& request,
                                   const std::atomic<bool>* cancel = nullptr);

inline constexpr std::uint32_t kBatchSamples = 16, kFirstBatches = 64;

/// Half width of the two-sided 95 % interval of Student's t in standard errors.
///
/// Source:  G. W. Hill, "Algorithm 396: Student's t-Quantiles", CACM 13(10), 1970: expansion about
///          the normal quantile to the third power of 1 / degrees; within 2e-4 from 10 on.
/// Checked: MeasureStatistics.StudentsFactorIsThatOfTables
double student_95(double degrees);

/// Illuminance in lux at each irradiance sensor, by path tracing.
///
/// Inputs:  unit: cd/m2 per pixel unit.
/// Checked: tests/analytic/outputs/measure_test.cpp
std::vector<Reading> measure_illuminance(const World& world,
                                         const std::vector<IrradianceSensor>& sensors, float unit,
                                         const MeasureRequest& request,
                                         const PathSettings& settings = {},
                                         const std::atomic<bool>* cancel = nullptr);

/// Mean of all readings with its interval, assuming independence.
Reading mean_reading(const std::vector<Reading>& readings);

/// The surface that is visible at the centre of a pixel.
struct Spot {
  bool surface = false;     ///< false: only the environment is visible
  IrradianceSensor sensor;  ///< on the surface, on the visible side
  float distance = 0;       ///< from the camera, scene units
  std::string material, instance;
};

/// Inputs:  raster: as in Camera::ray.
Spot find_spot(const World& world, Vec2 raster);

/// Mean luminance of pixels over their area; lower left corners in raster space.
std::vector<Reading> measure_luminance(const World& world, const std::vector<Vec2>& pixels,
                                       float unit, const MeasureRequest& request,
                                       const std::atomic<bool>* cancel = nullptr);

/// Irradiance (see IrradianceSensor) of unoccluded horizontal ground under the environment of the
/// scene, by quadrature. Excludes light that only camera rays see (the disc of a sun).
Rgb open_sky_irradiance(const World& world, const Vec3& up);

}  // namespace oriel
