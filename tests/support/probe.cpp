// SPDX-License-Identifier: Apache-2.0
#include "support/probe.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "base/parallel.h"
#include "lights/light_sampler.h"
#include "mi/reader.h"
#include "shaders/registry.h"
#include "transport/gather/gather_passes.h"
#include "transport/gather/guide_points.h"

namespace oriel::testing {
namespace {

/// Batches with independent random numbers, so that their spread is the error of the mean even
/// though samples within one are stratified.
constexpr int kBatches = 64;

}  // namespace

Probe::Probe(const std::string& text, const Registry& registry, const PrepareOptions& prepared) {
  Diagnostics diagnostics;
  mi::ReadOptions options;
  options.packages = builtin_packages();
  options.knows_shader = [&](std::string_view n) { return registry.find(n) != nullptr; };
  scene_ = mi::read_text(text, options, diagnostics);
  PrepareReport report;
  if (!scene_.renders.empty())
    world_ = prepare(scene_, scene_.renders.back(), registry, prepared, diagnostics, report);
  for (const Diagnostic& d : diagnostics.all()) ADD_FAILURE() << diagnostics.format(d);
  if (!world_) throw std::runtime_error("the scene cannot be rendered");
}

Probe& Probe::without_openings() {
  world_->light_sampler =
      std::make_shared<const LightSampler>(*world_, EnvironmentLight(*world_), MeshLights());
  return *this;
}

Measured Probe::measure(int samples, const EyeRays& eye) const {
  const int per_batch = std::max(1, samples / kBatches);
  std::vector<Rgb> means(kBatches);
  std::vector<RayCounts> counts(kBatches);
  std::vector<float> alphas(kBatches);
  std::vector<AovValues> outputs(kBatches);
  std::vector<std::pair<Rgb, Rgb>> ranges(kBatches, {Rgb(1e30f), Rgb(-1e30f)});
  parallel_for(kBatches, [&](std::size_t b) {
    Imath::Vec3<double> sum(0.0);  // double: up to a million terms
    PathRecord record({.aovs = outputs_});
    for (int s = 0; s < per_batch; ++s) {
      sampling::Sampler sampler(static_cast<int>(b), 7, static_cast<std::uint32_t>(s));
      const auto [ray, raster] = eye(sampler, s);
      PathResult& r = record;
      r = {};  // the AOVs are summed
      trace_path(*world_, ray, raster, settings_, record, sampler, counts[b]);
      sum += Imath::Vec3<double>(r.radiance.x, r.radiance.y, r.radiance.z);
      for (int k = 0; k < 3; ++k) {
        ranges[b].first[k] = std::min(ranges[b].first[k], r.radiance[k]);
        ranges[b].second[k] = std::max(ranges[b].second[k], r.radiance[k]);
      }
      alphas[b] += r.alpha / static_cast<float>(per_batch);
    }
    means[b] = Rgb(Imath::V3f(sum / double(per_batch)));
    if (outputs_) outputs[b] = *record.aovs;
  });
  Measured m;
  for (int b = 0; b < kBatches; ++b) {
    m.mean += means[static_cast<std::size_t>(b)] / kBatches;
    m.alpha += alphas[static_cast<std::size_t>(b)] / kBatches;
    m.counts += counts[static_cast<std::size_t>(b)];
    const AovValues& part = outputs[static_cast<std::size_t>(b)];
    const float share = 1 / (kBatches * static_cast<float>(per_batch));
    for (std::size_t i = 0; i < kAovs; ++i) m.outputs.result[i] += part.result[i] * share;
    for (std::size_t i = 0; i < kLevels; ++i) m.outputs.level[i] += part.level[i] * share;
    m.outputs.opacity = part.opacity;
  }
  for (const Rgb& v : means) m.error += (v - m.mean) * (v - m.mean);
  for (int k = 0; k < 3; ++k) {
    m.error[k] = std::sqrt(m.error[k] / (kBatches - 1.0f) / kBatches);
    // Stratified choices may fall the same way in all batches: half a sample's worth in each.
    float lo = 1e30f, hi = -1e30f;
    for (const auto& range : ranges) {
      lo = std::min(lo, range.first[k]);
      hi = std::max(hi, range.second[k]);
    }
    const float step = 0.5f * (hi - lo) / static_cast<float>(per_batch);
    if (hi - lo > 1e-4f * hi) m.error[k] = std::max(m.error[k], step / std::sqrt(kBatches * 1.0f));
  }
  m.samples = double(per_batch) * kBatches;
  if (const geom::Box3 box = world_->accel->bounds(); !box.isEmpty())
    m.extent = box.size().length();
  return m;
}

float rounding_of(float exact, float brightest, float extent) {
  constexpr float kPlaces = 4 * 6.0e-8f;
  const float relative = kRounding * std::max(1e-4f, brightest);
  return exact == 0 ? std::max(relative, kPlaces * extent) : relative;
}

void figure(const std::string& name, double exact, double measured, double error) {
  static const bool wanted = std::getenv("ORIEL_FIGURES") != nullptr;
  if (wanted)
    fmt::print("| {} | {:.6g} | {:.6g} | {:.2g} | {:+.1f} |\n", name, exact, measured, error,
               error > 0 ? (measured - exact) / error : 0.0);
}

void expect_exact(const std::string& name, const Measured& m, const Rgb& exact,
                  float largest_error) {
  const float scale = std::max(1e-4f, max_component(exact));
  for (int k = 0; k < 3; ++k) {
    const float tolerance = 4 * m.error[k] + rounding_of(exact[k], max_component(exact), m.extent);
    EXPECT_NEAR(m.mean[k], exact[k], tolerance)
        << name << " channel " << k << ", standard error " << m.error[k];
    EXPECT_LE(m.error[k], largest_error * (exact[k] > 0 ? exact[k] : scale))
        << name << ": too noisy to show anything";
  }
  figure(name, exact.x, m.mean.x, m.error.x);
}

Bounces Probe::coarse_records(const GatherSettings& settings) const {
  const Camera& camera = world_->camera;
  RayCounts counts;
  return gather_bounces(*world_,
                        first_gather_points(*world_, {0, 0, camera.width, camera.height},
                                            {settings, {}, 1, 0}, counts),
                        settings, 0, counts, {});
}

std::unique_ptr<LearnedLights> Probe::learned(decltype(measure_lights)& measure,
                                              int samples) const {
  RayCounts counts;
  const Bounces coarse = coarse_records(gather_settings(world_->options, world_->accel->bounds()));
  auto lights =
      std::make_unique<LearnedLights>(measure(*world_, coarse.points, samples, 0, counts));
  EXPECT_FALSE(lights->empty()) << "nothing to choose from";
  return lights;
}

Probe& Probe::learned_lights(int samples) {
  lights_ = learned(measure_lights, samples);
  settings_.lights = lights_->empty() ? nullptr : lights_.get();
  return *this;
}

Probe& Probe::learned_emitters(int samples) {
  emitters_ = learned(measure_emitters, samples);
  settings_.emitters = emitters_->empty() ? nullptr : emitters_.get();
  return *this;
}

Probe& Probe::guided(int rays) {
  RayCounts counts;
  const ProgressMonitor monitor;
  GatherSettings settings = gather_settings(world_->options, world_->accel->bounds());
  settings.path.diffuse_bounces = PathSettings::kAllBounces;
  const Bounces coarse = coarse_records(settings);
  guide_ =
      std::make_unique<DirectionGuide>(guide_points(*world_, coarse, rays, 0, 0, counts, monitor));
  settings_.guide = guide_->empty() ? nullptr : guide_.get();
  EXPECT_TRUE(settings_.guide) << "no points for a guide";
  return *this;
}

void expect_same(const std::string& name, const Measured& a, const Measured& b,
                 float largest_error) {
  for (int k = 0; k < 3; ++k) {
    const float error = std::hypot(a.error[k], b.error[k]);
    EXPECT_NEAR(a.mean[k], b.mean[k],
                4 * error + rounding_of(b.mean[k], std::abs(b.mean[k]), b.extent))
        << name << " channel " << k;
    EXPECT_LE(error, largest_error * std::max(std::abs(b.mean[k]), 1e-6f)) << name << ": too noisy";
  }
  figure(name, b.mean.x, a.mean.x, std::hypot(a.error.x, b.error.x));
}

}  // namespace oriel::testing
