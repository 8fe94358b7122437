// SPDX-License-Identifier: Apache-2.0
// Scenes with motion along a strip of pixels, and their expected radiance over the shutter time.
#pragma once

#include "output/output.h"
#include "support/picture.h"
#include "support/probe.h"

namespace oriel::testing {

/// Pixels of one unit; x from -20 to 20.
inline constexpr const char* kStrip = "focal infinity aperture 40 aspect 8 resolution 40 5";
inline constexpr std::uint32_t kSamples = 256;

inline std::string shift(float x, float y = 0, float z = 0) {
  // World to local: the way back.
  return fmt::format("1 0 0 0 0 1 0 0 0 0 1 0 {} {} {} 1", -x, -y, -z);
}
inline std::string moves_by(float x, float y = 0, float z = 0) {
  return "motion transform " + shift(x, y, z);
}

inline Image rendered(const std::string& text, std::uint32_t samples = kSamples) {
  const RenderedScene scene(text, {.budget = {.samples = samples}});
  return std::move(film_layers(scene.session(), {}).front().image);
}
inline Image rendered(const SceneText& scene, std::uint32_t samples = kSamples) {
  return rendered(scene.str(), samples);
}

/// A glowing square of side 2 `half` around x, at z = -5.
inline std::vector<Vec3> square_at(float x, float half = 2) {
  return {{x - half, -half, -5}, {x + half, -half, -5}, {x + half, half, -5}, {x - half, half, -5}};
}

/// How much of the time [from, to] something 2 `half` wide that goes from x by `way` in one
/// interval covers of the pixel [pixel, pixel + 1].
inline double covered(double pixel, double x, double way, double from = 0, double to = 1,
                      double half = 2) {
  constexpr int kSteps = 100000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double middle = x + way * (from + (to - from) * (i + .5) / kSteps);
    sum += std::max(0.0, std::min(pixel + 1, middle + half) - std::max(pixel, middle - half));
  }
  return sum / kSteps;
}

/// The middle row shows the streak: each pixel, and their sum, within 4 standard errors of shares
/// that are found by chance.
inline void expect_streak(const Image& image, double x, double way, double from = 0, double to = 1,
                          double half = 2) {
  double sum = 0, exact_sum = 0, variance = 0;
  for (int i = 0; i < 40; ++i) {
    const double exact = covered(i - 20, x, way, from, to, half);
    const double error = std::sqrt(exact * (1 - exact) / kSamples);
    EXPECT_NEAR(image.at(i, 2)[0], exact, 4 * error + 1e-3) << "pixel " << i;
    sum += static_cast<double>(image.at(i, 2)[0]);
    exact_sum += exact;
    variance += error * error;
  }
  EXPECT_NEAR(sum, exact_sum, 4 * std::sqrt(variance));
}

/// Mean over the shutter of what a ray sees.
inline Measured seen(const Probe& probe, const Vec3& origin, const Vec3& direction,
                     int samples = 16384) {
  return probe.over(samples, [&](sampling::Sampler& sampler, int) {
    const float time = probe.world().shutter.at(sampler.next_1d());
    return std::pair(Camera::Ray{origin, normalize(direction), 1, 0, 0, time}, Vec2(0));
  });
}

/// Motion of the pixels that show something, which must all be alike.
inline Vec3 motion_layer(const SceneText& scene) {
  const RenderedScene rendered(
      scene, {.budget = {.samples = 16}, .surface_values = LayerSet("motion").surface_values()});
  const auto layers = film_layers(rendered.session(), LayerSet("motion"));
  EXPECT_EQ(layers.back().name, "motion");
  const Image& image = layers.back().image;
  Vec3 found(0);
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const Vec3 here(image.pixels[3 * i], image.pixels[3 * i + 1], image.pixels[3 * i + 2]);
    if (here == Vec3(0)) continue;
    if (found == Vec3(0)) found = here;
    EXPECT_LT(length(here - found), 1e-4f) << here << found;
  }
  return found;
}

}  // namespace oriel::testing
