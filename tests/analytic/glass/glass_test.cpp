// SPDX-License-Identifier: Apache-2.0
// Solid and thin glass: directions of refracted rays and their transmittance.
#include <numbers>

#include "support/probe.h"

namespace oriel::testing {
namespace glass_test {

constexpr double kRadians = std::numbers::pi / 180;

/// Unpolarised Fresnel reflectance from the angle outside or inside, in double.
double fresnel(double degrees, double n) {
  const double c = std::cos(degrees * kRadians), s = std::sin(degrees * kRadians) / n;
  if (s >= 1) return 1;
  const double t = std::sqrt(1 - s * s);
  const double rs = (c - n * t) / (c + n * t), rp = (n * c - t) / (n * c + t);
  return (rs * rs + rp * rp) / 2;
}

/// Ray that meets the origin at `degrees` from the axis, coming from below.
Measured rising(const SceneText& scene, double degrees, int samples, float from = .5f) {
  const float a = static_cast<float>(degrees * kRadians);
  const Vec3 d(std::sin(a), 0, std::cos(a));
  return Probe(scene).ray(d * -from, d, samples);
}

const char* const kGlass =
    "\"diffuse_weight\" 0, \"reflectivity\" 1, \"transparency\" 1, \"refr_ior\" 1.5, "
    "\"brdf_fresnel\" on, \"refl_depth\" 0, \"refr_depth\" 0, \"refl_cutoff\" 0, \"refr_cutoff\" 0";
/// No interface, only the medium inside.
const char* const kGel =
    "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, \"refr_ior\" 1, "
    "\"refr_depth\" 0";

SceneText deep() { return SceneText("trace depth 60 60 90 shadow segments"); }

SceneText& add_target(SceneText& scene, float height) {
  return scene.statement("shader \"place\" \"test_place\" ()")
      .material("target",
                "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"place\"")
      .square("target", Vec3(0, 0, height), 100, -kUp);
}

// acceptance: T1, B4
TEST(Glass, SlabShiftsTheViewBySnell) {
  // Reflections inside are weak at these angles, and left out.
  for (const double degrees : {20.0, 45.0, 60.0}) {
    SceneText scene;
    scene.material("glass", kGlass).box("glass", Vec3(-5, -5, 0), Vec3(5, 5, 1));
    add_target(scene, 3);
    const Measured m = rising(scene, degrees, 65536);
    const double inner = std::asin(std::sin(degrees * kRadians) / 1.5);
    const double x = std::tan(inner) + 2 * std::tan(degrees * kRadians);
    EXPECT_NEAR(3 * m.mean.x / m.mean.z, x, 1e-4 * x) << degrees;
    const double r = fresnel(degrees, 1.5);
    expect_exact(fmt::format("slab of glass at {} deg, transmitted", degrees), m,
                 Rgb(static_cast<float>(x), 0, 3) * static_cast<float>((1 - r) * (1 - r)));
    figure(fmt::format("place seen through the slab at {} deg", degrees), x,
           3 * m.mean.x / m.mean.z, 0);
  }
}

// The front of a surface is outside; what lies above is seen from within.
// acceptance: T1
TEST(Glass, LeavingRaysBendAwayAndAreReflectedTotallyBeyondTheCriticalAngle) {
  for (const double degrees : {0.0, 20.0, 40.0, 41.7, 41.9, 45.0, 80.0}) {
    for (const char* skip : {"on", "off"}) {
      SceneText scene;
      scene.material("glass", kGlass + fmt::format(", \"skip_inside_refl\" {}", skip))
          .square("glass", Vec3(0), 5, kUp)
          .half_sky(1, kUp);
      const double r = fresnel(degrees, 1 / 1.5);
      const float out = static_cast<float>(1 - r);
      expect_exact(fmt::format("leaving glass at {} deg", degrees), rising(scene, degrees, 65536),
                   out);
      SceneText inner;
      inner.material("glass", kGlass + fmt::format(", \"skip_inside_refl\" {}", skip))
          .square("glass", Vec3(0), 5, kUp)
          .half_sky(1, -kUp);
      // Weak reflections inside may be left out, strong and total ones never. acceptance: T7
      const bool left_out = std::string_view(skip) == "on" && r < .1;
      expect_exact(fmt::format("reflected inside at {} deg, skip {}", degrees, skip),
                   rising(inner, degrees, 65536), left_out ? 0 : static_cast<float>(r), .01f);
    }
    SceneText target;
    add_target(target.material("glass", kGlass).square("glass", Vec3(0), 5, kUp), 1);
    if (degrees > 41 || degrees == 0) continue;
    const Measured m = rising(target, degrees, 4096);
    const double outside = std::asin(1.5 * std::sin(degrees * kRadians));
    EXPECT_NEAR(m.mean.x / m.mean.z, std::tan(outside), 2e-4 * std::tan(outside));
  }
}

// acceptance: T1, E5
TEST(Glass, ReflectsByFresnelInThePicture) {
  const std::pair<double, float> table[] = {{0, .04f},      {30, .041523f}, {45, .050240f},
                                            {60, .089187f}, {75, .253061f}, {85, .612800f}};
  for (const auto& [degrees, r] : table) {
    SceneText scene;
    scene.material("glass", kGlass).square("glass", Vec3(0), 5, -kUp).half_sky(1, -kUp);
    expect_exact(fmt::format("glass reflects at {} deg", degrees), rising(scene, degrees, 1 << 17),
                 r);
  }
}

// acceptance: T2
TEST(Glass, ThinPaneAndSlabPassAndReflectTheSame) {
  const std::pair<double, float> table[] = {{0, .076923f}, {60, .163768f}, {75, .403908f}};
  for (const auto& [degrees, r] : table)
    for (const bool thin : {true, false}) {
      const char* shape = thin ? "pane" : "slab";
      for (const bool through : {true, false}) {
        SceneText scene = deep();
        scene.half_sky(1, through ? kUp : -kUp)
            .material("glass", std::string(kGlass) +
                                   (thin ? ", \"thin_walled\" on" : ", \"skip_inside_refl\" off"));
        if (thin)
          scene.square("glass", Vec3(0), 200, kUp);
        else
          scene.box("glass", Vec3(-200, -200, 0), Vec3(200, 200, .1f));
        expect_exact(
            fmt::format("{} {} at {} deg", shape, through ? "passes" : "reflects", degrees),
            rising(scene, degrees, 1 << 17), through ? 1 - r : r, .01f);
      }
    }
  SceneText scene;
  scene.material("glass", std::string(kGlass) + ", \"thin_walled\" on")
      .square("glass", Vec3(0), 5, kUp);
  add_target(scene, 3);
  const Measured m = rising(scene, 45, 4096);
  EXPECT_NEAR(m.mean.x / m.mean.z, 1, 5e-5);  // straight on
}

const char* const kAbsorbing =
    ", \"refr_falloff_on\" on, \"refr_falloff_dist\" 1, \"refr_falloff_color_on\" on, "
    "\"refr_falloff_color\" .5 .25 .8";

// acceptance: T4
TEST(Glass, AbsorbsToItsColourAtTheDistance) {
  for (const float d : {.5f, 1.0f, 2.0f}) {
    SceneText scene;
    scene.uniform_sky(1)
        .material("gel", std::string(kGel) + kAbsorbing)
        .box("gel", Vec3(-5, -5, 0), Vec3(5, 5, d));
    expect_exact(fmt::format("absorption over {} of 1", d), rising(scene, 0, 64),
                 Rgb(std::pow(.5f, d), std::pow(.25f, d), std::pow(.8f, d)));
  }
}

// acceptance: T4
TEST(Glass, FadesToBlackWithoutAColourAndRaysStopThere) {
  for (const float d : {.25f, .5f, .9f, 1.1f, 5.0f}) {
    SceneText scene;
    scene.uniform_sky(1)
        .material("gel", std::string(kGel) + ", \"refr_falloff_on\" on, \"refr_falloff_dist\" 1")
        .box("gel", Vec3(-5, -5, 0), Vec3(5, 5, d));
    const Measured m = rising(scene, 0, 64);
    expect_exact(fmt::format("fading over {} of 1", d), m, std::max(0.0f, 1 - d));
    // Beyond the distance neither surfaces nor the sky are evaluated.
    EXPECT_EQ(m.counts.environment, d < 1 ? 64u : 0u);
  }
}

// acceptance: T5
TEST(Glass, ColourOfTheSurfaceCountsFacesThatOfTheMediumThickness) {
  const std::string surface = std::string(kGel) + ", \"refr_color\" .5 .25 .8";
  const std::string medium = std::string(kGel) + kAbsorbing;
  const auto power = [](float e) {
    return Rgb(std::pow(.5f, e), std::pow(.25f, e), std::pow(.8f, e));
  };
  for (const float thick : {.3f, 1.5f})
    for (const bool in_medium : {false, true}) {
      SceneText scene;
      scene.uniform_sky(1)
          .material("gel", in_medium ? medium : surface)
          .box("gel", Vec3(-5, -5, 0), Vec3(5, 5, thick));
      expect_exact(
          fmt::format("block of {}, colour in the {}", thick, in_medium ? "glass" : "face"),
          rising(scene, 0, 64), power(in_medium ? thick : 2));
    }
  for (const bool hollow : {false, true})
    for (const bool in_medium : {false, true}) {
      SceneText scene;
      scene.uniform_sky(1)
          .material("gel", in_medium ? medium : surface)
          .sphere("gel", Vec3(0, 0, 3), 1, 96);
      if (hollow) scene.sphere("gel", Vec3(0, 0, 3), .9f, 96, true);
      const float thick = hollow ? .2f : 2.0f;
      const Measured m = Probe(scene).ray(Vec3(.001f, .002f, 0), kUp, 64);
      const Rgb exact = power(in_medium ? thick : hollow ? 4 : 2);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(m.mean[k] / exact[k], 1, .002f);
      figure(fmt::format("{} sphere, colour in the {}", hollow ? "hollow" : "solid",
                         in_medium ? "glass" : "face"),
             exact.x, m.mean.x, m.error.x);
    }
}

// acceptance: T6
TEST(Glass, MaterialsDepthEndsInBlackTheScenesInTheEnvironment) {
  const auto through_two_slabs = [](const char* trace_depth, int own) {
    SceneText scene{std::string(trace_depth) + " shadow segments"};
    scene.uniform_sky(1)
        .emitter("glow", 7)
        .material("gel",
                  fmt::format("\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, "
                              "\"refr_ior\" 1, \"refr_depth\" {}",
                              own))
        .box("gel", Vec3(-5, -5, 0), Vec3(5, 5, 1))
        .box("gel", Vec3(-5, -5, 2), Vec3(5, 5, 3))
        .square("glow", Vec3(0, 0, 4), 10, -kUp);
    return rising(scene, 0, 64).mean.x;
  };
  EXPECT_EQ(through_two_slabs("trace depth 9 9 9", 0), 7);
  EXPECT_EQ(through_two_slabs("trace depth 9 9 9", 4), 7);
  EXPECT_EQ(through_two_slabs("trace depth 9 9 9", 3), 0);
  EXPECT_EQ(through_two_slabs("trace depth 9 4 9", 0), 7);
  EXPECT_EQ(through_two_slabs("trace depth 9 3 9", 0), 1);
  EXPECT_EQ(through_two_slabs("trace depth 9 9 3", 0), 1);
}

// acceptance: T7
TEST(Glass, SkippedInnerReflectionsCostNoRays) {
  const auto rays = [](const char* skip) {
    SceneText scene = deep();
    scene.uniform_sky(1)
        .material("glass", kGlass + fmt::format(", \"skip_inside_refl\" {}", skip))
        .box("glass", Vec3(-5, -5, 0), Vec3(5, 5, 1));
    return rising(scene, 0, 1 << 16);
  };
  const Measured on = rays("on"), off = rays("off");
  // One reflection at the way in (r = .04); without skipping also each one inside.
  EXPECT_NEAR(double(on.counts.reflect) / on.samples, .04, .004);
  EXPECT_NEAR(double(off.counts.reflect) / off.samples, .04 + .96 * .04 / .96, .006);
}

// acceptance: T8
TEST(Glass, ShadowsAreColouredByFacesAndInSegmentsByThickness) {
  for (const char* mode : {"on", "segments"})
    for (const float thick : {.5f, 1.0f, 2.0f}) {
      SceneText scene{fmt::format("trace depth 8 8 12 shadow {}", mode)};
      scene.lambert("card", 1)
          .material("gel", std::string(kGel) + ", \"refr_color\" .9 .8 .7" + kAbsorbing)
          .square("card", Vec3(0), 5, kUp)
          .box("gel", Vec3(-5, -5, 1), Vec3(5, 5, 1 + thick))
          .light("sun",
                 "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
      const float d = std::string_view(mode) == "segments" ? thick : 0;
      expect_exact(fmt::format("shadow {} of {} glass", mode, thick),
                   Probe(scene).onto(Vec3(0), kUp, 40, 64),
                   Rgb(.81f * std::pow(.5f, d), .64f * std::pow(.25f, d), .49f * std::pow(.8f, d)));
    }
}

// acceptance: T8
TEST(Glass, SkyThroughASlabIsTheSameByEitherEstimator) {
  // A card under an endless slab of thickness 1 that absorbs to one half: 2 int .5^(1/u) u du.
  // The slab ends at 200, which hides nothing of weight.
  double in_segments = 0;
  constexpr int kSteps = 100000;
  for (int i = 0; i < kSteps; ++i) {
    const double u = (i + .5) / kSteps;
    in_segments += 2 * std::pow(.5, 1 / u) * u / kSteps;
  }
  for (const char* mode : {"on", "segments"})
    for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
      SceneText scene{fmt::format("trace depth 8 8 12 shadow {}", mode)};
      scene.uniform_sky(1)
          .lambert("card", 1)
          .material("gel", std::string(kGel) +
                               ", \"refr_falloff_on\" on, \"refr_falloff_dist\" 1, "
                               "\"refr_falloff_color_on\" on, \"refr_falloff_color\" .5 .5 .5")
          .square("card", Vec3(0), .5f, kUp)
          .box("gel", Vec3(-200, -200, 1), Vec3(200, 200, 2));
      const bool segments = std::string_view(mode) == "segments";
      expect_exact(
          fmt::format("sky through a slab, shadow {}, estimator {}", mode, static_cast<int>(e)),
          Probe(scene).estimator(e).onto(Vec3(0), kUp, 10, 65536),
          segments ? static_cast<float>(in_segments) : 1);
    }
}

/// A dark card under a solid pane, so that light between both does not count.
SceneText card_below_glass(const std::string& options, const std::string& glass) {
  SceneText scene{"trace depth 8 8 12 " + options};
  scene.lambert("card", .004f)
      .square("card", Vec3(0), 5, kUp)
      .material("glass", glass)
      .box("glass", Vec3(-200, -200, 1), Vec3(200, 200, 1.1f));
  return scene;
}

// acceptance: T8
TEST(Glass, TheSunPassesASolidPaneAtEveryAngle) {
  // Unbent rays meet both faces at the angle outside: beyond 41.8 degrees, too, none of them is
  // reflected totally.
  for (const char* options : {"shadow on", "shadow segments", "shadow segments caustic on"})
    for (const char* glass : {kGlass,
                              "\"reflectivity\" 1, \"transparency\" 1, "
                              "\"diffuse_weight\" 0, \"refr_ior\" 1.5, "
                              "\"brdf_fresnel\" on, \"do_refractive_caustics\" off"})
      for (const double degrees : {0.0, 30.0, 50.0, 70.0}) {
        const double cosine = std::cos(degrees * kRadians), sine = std::sin(degrees * kRadians);
        SceneText scene = card_below_glass(options, glass);
        scene.light("sun", fmt::format("\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) "
                                       "direction {} 0 {}",
                                       sine, -cosine));
        const double through = 1 - fresnel(degrees, 1.5);
        const double exact = .004 * cosine * through * through;
        // The card and the pane reflect .03 % to and fro.
        EXPECT_NEAR(Probe(scene).onto(Vec3(0), kUp, 40, 1024).mean.x / exact, 1, 1e-3)
            << degrees << " degrees, " << options;
      }
}

}  // namespace glass_test
}  // namespace oriel::testing
