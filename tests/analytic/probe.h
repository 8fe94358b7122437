// SPDX-License-Identifier: Apache-2.0
// Prepares composed scenes and measures radiance in them, with its standard error.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "base/parallel.h"
#include "mi/reader.h"
#include "prepare/prepare.h"
#include "scene_text.h"
#include "shaders/registry.h"
#include "transport/path/path.h"

namespace oriel::analytic {

/// "test_sky": one colour in the half space of `up`, another in the other.
struct TestSky {
  Rgba above, below;
  Vec3 up;
};
inline constexpr ParamSpec kTestSkyRows[] = {{ORIEL_PARAM(TestSky, above)},
                                             {ORIEL_PARAM(TestSky, below)},
                                             {ORIEL_PARAM(TestSky, up), .fallback = {0, 0, 1}}};
inline constexpr ShaderSpec kTestSky = {
    .name = "test_sky",
    .library = "test",
    .apply = kApplyEnvironment,
    .params = kTestSkyRows,
    .params_size = sizeof(TestSky),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<TestSky>();
          *static_cast<Rgba*>(result) =
              dot(call.point.ray_direction, p.up) >= 0 ? p.above : p.below;
        },
};

/// "test_direction": where a ray goes, as a colour around .5.
inline constexpr ShaderSpec kTestDirection = {
    .name = "test_direction",
    .library = "test",
    .apply = kApplyEnvironment,
    .value =
        [](const Call& call, void* result) {
          const Vec3 c = call.point.ray_direction * 0.5f + Vec3(0.5f);
          *static_cast<Rgba*>(result) = Rgba(c.x, c.y, c.z, 1);
        },
};

/// "test_place": the point in world space as a colour, so that a target tells where it was hit.
struct TestPlace {
  Vec3 scale;
};
inline constexpr ParamSpec kTestPlaceRows[] = {
    {ORIEL_PARAM(TestPlace, scale), .fallback = {1, 1, 1}}};
inline constexpr ShaderSpec kTestPlace = {
    .name = "test_place",
    .library = "test",
    .apply = kApplyTexture,
    .params = kTestPlaceRows,
    .params_size = sizeof(TestPlace),
    .value =
        [](const Call& call, void* result) {
          const Vec3 p = call.point.position * call.as<TestPlace>().scale;
          *static_cast<Rgba*>(result) = Rgba(p.x, p.y, p.z, 1);
        },
};

/// "test_tilt": a bump shader, which turns the normal itself and returns nothing.
struct TestTilt {
  Vec3 normal;
};
inline constexpr ParamSpec kTestTiltRows[] = {{ORIEL_PARAM(TestTilt, normal)}};
inline constexpr ShaderSpec kTestTilt = {
    .name = "test_tilt",
    .library = "test",
    .apply = kApplyTexture,
    .params = kTestTiltRows,
    .params_size = sizeof(TestTilt),
    .value =
        [](const Call& call, void* result) {
          call.point.normal = normalize(call.as<TestTilt>().normal);
          *static_cast<Rgba*>(result) = Rgba(0);
        },
};

inline const Registry& test_registry() {
  static const Registry registry([] {
    std::vector<const ShaderSpec*> specs = builtin_shaders().all();
    specs.push_back(&kTestSky);
    specs.push_back(&kTestDirection);
    specs.push_back(&kTestPlace);
    specs.push_back(&kTestTilt);
    return specs;
  }());
  return registry;
}

/// Mean radiance in pixel units and the standard error of that mean, by channel.
struct Measured {
  Rgb mean{0}, error{0};
  RayCounts counts;  ///< of all samples together
  double samples = 0;
  float alpha = 0;
  float extent = 1;   ///< diagonal of the scene's bounds, scene units
  AovValues outputs;  ///< mean results and levels, where Probe::outputs() asked for them

  /// Mean number of rays of one kind for each path, as in `m.each(m.counts.reflect)`.
  double each(std::uint64_t count) const { return double(count) / samples; }
};

/// A prepared scene that can be measured.
class Probe {
 public:
  explicit Probe(const SceneText& scene) : Probe(scene.str()) {}
  explicit Probe(const std::string& text, const Registry& registry = test_registry(),
                 const PrepareOptions& prepared = {}) {
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

  const World& world() const { return *world_; }
  /// Without diffuse bounces, as a scene without indirect light is rendered.
  Probe& direct_only() {
    settings_.indirect = false;
    return *this;
  }
  Probe& estimator(Estimator estimator) {
    settings_.estimator = estimator;
    return *this;
  }
  /// Whether what glows is sampled as a light.
  Probe& mesh_lights(bool on) {
    settings_.mesh_lights = on;
    return *this;
  }

  /// Paths that share the sample counts of the materials; unless told, each lobe gets one ray.
  Probe& paths_of_pixel(float paths) {
    settings_.paths_of_pixel = paths;
    return *this;
  }
  /// Tells the radiance apart by the components of the first material.
  Probe& outputs() {
    outputs_ = true;
    return *this;
  }

  /// Along one ray of the camera's kind.
  Measured ray(const Vec3& origin, const Vec3& direction, int samples = 4096) const {
    const Camera::Ray eye{origin, normalize(direction), 1, 0, 0};
    return measure(samples, [&](sampling::Sampler&, int) { return std::pair(eye, Vec2(0)); });
  }
  /// From `distance` away onto a point, at `degrees` from its normal (tilted toward `side`).
  Measured onto(const Vec3& point, const Vec3& normal, float degrees = 0, int samples = 4096,
                float distance = 0.5f) const {
    const Frame frame(normal);
    const float a = degrees * kPi / 180;
    const Vec3 away = frame.n * std::cos(a) + frame.s * std::sin(a);
    return ray(point + away * distance, -away, samples);
  }
  /// Over one pixel; (0, 0) is the lower left one.
  Measured pixel(int x, int y, int samples = 4096) const {
    return pixels(x, y, x + 1, y + 1, samples);
  }
  /// Over a block of pixels.
  Measured pixels(int x0, int y0, int x1, int y1, int samples) const {
    return measure(samples, [&](sampling::Sampler& sampler, int) {
      const Vec2 u = sampler.next_2d();
      const Vec2 raster(lerp(static_cast<float>(x0), static_cast<float>(x1), u.x),
                        lerp(static_cast<float>(y0), static_cast<float>(y1), u.y));
      return std::pair(world_->camera.ray(raster), raster);
    });
  }
  Measured picture(int samples) const {
    return pixels(0, 0, world_->camera.width, world_->camera.height, samples);
  }
  /// Over the rays that `eye(sampler, sample)` returns, each with its place on the raster.
  template <class F>
  Measured over(int samples, const F& eye) const {
    return measure(samples, eye);
  }

 private:
  /// Batches with independent random numbers, so that their spread is the error of the mean even
  /// though samples within one are stratified.
  static constexpr int kBatches = 64;

  template <class F>
  Measured measure(int samples, const F& eye) const {
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
      if (hi - lo > 1e-4f * hi)
        m.error[k] = std::max(m.error[k], step / std::sqrt(kBatches * 1.0f));
    }
    m.samples = double(per_batch) * kBatches;
    if (const geom::Box3 box = world_->accel->bounds(); !box.isEmpty())
      m.extent = box.size().length();
    return m;
  }

  scene::Scene scene_;
  std::unique_ptr<World> world_;
  PathSettings settings_;
  bool outputs_ = false;
};

/// Rounding of a path's products and of tessellated, shifted ray origins; relative.
inline constexpr float kRounding = 2e-5f;

/// What rounding may add to a channel of which `exact` is expected beside others up to `brightest`.
/// Where zero is expected no relative error bounds it: then it is the rounding of places in a scene
/// of that extent, a few units of the last place of a float.
inline float rounding_of(float exact, float brightest, float extent) {
  constexpr float kPlaces = 4 * 6.0e-8f;
  const float relative = kRounding * std::max(1e-4f, brightest);
  return exact == 0 ? std::max(relative, kPlaces * extent) : relative;
}

/// Prints a row of the table of figures when ORIEL_FIGURES is set.
inline void figure(const std::string& name, double exact, double measured, double error) {
  static const bool wanted = std::getenv("ORIEL_FIGURES") != nullptr;
  if (wanted)
    fmt::print("| {} | {:.6g} | {:.6g} | {:.2g} | {:+.1f} |\n", name, exact, measured, error,
               error > 0 ? (measured - exact) / error : 0.0);
}

/// |mean - exact| <= 4 standard errors, and the error small enough for that to mean something.
inline void expect_exact(const std::string& name, const Measured& m, const Rgb& exact,
                         float largest_error = 0.005f) {
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
inline void expect_exact(const std::string& name, const Measured& m, float exact,
                         float largest_error = 0.005f) {
  expect_exact(name, m, Rgb(exact), largest_error);
}

/// Two measurements of the same thing.
inline void expect_same(const std::string& name, const Measured& a, const Measured& b,
                        float largest_error = 0.005f) {
  for (int k = 0; k < 3; ++k) {
    const float error = std::hypot(a.error[k], b.error[k]);
    EXPECT_NEAR(a.mean[k], b.mean[k],
                4 * error + rounding_of(b.mean[k], std::abs(b.mean[k]), b.extent))
        << name << " channel " << k;
    EXPECT_LE(error, largest_error * std::max(std::abs(b.mean[k]), 1e-6f)) << name << ": too noisy";
  }
  figure(name, b.mean.x, a.mean.x, std::hypot(a.error.x, b.error.x));
}

}  // namespace oriel::analytic
