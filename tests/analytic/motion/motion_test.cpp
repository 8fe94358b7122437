// SPDX-License-Identifier: Apache-2.0
// Motion blur compared with closed forms: streaks, rotating bars, moving cameras, shadows, mirrors.
#include "lights/light_sampler.h"
#include "motion_scenes.h"

namespace oriel::testing {
namespace motion_test {

SceneText streak(const std::string& shutter, const std::string& flags) {
  SceneText scene(shutter);
  return scene.emitter("glow", 1).polygon("glow", square_at(-8), flags).camera(kStrip);
}

/// The same by motion vectors; `vectors` of each corner alike.
SceneText vector_streak(const std::string& shutter, const std::vector<Vec3>& vectors,
                        const std::string& flags = {}) {
  SceneText scene(shutter);
  std::string object = "object \"o\" visible on shadow on trace on group\n", motion;
  for (const Vec3& p : square_at(-8)) object += text_of(p) + '\n';
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    object += text_of(vectors[k]) + '\n';
    motion += fmt::format(" m {}", 4 + k);
  }
  for (int i = 0; i < 4; ++i) object += fmt::format("v {}{}\n", i, motion);
  object += "c 0 1 2 3 end group end object\n";
  return scene.emitter("glow", 1)
      .statement(object +
                 fmt::format("instance \"i\" \"o\" material \"glow\" {} end instance", flags))
      .member("i")
      .camera(kStrip);
}

TEST(MotionBlur, AMovingSquareLeavesABoxOfItsLight) {
  expect_streak(rendered(streak("shutter 1", moves_by(12.5f))), -8, 12.5);
  expect_streak(rendered(vector_streak("shutter 1", {{12.5f, 0, 0}})), -8, 12.5);
}

TEST(MotionBlur, VectorsAndTransformsAddUp) {
  expect_streak(rendered(vector_streak("shutter 1", {{5, 0, 0}}, moves_by(7.5f))), -8, 12.5);
}

TEST(MotionBlur, ShutterLimitsTheMotion) {
  expect_streak(rendered(streak("shutter .25 .75", moves_by(12.5f))), -8, 12.5, .25, .75);
  expect_streak(rendered(streak("shutter delay .5 shutter 1", moves_by(12.5f))), -8, 12.5, .5, 1);
  expect_streak(rendered(vector_streak("shutter 0 1.5", {{12.5f, 0, 0}})), -8, 12.5, 0, 1.5);
  expect_streak(rendered(streak("shutter -.5 .5", moves_by(12.5f))), -8, 12.5, -.5, .5);
}

TEST(MotionBlur, AClosedShutterIsAStillPicture) {
  const Image still = rendered(streak("", ""), 16);
  for (const char* closed : {"shutter 0 0", "shutter 1 motion off", "motion on", ""})
    EXPECT_EQ(rendered(streak(closed, moves_by(12.5f)), 16).pixels, still.pixels) << closed;
  EXPECT_EQ(rendered(streak("shutter 1", moves_by(12.5f) + " motion off"), 16).pixels,
            still.pixels);
  // At a later time it shows the object at that time.
  const Image half = rendered(streak("shutter .5 .5", moves_by(16)), 16);
  for (int i = 0; i < 40; ++i) EXPECT_NEAR(half.at(i, 2)[0], covered(i - 20, 0, 0), 1e-5) << i;
}

TEST(MotionBlur, SeveralVectorsFollowACurve) {
  // Right by 8 in the first half, up out of the picture and right in the second.
  const Image image = rendered(vector_streak("shutter 1", {{8, 0, 0}, {16, 40, 0}}));
  for (int i = 0; i < 20; ++i) {
    // While moving up, the middle row sees it for a twentieth of that half.
    double exact = covered(i - 20, -8, 8, 0, 1) / 2;
    for (int k = 0; k < 20000; ++k) {
      const double t = (k + .5) / 20000, y = 40 * t, x = 8 * t;
      const double high = std::max(0.0, std::min(.5, y + 2) - std::max(-.5, y - 2));
      exact += high * std::max(0.0, std::min(i - 19.0, x + 2) - std::max(i - 20.0, x - 2)) / 40000;
    }
    EXPECT_NEAR(image.at(i, 2)[0], exact, 4 * std::sqrt(exact * (1 - exact) / kSamples) + 1e-3)
        << i;
  }
}

TEST(MotionBlur, MovingCameraBlursStaticObjects) {
  SceneText scene("shutter 1");
  scene.emitter("glow", 1).polygon("glow", square_at(-8));
  scene.camera(kStrip, shift(0) + " " + moves_by(-12.5f));
  expect_streak(rendered(scene), -8, 12.5);
  // An object that moves with the camera is sharp while it is in the image.
  SceneText along("shutter 1 motion steps 4");
  along.emitter("glow", 1).polygon("glow", square_at(-8), moves_by(30, 7));
  along.camera(kStrip, shift(0) + " " + moves_by(30, 7));
  const Image image = rendered(along, 16);
  for (int i = 0; i < 40; ++i) EXPECT_NEAR(image.at(i, 2)[0], covered(i - 20, -8, 0), 1e-4) << i;
}

TEST(MotionBlur, ATurningBarDarkensWithTheRadius) {
  constexpr float kHalf = .1f;
  const auto bar = [&](int steps) {
    SceneText scene(fmt::format("shutter 1 motion steps {}", steps));
    // Turned by a quarter: world to local is the turn back.
    scene.emitter("glow", 1).polygon(
        "glow", {{-3, -kHalf, -5}, {3, -kHalf, -5}, {3, kHalf, -5}, {-3, kHalf, -5}},
        "motion transform 0 -1 0 0 1 0 0 0 0 0 1 0 0 0 0 1");
    return Probe(scene);
  };
  const Probe round = bar(15), straight = bar(1);
  const float at = kPi / 4;
  for (const float r : {.5f, 1.0f, 2.0f, 2.9f}) {
    const Vec3 place(r * std::cos(at), r * std::sin(at), 0);
    const float exact = 2 * std::asin(kHalf / r) / (kPi / 2);
    const Measured m = seen(round, place, {0, 0, -1});
    // Between its steps of 6 degrees the bar is thinner by up to 1 - cos(3 degrees).
    EXPECT_NEAR(m.mean.x, exact, 4 * m.error.x + .003f * exact) << r;
  }
  // In one step the end cuts the corner: at half time it is at half of the square's diagonal.
  const Vec3 outside(2.5f * std::cos(at), 2.5f * std::sin(at), 0);
  EXPECT_EQ(seen(straight, outside, {0, 0, -1}).mean.x, 0);
  EXPECT_GT(seen(round, outside, {0, 0, -1}).mean.x, .01f);
}

TEST(MotionBlur, ShadowsDarkenByTheTimeOfTheirBlocker) {
  SceneText scene("shutter 1");
  scene.lambert("white", 1).lambert("dark", 0).square("white", Vec3(0), 20, {0, 0, 1});
  scene.polygon("dark", {{-6, -1, 2}, {-4, -1, 2}, {-4, 1, 2}, {-6, 1, 2}}, moves_by(10));
  scene.light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
  const Probe probe(scene);
  for (const float x : {-5.5f, -3.0f, 0.0f, 4.25f, 7.0f}) {
    // Covered while -6 + 10 t < x < -4 + 10 t.
    const float from = std::max(0.0f, (x + 4) / 10), to = std::min(1.0f, (x + 6) / 10);
    const Measured m = seen(probe, {x, 0, 1}, {0, 0, -1});
    EXPECT_NEAR(m.mean.x, 1 - std::max(0.0f, to - from), 4 * m.error.x + 1e-5f) << x;
  }
}

TEST(MotionBlur, MirrorsShowMotionAtTheSameTime) {
  SceneText scene("trace depth 4 4 8 shutter 1");
  scene.emitter("glow", 1)
      .material("mirror",
                "\"reflectivity\" 1, \"refl_gloss\" 1, \"diffuse_weight\" 0, "
                "\"brdf_0_degree_refl\" 1, \"brdf_90_degree_refl\" 1")
      .square("mirror", Vec3(0), 50, {0, 0, 1});
  scene.polygon("glow", {{-6, -1, 3}, {-4, -1, 3}, {-4, 1, 3}, {-6, 1, 3}}, moves_by(10));
  const Probe probe(scene);
  // Down at 45 degrees along x, up again: seen at x + 2 + 3 in the plane z = 3.
  for (const float x : {-8.0f, -5.0f, -1.0f}) {
    const float at = x + 5;
    const float from = std::max(0.0f, (at + 4) / 10), to = std::min(1.0f, (at + 6) / 10);
    const Measured m = seen(probe, {x, 0, 2}, {1, 0, -1});
    EXPECT_NEAR(m.mean.x, to - from, 4 * m.error.x + 1e-4f) << x;
  }
}

TEST(MotionBlur, MovingLightsIlluminateAtRayTime) {
  const auto lit = [](const std::string& light, const std::string& flags) {
    SceneText scene("shutter 1");
    scene.lambert("white", 1).square("white", Vec3(0), 20, {0, 0, 1}).light("lamp", light, flags);
    return Probe(scene);
  };
  const std::string point = "\"mib_light_point\" ( \"color\" 1 1 1, \"factor\" 0 ) origin -4 0 2";
  const Measured m = seen(lit(point, moves_by(8)), {1, 0, 1}, {0, 0, -1});
  // The cosine alone: without decay.
  double exact = 0;
  for (int i = 0; i < 10000; ++i) {
    const double x = -4 + 8 * (i + .5) / 10000 - 1;
    exact += 2 / std::sqrt(x * x + 4) / 10000;
  }
  EXPECT_NEAR(m.mean.x, exact, 4 * static_cast<double>(m.error.x) + 1e-4);
  // A square that shines down turns over: half of the time it shines at all... and is seen.
  const std::string area =
      "\"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 2 "
      "rectangle 1 0 0 0 -1 0 visible";
  const Measured still = seen(lit(area, ""), {.2f, 0, 1}, {0, 0, -1});
  const Measured there =
      seen(lit(area, "transform " + shift(-3) + " " + moves_by(-3)), {-2.8f, 0, 1}, {0, 0, -1});
  EXPECT_NEAR(there.mean.x, still.mean.x, 4 * (there.error.x + still.error.x));
  const Probe moving = lit(area, moves_by(4));
  const Measured seen_light = seen(moving, {2, .1f, 0.1f}, {0, 0, 1});
  const Measured seen_still = seen(lit(area, ""), {0, .1f, 0.1f}, {0, 0, 1});
  EXPECT_GT(seen_still.mean.x, 0);
  EXPECT_NEAR(seen_light.mean.x, seen_still.mean.x / 4,
              4 * seen_light.error.x + 1e-3f * seen_still.mean.x);
}

TEST(MotionBlur, MovingEmissionIsSampledAtRayTime) {
  SceneText scene("shutter 1 motion steps 3");
  scene.lambert("white", 1).square("white", Vec3(0), .01f, {0, 0, 1}).emitter("glow", 1);
  scene.polygon("glow", {{-3, -1, 1}, {-3, 1, 1}, {-1, 1, 1}, {-1, -1, 1}}, moves_by(4, 0, .5f));
  const Vec3 above(.3f, 0, .4f);
  const Measured sampled = seen(Probe(scene), above, -above, 65536);
  const Measured found = seen(Probe(scene).mesh_lights(false), above, -above, 262144);
  EXPECT_FALSE(Probe(scene).world().light_sampler->mesh_lights().empty());
  expect_same("moving glow", sampled, found, .01f);
}

TEST(MotionBlur, LensesOfAMovingCameraMoveWithIt) {
  const auto picture = [](const char* shutter, const std::string& object,
                          const std::string& camera) {
    SceneText scene(shutter);
    scene.emitter("glow", 1).polygon("glow", square_at(-8), object);
    scene.camera(
        "focal 1 aperture 4 aspect 8 resolution 40 5 lens \"mia_lens_bokeh\" ( "
        "\"on\" on, \"plane\" 3, \"radius\" .2, \"samples\" 4 )",
        shift(0) + camera);
    return rendered(scene, 64);
  };
  const Image still = picture("", "", "");
  const Image along = picture("shutter 1", moves_by(3, 2, 1), " " + moves_by(3, 2, 1));
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < still.pixels.size(); ++i) {
    difference += std::abs(static_cast<double>(still.pixels[i] - along.pixels[i]));
    sum += static_cast<double>(still.pixels[i]);
  }
  EXPECT_GT(sum, 10);
  EXPECT_LT(difference, 1e-3 * sum);
}

TEST(MotionLayer, ContainsTheMotionInTheImage) {
  const auto expect = [](const SceneText& scene, const Vec3& exact) {
    const Vec3 found = motion_layer(scene);
    EXPECT_LT(length(found - exact), 1e-4f) << found << " is not " << exact;
  };
  const std::string way = moves_by(12.5f, 2, -1);
  expect(streak("shutter 1", way), {12.5f, 2, 1});
  expect(streak("shutter .5", way), {6.25f, 1, .5f});
  // Pictures without blur, for programs that add it: the motion is that of the whole interval.
  expect(streak("shutter .5 .5", way), {12.5f, 2, 1});
  expect(streak("shutter .5 2", way), {18.75f, 3, 1.5f});
  expect(vector_streak("shutter 1", {{12.5f, 2, -1}}), {12.5f, 2, 1});
  expect(streak("", way), Vec3(0));
  SceneText camera("shutter 1");
  camera.emitter("glow", 1).polygon("glow", square_at(-8));
  camera.camera(kStrip, shift(0) + " " + moves_by(-3, 1));
  expect(camera, {3, -1, 0});
}

TEST(MotionLayer, PathsThatShadersStartDoNotChangeIt) {
  // The camera looks into a mirror at rest, which shows a wall whose shader gathers light from
  // something that moves.
  SceneText scene("shutter 1 trace depth 4 4 8");
  scene
      .material("mirror",
                "\"reflectivity\" 1, \"diffuse_weight\" 0, \"brdf_fresnel\" off, "
                "\"brdf_0_degree_refl\" 1")
      .emitter("glow", 1)
      .statement("material \"gathering\" \"mib_lightmap_sample\" ( \"indirect\" on ) end material")
      .square("mirror", Vec3(0, 0, -5), 40, Vec3(0, 0, 1))
      .square("gathering", Vec3(0, 0, 5), 60, Vec3(0, 0, -1))
      .polygon("glow", {{50, -60, -60}, {50, 60, -60}, {50, 60, 60}, {50, -60, 60}},
               moves_by(0, 5, 0));
  scene.camera(kStrip);
  EXPECT_EQ(motion_layer(scene), Vec3(0));
}

}  // namespace motion_test
}  // namespace oriel::testing
