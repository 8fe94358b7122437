// SPDX-License-Identifier: Apache-2.0
// Light scattered below spheres, whose area within a chord c of a point is pi c^2: the profile is
// normalised there as on a plane.
#include <cmath>

#include "support/probe.h"

namespace oriel::testing {
namespace subsurface_test {

constexpr float kSphere = .5f;

/// A white layer of that radius on a sphere around the origin.
SceneText sphere(float radius) {
  SceneText scene;
  scene
      .statement(
          "material \"m\" \"misss_fast_simple_maya\" ( \"diffuse_weight\" 0, "
          "\"front_sss_color\" 1 1 1, \"front_sss_weight\" 1, \"back_sss_weight\" 0, "
          "\"front_sss_radius\" " +
          std::to_string(radius) + " ) end material")
      .sphere("m", Vec3(0), kSphere, 192);
  return scene;
}

TEST(SubsurfaceScattering, ASphereUnderAnEvenSkyIsAsBrightAsTheSky) {
  for (const float radius : {.05f, .3f, .8f}) {
    const Probe probe(sphere(radius).uniform_sky(1));
    for (const float degrees : {0.0f, 45.0f, 80.0f}) {
      const float a = degrees * kPi / 180;
      const Vec3 normal(0, 0, 1), at = normal * kSphere;
      const Vec3 away(std::sin(a), 0, std::cos(a));
      const Measured m = probe.ray(at + away * .5f, -away, 20000);
      expect_exact("sphere of white layers", m, Rgb(1), .02f);
    }
  }
}

/// What the pole of the sphere shows under a sun above it: at the chord c the cosine to the sun is
/// 1 - c^2 / 2 r^2.
float at_pole(double radius) {
  constexpr int kSteps = 4000;
  const double d = radius / 8;
  double all = 0, lit = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double c = radius * (i + .5) / kSteps;
    const double share = std::exp(-c / d) + std::exp(-c / (3 * d));
    all += share;
    lit += share * std::max(0.0, 1 - c * c / (2 * double{kSphere} * double{kSphere}));
  }
  return static_cast<float>(lit / all);
}

TEST(SubsurfaceScattering, LightSpreadsFromThePoleOfASphere) {
  for (const float radius : {.1f, .4f, .9f}) {
    SceneText scene = sphere(radius);
    scene.light("sun",
                "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
    const Measured m = Probe(scene).direct_only().ray(Vec3(0, 0, 1), Vec3(0, 0, -1), 40000);
    expect_exact("pole of a sphere in the sun", m, Rgb(at_pole(double{radius})), .02f);
  }
}

TEST(SubsurfaceScattering, DiffuseBouncesSeeTheSameBrightness) {
  // A card above a floor with and without a radius, by paths and by the floor's mean light.
  const auto card = [](const std::string& floor_radius) {
    SceneText scene;
    scene
        .statement(
            "material \"floor\" \"misss_fast_simple_maya\" ( \"diffuse_weight\" 0, "
            "\"front_sss_color\" .8 .8 .8, \"front_sss_weight\" 1, \"back_sss_weight\" 0, "
            "\"front_sss_radius\" " +
            floor_radius + " ) end material")
        .plate("floor")
        .lambert("card", 1)
        .square("card", Vec3(0, 0, 1), .2f, Vec3(0, 0, -1))
        .light("sun",
               "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" off ) direction 0 0 -1");
    return Probe(scene).onto(Vec3(0, 0, 1), Vec3(0, 0, -1), 0, 20000);
  };
  expect_same("card over a scattering floor", card("1"), card("0"), .02f);
}

}  // namespace subsurface_test
}  // namespace oriel::testing
