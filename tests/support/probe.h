// SPDX-License-Identifier: Apache-2.0
// Prepares composed scenes and measures radiance in them, with its standard error.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "base/frame.h"
#include "prepare/prepare.h"
#include "sampling/sampler.h"
#include "support/scene_text.h"
#include "support/test_shaders.h"
#include "transport/direction_guide.h"
#include "transport/gather/gather_bounces.h"
#include "transport/gather/light_points.h"
#include "transport/path/lit_surfaces.h"
#include "transport/path/path.h"

namespace oriel::testing {

/// Mean radiance in pixel units and the standard error of that mean, by channel.
struct Measured {
  Rgb mean{0}, error{0};
  RayCounts counts;  ///< of all samples together
  double samples = 0;
  float alpha = 0;
  float extent = 1;   ///< diagonal of the scene's bounds, scene units
  AovValues outputs;  ///< mean results and levels, if enabled by Probe::outputs()

  /// Mean number of rays of one kind for each path, as in `m.each(m.counts.reflect)`.
  double each(std::uint64_t count) const { return double(count) / samples; }
};

/// Returns the ray of a sample and its place on the raster.
using EyeRays = std::function<std::pair<Camera::Ray, Vec2>(sampling::Sampler&, int sample)>;

/// A prepared scene that can be measured.
class Probe {
 public:
  explicit Probe(const SceneText& scene) : Probe(scene.str()) {}
  explicit Probe(const std::string& text, const Registry& registry = test_registry(),
                 const PrepareOptions& prepared = {});

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
  /// Paths find the windows of rooms by chance only. Also removes emissive surfaces from the
  /// lights.
  Probe& without_openings();
  /// Whether emissive surfaces are sampled as lights.
  Probe& mesh_lights(bool on) {
    settings_.mesh_lights = on;
    return *this;
  }

  /// Samples the surfaces that directional lights illuminate, as renders by paths do.
  Probe& lit_surfaces() {
    const Camera& camera = world_->camera;
    RayCounts counts;
    lit_ = std::make_unique<LitSurfaces>(*world_, Window{0, 0, camera.width, camera.height}, 0,
                                         counts);
    settings_.lit = lit_->empty() ? nullptr : lit_.get();
    return *this;
  }
  bool has_lit_surfaces() const { return settings_.lit != nullptr; }
  /// Diffuse bounces follow a guide from `rays` rays of each coarse record.
  Probe& guided(int rays = 128);
  /// Rays of diffuse lobes at the first surface.
  Probe& diffuse_rays(int rays) {
    settings_.diffuse_rays = rays;
    return *this;
  }
  /// Lights are chosen by what reaches coarse records.
  Probe& learned_lights(int samples = 8);
  /// The same for the parts of emissive meshes.
  Probe& learned_emitters(int samples = 8);
  const PathSettings& settings() const { return settings_; }

  /// Paths that share the sample counts of the materials; by default each lobe gets one ray.
  Probe& paths_of_pixel(float paths) {
    settings_.paths_of_pixel = paths;
    return *this;
  }
  /// Splits the radiance by the components of the first material.
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
  Measured over(int samples, const EyeRays& eye) const { return measure(samples, eye); }

 private:
  Measured measure(int samples, const EyeRays& eye) const;
  Bounces coarse_records(const GatherSettings& settings) const;
  std::unique_ptr<LearnedLights> learned(decltype(measure_lights)& measure, int samples) const;

  scene::Scene scene_;
  std::unique_ptr<World> world_;
  PathSettings settings_;
  std::unique_ptr<LitSurfaces> lit_;
  std::unique_ptr<DirectionGuide> guide_;
  std::unique_ptr<LearnedLights> lights_, emitters_;
  bool outputs_ = false;
};

/// Rounding of a path's products and of tessellated, shifted ray origins; relative.
inline constexpr float kRounding = 2e-5f;

/// What rounding may add to a channel of which `exact` is expected beside others up to `brightest`.
/// Where zero is expected no relative error bounds it: then it is the rounding of places in a scene
/// of that extent, a few units of the last place of a float.
float rounding_of(float exact, float brightest, float extent);

/// Prints a row of the table of figures when ORIEL_FIGURES is set.
void figure(const std::string& name, double exact, double measured, double error);

/// |mean - exact| <= 4 standard errors, and the error small enough for that to mean something.
void expect_exact(const std::string& name, const Measured& m, const Rgb& exact,
                  float largest_error = 0.005f);
inline void expect_exact(const std::string& name, const Measured& m, float exact,
                         float largest_error = 0.005f) {
  expect_exact(name, m, Rgb(exact), largest_error);
}

/// Two measurements of the same thing.
void expect_same(const std::string& name, const Measured& a, const Measured& b,
                 float largest_error = 0.005f);

}  // namespace oriel::testing
