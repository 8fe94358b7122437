// SPDX-License-Identifier: Apache-2.0
// Nested media, translucent solids, and alpha of backgrounds.
#include <numbers>

#include "support/probe.h"

namespace oriel::testing {
namespace media_test {

constexpr double kRadians = std::numbers::pi / 180;

/// Bare media: no limits but those of the scene.
const std::string kFree =
    "\"refl_depth\" 0, \"refr_depth\" 0, \"refl_cutoff\" 0, \"refr_cutoff\" 0";
const std::string kSheet =
    "\"diffuse_weight\" 0, \"reflectivity\" 0, \"thin_walled\" on, " + kFree + ", ";

std::string interface(double index, const std::string& more = {}) {
  return fmt::format(
      "\"diffuse_weight\" 0, \"reflectivity\" 1, \"transparency\" 1, \"brdf_fresnel\" on, "
      "\"refr_ior\" {}, {}{}",
      index, kFree, more);
}

std::string absorbing(const Rgb& colour) {
  return fmt::format(
      ", \"refr_falloff_on\" on, \"refr_falloff_dist\" 1, \"refr_falloff_color_on\" on, "
      "\"refr_falloff_color\" {}",
      text_of(colour));
}

/// Unpolarised Fresnel reflectance between two media from the sine over the index, in double.
double fresnel(double sine_in_air, double n1, double n2) {
  const double s1 = sine_in_air / n1, s2 = sine_in_air / n2;
  const double c1 = std::sqrt(1 - s1 * s1), c2 = std::sqrt(1 - s2 * s2);
  const double rs = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2);
  const double rp = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
  return (rs * rs + rp * rp) / 2;
}

/// A tank of glass 1.5 with a bottom 1 thick, water 1.33 of depth 1.5 in it, as three surfaces:
/// air-glass, glass-water (1.33 / 1.5, water inside), water-air.
SceneText tank(const Rgb& glass, const Rgb& water, float half = 8) {
  const auto plane = [half](float z, bool up) {
    std::vector<Vec3> p = {Vec3(-half, -half, z), Vec3(half, -half, z), Vec3(half, half, z),
                           Vec3(-half, half, z)};
    if (!up) std::swap(p[1], p[3]);
    return p;
  };
  SceneText scene("trace depth 8 8 12 shadow segments");
  scene.material("glass", interface(1.5, absorbing(glass)))
      .material("wet", interface(1.33 / 1.5, absorbing(water)))
      .material("water", interface(1.33, absorbing(water)))
      .polygon("glass", plane(0, false))
      .polygon("wet", plane(1, false))
      .polygon("water", plane(2.5f, true));
  return scene;
}

// acceptance: T11
TEST(NestedMedia, PathThroughGlassAndWaterIsThatOfSnell) {
  const Rgb water(.8f, .5f, .9f);
  for (const bool from_above : {false, true})
    for (const double degrees : {0.001, 20.0, 45.0, 55.0}) {
      SceneText scene = tank(Rgb(1), water);
      const float target = from_above ? -.5f : 3;
      scene.statement("shader \"place\" \"test_place\" ()")
          .material("target",
                    "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"place\"")
          .square("target", Vec3(0, 0, target), 100, from_above ? kUp : -kUp);
      const double sine = std::sin(degrees * kRadians);
      const double s15 = sine / 1.5, s133 = sine / 1.33;
      const double c15 = std::sqrt(1 - s15 * s15), c133 = std::sqrt(1 - s133 * s133);
      const double x = s15 / c15 + 1.5 * s133 / c133 + .5 * std::tan(degrees * kRadians);
      const float start = from_above ? 2.5f : 0;
      const Vec3 d(static_cast<float>(sine), 0,
                   static_cast<float>((from_above ? -1 : 1) * std::cos(degrees * kRadians)));
      const Measured m =
          Probe(scene).ray(Vec3(0, 0, start) - d * .5f, d, degrees < 60 ? 1 << 15 : 1 << 16);
      const std::string name =
          fmt::format("tank seen from {} at {} deg", from_above ? "above" : "below", degrees);
      const double seen = target * m.mean.x / m.mean.z * std::pow(water.z / water.x, 1.5 / c133);
      EXPECT_NEAR(seen, x, 1e-4 * std::max(x, .1)) << name;
      figure("place on the target, " + name, x, seen, 0);
      // The light not reflected at the three surfaces, minus the absorption of the water.
      const double passed = (1 - fresnel(sine, 1, 1.5)) * (1 - fresnel(sine, 1.5, 1.33)) *
                            (1 - fresnel(sine, 1.33, 1));
      const double exact = passed * std::pow(water.z, 1.5 / c133) * target;
      EXPECT_NEAR(m.mean.z, exact, 4 * m.error.z + 1e-4 * std::abs(exact)) << name;
      EXPECT_LT(m.error.z, .01 * std::abs(exact)) << name;
      figure("brightness, " + name, exact, m.mean.z, m.error.z);
    }
}

// acceptance: T11
TEST(NestedMedia, WaterReflectsTotallyAtAnglesThatGlassTransmits) {
  // From water to air: critical angle 48.75 degrees.
  for (const double degrees : {30.0, 40.0, 49.5, 60.0}) {
    SceneText scene = tank(Rgb(1), Rgb(1), 100);
    scene.emitter("glow", 1).square("glow", Vec3(0, 0, 3), 200, -kUp);
    const float a = static_cast<float>(degrees * kRadians);
    const Vec3 d(std::sin(a), 0, std::cos(a));
    const Measured m = Probe(scene).ray(Vec3(0, 0, 1.5f), d, 1 << 14);
    if (degrees > 48.76) {
      // The bottom's lower face reflects it totally as well: it is caught.
      EXPECT_EQ(m.mean.x, 0) << degrees;
    } else {
      const double exact = 1 - fresnel(1.33 * std::sin(degrees * kRadians), 1.33, 1);
      expect_exact(fmt::format("out of the water at {} deg", degrees), m, static_cast<float>(exact),
                   .02f);
    }
  }
}

// acceptance: T7
TEST(Prism, TurnsTheViewByTotalReflectionWhetherWeakOnesAreSkippedOrNot) {
  // Upward into a leg, totally off the hypotenuse at 45 degrees, out of the other leg along x.
  for (const bool skip : {true, false}) {
    SceneText scene("trace depth 40 40 80 shadow on");
    const auto face = [&](const Vec3& a, const Vec3& b) {  // outside is right of a -> b, from +y
      scene.polygon("glass",
                    {a + Vec3(0, 5, 0), b + Vec3(0, 5, 0), b - Vec3(0, 5, 0), a - Vec3(0, 5, 0)});
    };
    scene
        .material("glass",
                  interface(1.5, skip ? ", \"skip_inside_refl\" on" : ", \"skip_inside_refl\" off"))
        .statement("shader \"place\" \"test_place\" ()")
        .material("target",
                  "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"place\"")
        .square("target", Vec3(4, 0, 0), 50, Vec3(-1, 0, 0));
    const Vec3 corners[] = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 0, 2)};
    for (int i = 0; i < 3; ++i) face(corners[i], corners[(i + 1) % 3]);
    for (const float x : {.5f, 1.0f, 1.5f}) {
      const Measured m = Probe(scene).ray(Vec3(x, 0, -.5f), kUp, 1 << 15);
      const std::string name = fmt::format("prism at {}, skip {}", x, skip);
      EXPECT_NEAR(4 * m.mean.z / m.mean.x, x, 1e-4f) << name;
      // Both legs reflect .04; there and back again between them is what skipping leaves out.
      const float exact = 4 * .96f * .96f / (skip ? 1 : 1 - .04f * .04f);
      EXPECT_NEAR(m.mean.x, exact, 4 * m.error.x + 1e-4f) << name;
      EXPECT_LT(m.error.x, .01f * exact) << name;
      if (skip)
        EXPECT_NEAR(m.each(m.counts.reflect), 1, .01) << name;
      else
        EXPECT_GT(m.each(m.counts.reflect), 1.03) << name;
      figure(name, exact, m.mean.x, m.error.x);
    }
  }
}

std::string wax(float translucent) {
  return fmt::format(
      "\"reflectivity\" 0, \"transparency\" 1, \"refr_ior\" 1, \"refr_translucency\" on, "
      "\"refr_trans_weight\" {}, \"refr_trans_color\" 1 .8 .6, {}",
      translucent, kFree);
}

// acceptance: T10
TEST(Translucency, SolidTransmitsLightFromBackToFront) {
  // A wide slab, lit by a sun behind it. Of the transparency 1, `a` passes straight, b is
  // translucent: the sun through the back onto the front's inside, and the glow of the back.
  for (const float b : {.25f, .6f, 1.0f}) {
    const float a = 1 - b;
    SceneText scene("trace depth 8 8 12 shadow segments");
    scene.material("wax", wax(b))
        .box("wax", Vec3(-200, -200, 0), Vec3(200, 200, .1f))
        .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
    const Measured m = Probe(scene).ray(Vec3(0, 0, -.5f), Vec3(.3f, 0, 1), 1 << 15);
    const Rgb back = Rgb(1, .8f, .6f) * b;
    expect_exact(fmt::format("slab of wax, weight {}", b), m, back * (2 * a) + back * back, .01f);
  }
}

// acceptance: T10
TEST(Translucency, SolidUnderASkyBehindIt) {
  // As before with a uniform sky: one of four paths each, and all contribute 1.
  for (const float b : {.25f, .6f, 1.0f}) {
    const float a = 1 - b;
    SceneText scene("trace depth 8 8 12 shadow segments");
    scene.material("wax", wax(b))
        .half_sky(1, kUp)
        .box("wax", Vec3(-200, -200, 0), Vec3(200, 200, .1f));
    const Measured m = Probe(scene).ray(Vec3(0, 0, -.5f), Vec3(.3f, 0, 1), 1 << 15);
    const Rgb back = Rgb(1, .8f, .6f) * b;
    expect_exact(fmt::format("slab of wax under a sky, weight {}", b), m,
                 (Rgb(a) + back) * (Rgb(a) + back), .01f);
  }
}

/// Alpha of a ray through things of a material into a background of that alpha.
float alpha_through(const std::string& material, bool solid, float behind, float paths = 1e6f,
                    bool blocked = false, float degrees = 0) {
  SceneText scene("trace depth 8 8 12 shadow segments");
  scene.material("m", material)
      .lambert("card", .5f)
      .environment(
          fmt::format("\"test_sky\" ( \"above\" 1 1 1 {0}, \"below\" 1 1 1 {0} )", behind));
  if (solid)
    scene.box("m", Vec3(-5, -5, -1), Vec3(5, 5, 0));
  else
    scene.plate("m");
  if (blocked) scene.square("card", Vec3(0, 0, -3), 50, kUp);
  return Probe(scene)
      .direct_only()
      .paths_of_pixel(paths)
      .onto(Vec3(0), kUp, degrees, 1 << 11)
      .alpha;
}

// acceptance: T12
TEST(PropagateAlpha, ShowsTheAlphaBehindTransparencyOnlyWhenOn) {
  const std::string on = ", \"propagate_alpha\" on", off = ", \"propagate_alpha\" off";
  struct Case {
    const char* name;
    std::string material;
    bool solid;
    float passes;  ///< what the background's alpha is scaled by; the rest is opaque
    float tolerance;
  };
  const std::string solid = "\"diffuse_weight\" 0, \"reflectivity\" 0, \"refr_ior\" 1.5, " + kFree;
  const Case cases[] = {
      {"clear sheet", kSheet + "\"transparency\" 1", false, 1, 1e-4f},
      {"rough sheet", kSheet + "\"transparency\" 1, \"refr_gloss\" .5", false, 1, .002f},
      {"clear block", solid + ", \"transparency\" 1", true, 1, 1e-4f},
      {"rough block", solid + ", \"transparency\" 1, \"refr_gloss\" .5", true, 1, .01f},
      {"grey sheet", kSheet + "\"transparency\" 1, \"refr_color\" .5 .5 .5", false, .5f, 1e-4f},
      {"half diffuse sheet",
       "\"diffuse\" 1 1 1, \"reflectivity\" 0, \"transparency\" .5, \"thin_walled\" on", false, .5f,
       .01f},
      {"half mirror",
       "\"diffuse_weight\" 0, \"reflectivity\" .5, \"brdf_0_degree_refl\" 1, "
       "\"transparency\" 1, \"thin_walled\" on",
       false, .5f, .02f},
      {"opaque", "\"reflectivity\" 0", false, 0, 1e-6f},
      {"mirror", "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1", false, 0,
       1e-6f}};
  for (const Case& c : cases)
    for (const float behind : {0.0f, .25f, 1.0f})
      for (const float paths : {1e6f, 1.0f}) {
        const std::string name = fmt::format("{} over alpha {}", c.name, behind);
        const float exact = 1 - c.passes * (1 - behind);
        const float alpha = alpha_through(c.material + on, c.solid, behind, paths);
        EXPECT_NEAR(alpha, exact, c.tolerance) << name;
        if (behind == 0 && paths > 1) figure("alpha, " + name, exact, alpha, 0);
        EXPECT_EQ(alpha_through(c.material + off, c.solid, behind, paths), 1) << name;
        // In front of something opaque there is no background to see.
        EXPECT_NEAR(alpha_through(c.material + on, c.solid, behind, paths, true), 1, c.tolerance)
            << name;
      }
}

// acceptance: T12
TEST(PropagateAlpha, AllSheetsMustPropagateIt) {
  const auto alpha = [](const char* first, const char* second) {
    SceneText scene("trace depth 8 8 12 shadow segments");
    scene.material("a", kSheet + "\"transparency\" 1, \"propagate_alpha\" " + first)
        .material("b", kSheet + "\"transparency\" 1, \"propagate_alpha\" " + second)
        .square("a", Vec3(0), 5, kUp)
        .square("b", Vec3(0, 0, -1), 5, kUp);
    return Probe(scene).onto(Vec3(0), kUp, 0, 64).alpha;
  };
  EXPECT_EQ(alpha("on", "on"), 0);
  EXPECT_EQ(alpha("on", "off"), 1);
  EXPECT_EQ(alpha("off", "on"), 1);
}

// acceptance: T12, B3
TEST(PropagateAlpha, CutOutsAlwaysShowTheBackgroundAlpha) {
  for (const char* propagate : {"on", "off"}) {
    const std::string fence = fmt::format(
        "\"reflectivity\" 0, \"cutout_opacity\" .25, \"propagate_alpha\" {}", propagate);
    EXPECT_NEAR(alpha_through(fence, false, 0), .25f, .01f);
    EXPECT_NEAR(alpha_through(fence, false, .5f), .625f, .01f);
  }
}

// acceptance: T4, T11
TEST(NestedMedia, EachAbsorbsOverItsOwnThickness) {
  const auto gel = [](float per_unit) {
    const float c = std::exp(-per_unit);
    return fmt::format(
        "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, \"refr_ior\" 1, "
        "\"refr_falloff_on\" on, \"refr_falloff_dist\" 1, \"refr_falloff_color_on\" on, "
        "\"refr_falloff_color\" {0} {0} {0}",
        c);
  };
  // A layer of 1 below one of 1.5; the surface between them belongs to the upper one.
  const auto add_layers = [&](SceneText& scene) {
    scene.material("lower", gel(.5f))
        .material("upper", gel(.8f))
        .square("lower", Vec3(0), 50, Vec3(0, 0, -1))
        .square("upper", Vec3(0, 0, 1), 50, Vec3(0, 0, -1))
        .square("upper", Vec3(0, 0, 2.5f), 50, Vec3(0, 0, 1));
  };
  SceneText scene;
  add_layers(scene.uniform_sky(1));
  const Probe probe(scene);
  const float both = std::exp(-.5f - .8f * 1.5f);
  expect_exact("two layers from above", probe.ray(Vec3(0, 0, 5), Vec3(0, 0, -1), 64), both);
  expect_exact("two layers from below", probe.ray(Vec3(0, 0, -5), Vec3(0, 0, 1), 64), both);

  // For shadow rays: a light above, the floor below.
  const auto floor_under = [&](bool layers) {
    SceneText lit;
    lit.lambert("floor", 1)
        .square("floor", Vec3(0, 0, -1), .5f, Vec3(0, 0, 1))
        .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
    if (layers) add_layers(lit);
    return std::move(Probe(lit).direct_only()).ray(Vec3(0, 0, -.5f), Vec3(0, 0, -1), 16).mean.x;
  };
  EXPECT_NEAR(floor_under(true) / floor_under(false), both, 1e-4f);
}

}  // namespace media_test
}  // namespace oriel::testing
