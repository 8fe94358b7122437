// SPDX-License-Identifier: Apache-2.0
// Cases for the effect of each parameter of the architectural material, and shared helpers.
#pragma once

#include <sstream>

#include "support/probe.h"

namespace oriel::sensitivity {

using testing::kRounding;
using testing::kUp;
using testing::Measured;
using testing::Probe;
using testing::SceneText;
using testing::test_registry;
using testing::text_of;

/// One parameter and a check of its documented effect on the image.
struct Case {
  const char* parameter;
  void (*check)();
};
using Cases = std::vector<Case>;
inline void PrintTo(const Case& c, std::ostream* out) { *out << c.parameter; }

Cases diffuse_cases();
Cases reflection_cases();
Cases refraction_cases();
Cases direction_cases();
Cases limit_cases();
Cases occlusion_cases();
Cases option_cases();
Cases interpolation_cases();
Cases base_layer_cases();

/// Nothing but a diffuse colour, a mirror, a sheet that passes everything, glass that does.
inline const std::string kMatte = "reflectivity 0, ";
inline const std::string kMirror =
    "diffuse_weight 0, reflectivity 1, brdf_0_degree_refl 1, refl_color 1 1 1, ";
inline const std::string kGlass = "diffuse_weight 0, reflectivity 0, transparency 1, ";
inline const std::string kSheet = kGlass + "thin_walled on, ";

/// `.mi` parameters of "name value, name value": names in quotes, of repeated ones the last.
inline std::string parameters(const std::string& list) {
  std::vector<std::pair<std::string, std::string>> found;
  std::istringstream parts(list);
  for (std::string part; std::getline(parts, part, ',');) {
    std::istringstream words(part);
    std::string name, value;
    if (!(words >> name)) continue;
    std::getline(words, value);
    std::erase_if(found, [&](const auto& f) { return f.first == name; });
    found.emplace_back(name, value);
  }
  std::string text;
  for (const auto& [name, value] : found)
    text += fmt::format("{}\"{}\"{}", text.empty() ? "" : ", ", name, value);
  return text;
}

/// A square plate of that material at the origin that faces up.
inline SceneText plate(const std::string& list) {
  SceneText scene;
  return scene.material("m", parameters(list)).plate("m");
}
/// The same under a white sky of radiance 1; under a sun of 1 that shines that way.
inline SceneText plate_in_sky(const std::string& list) { return plate(list).uniform_sky(1); }
inline SceneText with_sun(SceneText scene, const Vec3& direction, const char* color = "1 1 1") {
  return scene.light("sun", fmt::format("\"mib_light_infinite\" ( \"color\" {}, \"shadow\" on ) "
                                        "direction {}",
                                        color, text_of(direction)));
}
inline SceneText plate_in_sun(const std::string& list, const Vec3& direction = -kUp) {
  return with_sun(plate(list), direction);
}

/// The middle of the plate from above at this angle: mirrored rays continue toward +x.
inline Measured seen(const Probe& probe, float degrees = 0, int samples = 4096) {
  const float a = degrees * kPi / 180;
  const Vec3 d(std::sin(a), 0, -std::cos(a));
  return probe.ray(d * -.5f, d, samples);
}
inline Measured seen(const SceneText& scene, float degrees = 0, int samples = 4096) {
  return seen(Probe(scene), degrees, samples);
}
/// By light sources and reflections alone.
inline Measured seen_direct(const SceneText& scene, float degrees = 0, int samples = 64) {
  return seen(Probe(scene).direct_only(), degrees, samples);
}
/// With one path for the pixel, which has all rays of the material.
inline Measured seen_by_one_path(const SceneText& scene, float degrees = 0) {
  return seen(Probe(scene).paths_of_pixel(1), degrees, 64);
}

/// Brighter by more than chance.
inline void expect_more(const Measured& more, const Measured& less, int channel = 0) {
  const float error = std::hypot(more.error[channel], less.error[channel]);
  EXPECT_GT(more.mean[channel] - less.mean[channel],
            4 * error + kRounding * std::abs(more.mean[channel]))
      << more.mean[channel] << " against " << less.mean[channel];
}
inline void expect_rising(const std::vector<Measured>& steps, int channel = 0) {
  for (std::size_t i = 1; i < steps.size(); ++i) expect_more(steps[i], steps[i - 1], channel);
}
inline void expect_equal(const Measured& a, const Measured& b) { expect_same("", a, b, .05f); }
/// So many times as bright.
inline void expect_times(float factor, const Measured& less, const Measured& more) {
  Measured scaled = less;
  scaled.mean *= factor;
  scaled.error *= factor;
  expect_same("", more, scaled, .05f);
}
inline void expect_color(const Measured& m, const Rgb& color) { expect_exact("", m, color, .05f); }

/// A small glow that a plate mirrors, or lets through, to a view from 30 degrees: what is seen
/// there, and twelve degrees beside it.
struct Spot {
  Measured centre, beside;

  Spot(const std::string& list, bool behind) {
    const Vec3 way(.5f, 0, behind ? -.8660254f : .8660254f);
    const Probe probe(plate(list).emitter("glow", 1).square("glow", way * 2.0f, .15f, -way));
    centre = seen(probe, 30, 16384);
    beside = seen(probe, 42, 16384);
  }
};
/// Blurring takes light from the centre and spreads it to the side.
inline void expect_spread(const Spot& sharp, const Spot& blurred) {
  expect_more(sharp.centre, blurred.centre);
  expect_more(blurred.beside, sharp.beside);
}

}  // namespace oriel::sensitivity
