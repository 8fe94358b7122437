// SPDX-License-Identifier: Apache-2.0
// Measuring: means of random samples to a stated precision, with intervals that hold.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "sampling/sampler.h"
#include "transport/counts.h"
#include "transport/path/irradiance_sensor.h"

namespace oriel {

/// When a reading is good enough; whichever comes first ends it.
struct MeasureRequest {
  double precision = .02;  ///< half width of the interval as a share of the value
  double floor = 0;        ///< half width that is good enough whatever the value, its unit
  std::uint64_t max_samples = std::uint64_t{1} << 20;  ///< of each reading; rounded up to batches
  double seconds = 0;  ///< for all readings together, after the first pass; 0 = no limit
  std::uint32_t seed = 0;
};

/// A mean and how far it may be from the truth.
struct Reading {
  double value = 0;
  double half_width = 0;  ///< the truth lies within value +- this in 95 of 100 readings
  std::uint64_t samples = 0;
  bool precise = false;  ///< as good as was asked
};

/// One sample of quantity i. Many threads ask at once.
using Quantity =
    std::function<double(std::size_t i, sampling::Sampler& sampler, RayCounts& counts)>;

/// Takes readings of `count` quantities.
///
/// Model:   samples come in batches of kBatchSamples with random numbers of their own, stratified
///          within. The interval is Student's t over the means of the batches. A pass doubles the
///          number of batches of the readings that are not good enough yet. Readings end when their
///          interval happens to look narrow, which it does too often: for that half of the degrees
///          of freedom are given away, and the number of batches grows, not their size. Of
///          simulated intervals of hit-or-miss quantities 95 in 100 held the truth, of quantities
///          with long tails 93 to 95 (all degrees and batches of twice the size: 91 to 94).
///          What no sample has found is not in the interval: light that one path of ten thousand
///          finds needs more samples than that, whatever the interval says.
///          Deterministic, unless time ends it.
/// Checked: MeasureStatistics.* in measure_test.cpp
std::vector<Reading> take_readings(std::size_t count, const Quantity& quantity,
                                   const MeasureRequest& request,
                                   const std::atomic<bool>* cancel = nullptr);

inline constexpr std::uint32_t kBatchSamples = 16, kFirstBatches = 64;

/// Half width of the two-sided 95 % interval of Student's t, in standard errors.
///
/// Source:  G. W. Hill, "Algorithm 396: Student's t-Quantiles", CACM 13(10), 1970: its expansion
///          about the normal quantile, to the third power of 1 / degrees; within 2e-4 from 10 on.
/// Checked: MeasureStatistics.StudentsFactorIsThatOfTables
double student_95(double degrees);

/// Illuminance in lux of each meter, by paths.
///
/// Inputs:  unit: cd/m2 of one unit of a pixel.
/// Checked: tests/analytic/measure_test.cpp
std::vector<Reading> measure_illuminance(const World& world,
                                         const std::vector<IrradianceSensor>& sensors, float unit,
                                         const MeasureRequest& request,
                                         const PathSettings& settings = {},
                                         const std::atomic<bool>* cancel = nullptr);

/// Mean of all readings with its interval: they are independent of each other.
Reading mean_reading(const std::vector<Reading>& readings);

/// What the eye sees in the middle of a pixel.
struct Spot {
  bool surface = false;     ///< false: nothing is there but the environment
  IrradianceSensor sensor;  ///< lies on the surface, on the side that is seen
  float distance = 0;       ///< from the eye, scene units
  std::string material, instance;
};

/// Inputs:  raster: as Camera::ray takes it.
Spot find_spot(const World& world, Vec2 raster);

/// Luminance of pixels, evenly over their squares; lower left corners in raster space.
std::vector<Reading> measure_luminance(const World& world, const std::vector<Vec2>& pixels,
                                       float unit, const MeasureRequest& request,
                                       const std::atomic<bool>* cancel = nullptr);

/// Irradiance (see IrradianceSensor) of open level ground under the scene's environment alone, by
/// quadrature; without what is seen by the eye alone (a sun's disc).
Rgb open_sky_irradiance(const World& world, const Vec3& up);

}  // namespace oriel
