// SPDX-License-Identifier: Apache-2.0
// Sun, sky and exposures with parameters connected to shaders, evaluated per direction.
#include "lights/photon_source.h"
#include "runtime/color_mapping.h"
#include "sky/physical_sky.h"
#include "support/directions.h"
#include "support/portal_scenes.h"

namespace oriel::testing {
namespace connected_sky_test {

/// "side": `low` where x of the ray's direction is negative, else `high`; as a colour.
std::string side(float low, float high) {
  return fmt::format(
      "shader \"side\" \"test_sky\" ( \"above\" {1} {1} {1}, \"below\" {0} {0} {0}, \"up\" 1 0 0 )",
      low, high);
}

const Vec3 kRight = sky_direction(25, 10), kLeft = sky_direction(40, 170);

std::string sky(const Vec3& to_sun, const std::string& more) {
  return fmt::format("\"mia_physicalsky\" ( \"sun_direction\" {}, {} )", text_of(to_sun), more);
}

// acceptance: S8
TEST(ConnectedSky, NightHasTheStarsOfATexture) {
  const Vec3 set = sky_direction(-40, 0);
  SceneText scene;
  scene.statement(side(.25f, 3)).environment(sky(set, "\"night_color\" = \"side\""));
  const Probe probe(scene);
  expect_exact("stars", probe.ray(Vec3(0), kRight, 64), 3);
  expect_exact("night", probe.ray(Vec3(0), kLeft, 64), .25f);
  // It is a floor: by day the sky is as without, where it is brighter.
  const Vec3 up = sky_direction(50, 120);
  SceneText day;
  day.statement(side(.25f, 30)).environment(sky(up, "\"night_color\" = \"side\""));
  const sky::PhysicalSky plain({.sun_direction = up});
  for (const Vec3& d : {kRight, kLeft}) {
    const Rgb floor(d.x > 0 ? 30 : .25f), sky = plain.radiance(d);
    expect_exact("day", Probe(day).ray(Vec3(0), d, 64),
                 Rgb(std::max(sky.x, floor.x), std::max(sky.y, floor.y), std::max(sky.z, floor.z)));
  }
}

// The mean of both halves of a night lights a card: E / pi of each half of the sphere is 1/2.
// acceptance: S8
TEST(ConnectedSky, StarsLightTheSceneInEveryMode) {
  SceneText scene;
  scene.statement(side(1, 3))
      .environment(sky(sky_direction(-40, 0), "\"night_color\" = \"side\", \"horizon_blur\" 0"))
      .lambert("card", 1)
      .square("card", Vec3(0), 1, kUp);
  const Probe probe(scene);
  expect_exact("card under stars", probe.onto(Vec3(0), kUp, 20, 1 << 15), 2);
  // Photons and gather rays use the same shader calls as final gathering.
  const PhotonSource source(probe.world());
  for (int i = 0; i < 64; ++i) {
    sampling::Sampler s(0, 0, static_cast<std::uint32_t>(i));
    const Vec2 u = s.next_2d();
    const EmittedPhoton photon = source.emit(u, s.next_2d());
    if (photon.direction.z > -.01f) continue;
    EXPECT_NEAR(source.power(photon, 1).y / photon.weight, photon.direction.x < 0 ? 3 : 1, 1e-4f);
  }
}

// acceptance: S4
TEST(ConnectedSky, HazeOfARampIsThatOfTheDirection) {
  for (const Vec3& to_sun : {kRight, kLeft}) {
    SceneText scene;
    scene.statement(side(2, 8)).environment(sky(to_sun, "\"haze\" = \"side\""));
    const Probe probe(scene);
    for (const Vec3& d : {kRight, kLeft, sky_direction(5, 80), sky_direction(-30, 100)}) {
      const sky::PhysicalSky there({.haze = d.x >= 0 ? 8.0f : 2.0f, .sun_direction = to_sun});
      expect_exact("hazy side", probe.ray(Vec3(0), d, 64), there.radiance(d));
    }
  }
}

// acceptance: S4, S10
TEST(ConnectedSky, TheSunHasTheHazeOfItsDisc) {
  for (const Vec3& to_sun : {kRight, kLeft}) {
    SceneText scene;
    scene.statement(side(2, 8))
        .lambert("card", 1)
        .square("card", Vec3(0), 1, to_sun)
        .light("sun", "\"mia_physicalsun\" ( \"haze\" = \"side\", \"samples\" 0 ) direction " +
                          text_of(-to_sun));
    Probe probe(scene);
    const Rgb exact = sky::sun_colour({.haze = to_sun.x > 0 ? 8.0f : 2.0f}, to_sun);
    expect_exact("sun in its haze", probe.direct_only().onto(Vec3(0), to_sun, 30, 64), exact);
    const Light& sun = probe.world().lights[0];
    EXPECT_FALSE(sun.photons.none);
    const PhotonSource source(probe.world(), sun);
    const EmittedPhoton photon = source.emit(Vec2(.4f), Vec2(.6f));
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(source.power(photon, 1)[k] / photon.weight, kPi * exact[k], 1e-4f * exact[k]);
    // Its softness is of the same haze.
    SceneText soft;
    soft.statement(side(2, 8))
        .light("sun", "\"mia_physicalsun\" ( \"haze\" = \"side\" ) direction " + text_of(-to_sun));
    soft.lambert("card", 1).square("card", Vec3(0), 1, kUp);
    EXPECT_NEAR(Probe(soft).world().lights[0].cone_angle, .00465f * (to_sun.x > 0 ? 1.8f : 1.2f),
                1e-6f);
  }
}

TEST(ConnectedExposure, GainsOfAShaderAreThoseOfThePixel) {
  const std::string lenses[] = {
      "\"mia_exposure_simple\" ( \"gain\" = \"side\", \"compression\" 0, \"gamma\" 1 )",
      "\"mia_exposure_photographic\" ( \"film_iso\" 0, \"cm2_factor\" = \"side\", \"vignetting\" "
      "0, "
      "\"burn_highlights\" 1, \"crush_blacks\" 0, \"gamma\" 1 )"};
  for (const std::string& lens : lenses) {
    SceneText scene;
    scene.statement(side(.5f, 3))
        .uniform_sky(1)
        .camera("focal 1 aperture 1 aspect 1 resolution 8 8 lens " + lens);
    const Probe probe(scene);
    for (const float x : {1.5f, 6.5f}) {
      const Rgb mapped =
          map_color(probe.world().lens, probe.world(), Vec2(x, 4), Rgb(.1f, .2f, .3f));
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(mapped[k], Rgb(.1f, .2f, .3f)[k] * (x > 4 ? 3 : .5f), 1e-5f) << lens << x;
    }
  }
}

TEST(ConnectedSky, CieSkyIsEvaluatedPerDirection) {
  SceneText scene;
  scene.statement(side(500, 2000))
      .environment(
          "\"mia_ciesky\" ( \"overcast\" 1, \"zenith_luminance\" = \"side\", "
          "\"rgb_unit_conversion\" 1 1 1 )");
  const Probe probe(scene);
  const Vec3 a = sky_direction(30, 10), b = sky_direction(30, 170);
  // Overcast: luminance by elevation alone, (1 + 2 sin el) / 3 of the zenith's.
  expect_exact("bright side", probe.ray(Vec3(0), a, 64), kPi * 2000 * 2 / 3);
  expect_exact("dark side", probe.ray(Vec3(0), b, 64), kPi * 500 * 2 / 3);
}

}  // namespace connected_sky_test
}  // namespace oriel::testing
