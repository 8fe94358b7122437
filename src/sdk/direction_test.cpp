// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/ward_lobe.h"
#include "oriel/sdk/shader/brdf.h"
#include "oriel/sdk/shader/direction.h"
#include "sampling/testing/chi_square.h"
#include "sdk/testing/bare_state.h"

namespace oriel::sdk {
namespace direction_test {

using bsdf::WardLobe;
using testing::BareState;
using testing::DirectionTest;
using testing::test_directions;

constexpr int kDraws = 40000;
/// Joint significance of all tests of this file.
const double kSignificance = testing::sidak(.01, 10);

struct Draw {
  double u[2];
  explicit Draw(const Vec2& from) : u{from.x, from.y} {}
};

void expect_density(const DirectionTest& test) {
  EXPECT_NEAR(test.pdf_integral, 1, 2e-3);
  EXPECT_NEAR(test.drawn, 1, 1e-9);
  EXPECT_GT(test.chi.p_value, kSignificance);
}

TEST(Directions, MirrorTurnsAboutTheNormal) {
  BareState bare;
  bare.look_down(.6f, .8f);
  miVector dir;
  mi_reflection_dir(&dir, &bare.state());
  EXPECT_NEAR(dir.x, .6f, 1e-6f);
  EXPECT_NEAR(dir.z, .8f, 1e-6f);
  mi_reflection_dir_specular(&dir, &bare.state());
  EXPECT_NEAR(dir.z, .8f, 1e-6f);
}

TEST(Directions, RefractionFollowsSnell) {
  BareState bare;
  for (const float ratio : {1.0f, 1.33f, 1.5f, 2.4f, .8f})
    for (const float sine : {0.0f, .3f, .6f, .75f}) {
      bare.look_down(sine, std::sqrt(1 - sine * sine));
      miVector dir;
      ASSERT_TRUE(mi_refraction_dir(&dir, &bare.state(), 1, ratio));
      EXPECT_NEAR(dir.x * ratio, sine, 1e-5f);
      EXPECT_LT(dir.z, 0);
      EXPECT_NEAR(mi_vector_norm(&dir), 1, 1e-5f);
    }
}

TEST(Directions, TotalReflectionBeginsAtTheCriticalAngle) {
  BareState bare;
  const float critical = 1 / 1.5f;
  miVector dir;
  for (const auto transmit : {mi_refraction_dir, mi_transmission_dir_specular}) {
    bare.look_down(critical - .001f, std::sqrt(1 - sqr(critical - .001f)));
    EXPECT_TRUE(transmit(&dir, &bare.state(), 1.5f, 1));
    bare.look_down(critical + .001f, std::sqrt(1 - sqr(critical + .001f)));
    EXPECT_FALSE(transmit(&dir, &bare.state(), 1.5f, 1));
  }
  EXPECT_FALSE(mi_transmission_dir_glossy(&dir, &bare.state(), 1.5f, 1, 50));
}

TEST(Directions, ANormalOnTheOtherSideChangesNothing) {
  BareState bare;
  bare.look_down(.6f, .8f);
  miVector from_front, from_behind;
  ASSERT_TRUE(mi_refraction_dir(&from_front, &bare.state(), 1, 1.5f));
  bare.state().normal = {0, 0, -1};
  ASSERT_TRUE(mi_refraction_dir(&from_behind, &bare.state(), 1, 1.5f));
  EXPECT_NEAR(from_front.x, from_behind.x, 1e-6f);
  EXPECT_NEAR(from_front.z, from_behind.z, 1e-6f);
}

TEST(Directions, DiffuseDirectionsMatchTheCosine) {
  BareState bare;
  bare.look_down(.6f, .8f);
  for (const float side : {1.0f, -1.0f})
    expect_density(test_directions(
        [&](const Vec2& u, float) -> std::optional<Vec3> {
          miVector dir;
          (side > 0 ? mi_reflection_dir_diffuse_x : mi_transmission_dir_diffuse_x)(
              &dir, &bare.state(), Draw(u).u);
          return vec(dir);
        },
        [&](const Vec3& w) { return std::max(0.0f, side * w.z) * kInvPi; }, kDraws, 11));
}

TEST(Directions, GlossyDirectionsMatchTheirDensity) {
  BareState bare;
  bare.look_down(.6f, .8f);
  const Vec3 wo(-.6f, 0, .8f);
  const miVector u_axis = {1, 0, 0}, v_axis = {0, 1, 0};
  expect_density(test_directions(
      [&](const Vec2& u, float) -> std::optional<Vec3> {
        miVector dir;
        mi_reflection_dir_glossy_x(&dir, &bare.state(), 4, Draw(u).u);
        return vec(dir);
      },
      [&](const Vec3& w) { return WardLobe(4, 4).pdf(wo, w); }, kDraws, 12));
  expect_density(test_directions(
      [&](const Vec2& u, float) -> std::optional<Vec3> {
        miVector dir;
        mi_reflection_dir_anisglossy_x(&dir, &bare.state(), &u_axis, &v_axis, 3, 9, Draw(u).u);
        return vec(dir);
      },
      [&](const Vec3& w) { return WardLobe(3, 9).pdf(wo, w); }, kDraws, 13));
}

TEST(Directions, TransmittedGlossyDirectionsSurroundTheRefractedOne) {
  BareState bare;
  bare.look_down(.6f, .8f);
  for (const float ior : {1.0f, 1.5f}) {
    miVector refracted;
    ASSERT_TRUE(mi_refraction_dir(&refracted, &bare.state(), 1, ior));
    const Vec3 seen = -vec(refracted);
    expect_density(test_directions(
        [&](const Vec2& u, float) -> std::optional<Vec3> {
          miVector dir;
          if (!mi_transmission_dir_glossy_x(&dir, &bare.state(), 1, ior, 5, Draw(u).u)) return {};
          return vec(dir);
        },
        [&](const Vec3& w) { return WardLobe(5, 5).pdf(seen, Vec3(w.x, w.y, -w.z)); }, kDraws, 14));
  }
}

TEST(Directions, NarrowLobesAreMirrors) {
  BareState bare;
  bare.look_down(.6f, .8f);
  miVector mirror, dir;
  mi_reflection_dir(&mirror, &bare.state());
  for (int i = 0; i < 100; ++i) {
    mi_reflection_dir_glossy(&dir, &bare.state(), 1e5f);
    EXPECT_GT(mi_vector_dot(&mirror, &dir), .99999f);
  }
}

TEST(Directions, ScatteredDirectionsMatchThePhaseFunction) {
  BareState bare;
  bare.look_down(.6f, .8f);
  int pixel = 0;
  for (const float k : {-.7f, .3f, .9f})
    expect_density(test_directions(
        [&](const Vec2&, float) -> std::optional<Vec3> {
          bare.numbers.start(++pixel);
          miVector dir;
          mi_scattering_dir_directional(&dir, &bare.state(), k);
          return vec(dir);
        },
        [&](const Vec3& w) {
          const miVector wi = as_c(w);
          return mi_schlick_scatter(&bare.state().dir, &wi, k);
        },
        kDraws, 15));
  expect_density(test_directions(
      [&](const Vec2&, float) -> std::optional<Vec3> {
        bare.numbers.start(++pixel);
        miVector dir;
        mi_scattering_dir_diffuse(&dir, &bare.state());
        return vec(dir);
      },
      [&](const Vec3&) { return .25f * kInvPi; }, kDraws, 16));
}

TEST(Directions, FreePathsAreExponential) {
  BareState bare;
  constexpr float kExtinction = 2.5f;
  double mean = 0;
  int beyond = 0;
  for (int i = 0; i < kDraws; ++i) {
    bare.numbers.start(i);
    const float length = mi_scattering_pathlength(&bare.state(), kExtinction);
    mean += length / kDraws;
    beyond += length > 1;
  }
  // Standard deviations: .4 / 200 and sqrt(.082 .918 40000) = 55.
  EXPECT_NEAR(mean, 1 / kExtinction, 4 * .002);
  EXPECT_NEAR(beyond, kDraws * std::exp(-kExtinction), 4 * 55);
  EXPECT_EQ(mi_scattering_pathlength(&bare.state(), 0), miHUGE_SCALAR);
}

}  // namespace direction_test
}  // namespace oriel::sdk
