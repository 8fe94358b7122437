// SPDX-License-Identifier: Apache-2.0
// Mirrors, metals, highlights of visible and invisible lights, and cut-outs.
#include "support/probe.h"

namespace oriel::testing {
namespace reflection_test {

const char* const kMirror =
    "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, \"refl_depth\" 0";

std::string metal(float gloss, const std::string& more = {}) {
  return fmt::format(
      "\"diffuse\" 1 1 1, \"refl_is_metal\" on, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
      "\"refl_gloss\" {}{}{}",
      gloss, more.empty() ? "" : ", ", more);
}

/// From above onto the origin at `degrees` from the vertical.
Measured falling(const Probe& probe, float degrees, int samples) {
  const float a = degrees * kPi / 180;
  const Vec3 d(std::sin(a), 0, -std::cos(a));
  return probe.ray(d * -.5f, d, samples);
}

// acceptance: R1
TEST(Mirror, ShowsTheFlippedSceneWithOneRayForEachMirrorMet) {
  const auto scene = [](bool flipped) {
    SceneText s;
    s.statement("shader \"place\" \"test_place\" ( \"scale\" 1 1 0 )")
        .material("target",
                  "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"place\"")
        .material("mirror", kMirror)
        .uniform_sky(.25f);
    if (!flipped) s.square("mirror", Vec3(0), 5, kUp);
    const float z = flipped ? -2.0f : 2.0f;
    s.square("target", Vec3(2, 2, z), 1, Vec3(0, 0, -z));
    s.sphere("target", Vec3(3, 1, z / 2), .3f, 24);
    // Seen obliquely from above through a shifted window; under the mirror, the flipped picture.
    s.camera("focal 1 aperture 1 aspect 1 resolution 24 24",
             "1 0 0 0  0 .7071068 -.7071068 0  0 .7071068 .7071068 0  -1.7 0 -1.4142136 1");
    return s;
  };
  const Probe mirrored(scene(false)), flipped(scene(true));
  int lit = 0;
  for (int y = 0; y < 24; y += 3)
    for (int x = 0; x < 24; x += 3) {
      // Pixel centres only: edges are decided by rounding.
      const Vec2 raster(static_cast<float>(x) + .5f, static_cast<float>(y) + .5f);
      const Camera::Ray eye = mirrored.world().camera.ray(raster);
      const Measured a = mirrored.ray(eye.origin, eye.direction, 64);
      const Measured b = flipped.ray(eye.origin, eye.direction, 64);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(a.mean[k], b.mean[k], 1e-4f) << x << ' ' << y;
      EXPECT_EQ(a.counts.reflect, 64u);
      EXPECT_EQ(a.counts.gather + a.counts.refract + a.counts.shadow, 0u);
      lit += b.mean.x != .25f;
    }
  EXPECT_GT(lit, 5);
}

// acceptance: R1, R2
TEST(Mirror, PerfectGlossOrNoSamplesIsOneMirrorRay) {
  const std::pair<const char*, bool> cases[] = {
      {"\"refl_gloss\" 1, \"refl_gloss_samples\" 64", true},
      {"\"refl_gloss\" .3, \"refl_gloss_samples\" 0", true},
      {"\"refl_gloss\" .3, \"refl_gloss_samples\" 8", false}};
  for (const auto& [parameters, mirror] : cases) {
    SceneText scene;
    scene.material("m", std::string(kMirror) + ", " + parameters)
        .plate("m")
        .statement("shader \"place\" \"test_place\" ()")
        .material("target",
                  "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"place\"")
        .square("target", Vec3(0, 0, 3), 1000, -kUp);
    const Measured m = falling(Probe(scene), 45, 4096);
    if (mirror) {
      EXPECT_EQ(m.counts.reflect, 4096u);
      EXPECT_NEAR(m.mean.x, 3, 1e-3f) << parameters;
      EXPECT_EQ(m.error.y, 0);
    } else {
      EXPECT_GT(m.error.x, .01f);
    }
  }
}

// The highlight of a mirror made by refl_gloss_samples 0 still follows the gloss.
// acceptance: R2
TEST(Mirror, HighlightFollowsGlossWithoutSamples) {
  for (const float gloss : {.2f, .5f}) {
    const auto highlight = [&](int samples) {
      SceneText scene;
      scene.material("m", metal(gloss, fmt::format("\"refl_gloss_samples\" {}", samples)))
          .plate("m")
          .light("lamp", "\"mib_light_point\" ( \"color\" 1 1 1 ) origin .05 0 1");
      return falling(Probe(scene), 3, 64);
    };
    EXPECT_GT(highlight(8).mean.x, .01f);
    expect_same(fmt::format("highlight, gloss {}", gloss), highlight(0), highlight(8));
  }
}

// acceptance: R4
TEST(Metal, DiffuseColoursReflectionsAndReflectivityBlends) {
  const auto measure = [](bool is_metal, float weight, bool lit_by_sun) {
    SceneText scene;
    scene
        .material("m", fmt::format("\"diffuse\" 1 .5 .25, \"refl_color\" .3 .6 .9, "
                                   "\"refl_is_metal\" {}, \"reflectivity\" {}, "
                                   "\"brdf_0_degree_refl\" 1",
                                   is_metal ? "on" : "off", weight))
        .plate("m");
    // The mirror does not show a sun without extent, diffuse light of a sky is switched off.
    if (lit_by_sun)
      scene.light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction 0 0 -1");
    else
      scene.uniform_sky(1);
    return falling(Probe(scene).direct_only(), 30, 4096);
  };
  const Rgb diffuse(1, .5f, .25f), tint(.3f, .6f, .9f);
  for (const float weight : {.25f, .5f, 1.0f}) {
    expect_exact(fmt::format("plastic of reflectivity {} mirrors", weight),
                 measure(false, weight, false), tint * weight);
    expect_exact(fmt::format("metal of reflectivity {} mirrors", weight),
                 measure(true, weight, false), diffuse * tint * weight);
    expect_exact(fmt::format("plastic of reflectivity {}, diffuse", weight),
                 measure(false, weight, true), diffuse * (Rgb(1) - tint * weight));
  }
}

/// A glossy plate under a square light that it mirrors.
Measured plate_under_lamp(const std::string& material, bool visible,
                          Estimator estimator = Estimator::Mis, const std::string& pane = {}) {
  SceneText scene;
  scene.material("m", material)
      .plate("m")
      .light("lamp",
             "\"physical_light\" ( \"color\" 40 40 40 ) origin 1 0 1 direction 0 0 -1 "
             "rectangle 1 0 0 0 1 0 3 3",
             visible ? "visible on" : "");
  if (!pane.empty()) scene.material("pane", pane).square("pane", Vec3(0, 0, .7f), 20, kUp);
  Probe probe(scene);
  return falling(probe.estimator(estimator), 40, 65536);
}

// acceptance: R9, R10
TEST(Highlight, VisibleLightsAreReflectedInvisibleOnesHighlightedNeverBoth) {
  for (const float gloss : {.1f, .3f, .6f}) {
    const Measured seen = plate_under_lamp(metal(gloss), true);
    const Measured hidden = plate_under_lamp(metal(gloss), false);
    const Measured only = plate_under_lamp(metal(gloss, "\"refl_hl_only\" on"), false);
    const Measured rays = plate_under_lamp(metal(gloss), true, Estimator::BsdfOnly);
    const std::string name = fmt::format(" gloss {}", gloss);
    expect_same("invisible against visible light," + name, hidden, seen, .01f);
    expect_same("highlights only against reflection," + name, only, seen, .01f);
    expect_same("highlights only against rays only," + name, only, rays, .01f);
    EXPECT_NEAR(hidden.mean.x / seen.mean.x, 1, .01f);
    EXPECT_GT(seen.mean.x, .1f);
  }
}

// acceptance: R2, R10
TEST(Highlight, MirrorRaysOfABlurredSurfaceShowAVisibleLightOnce) {
  const std::string samples_0 = "\"refl_gloss_samples\" 0";
  const Measured mirror = plate_under_lamp(metal(1), true);
  expect_same("samples 0 mirrors a visible light", plate_under_lamp(metal(.3f, samples_0), true),
              mirror, .01f);
  const Measured both =
      plate_under_lamp(metal(.3f, samples_0 + ", \"no_visible_area_hl\" off"), true);
  EXPECT_GT(both.mean.x, mirror.mean.x * 1.01f);
  expect_same("samples 0 highlights an invisible light as the gloss says",
              plate_under_lamp(metal(.3f, samples_0), false), plate_under_lamp(metal(.3f), false),
              .01f);
}

// acceptance: R9
TEST(Highlight, BalanceScalesHighlightsOnlyAndBothCanBeEnabled) {
  const Measured plain = plate_under_lamp(metal(.3f), true);
  const auto scaled = [&](float by) {
    Measured m = plain;
    m.mean *= by;
    m.error *= by;
    return m;
  };
  const std::string half = "\"hl_vs_refl_balance\" .5";
  expect_same("half highlight of an invisible light", plate_under_lamp(metal(.3f, half), false),
              scaled(.5f), .01f);
  expect_same("reflection of a visible light, whatever the balance",
              plate_under_lamp(metal(.3f, half), true), scaled(1), .01f);
  expect_same("highlight and reflection of a visible light",
              plate_under_lamp(metal(.3f, half + ", \"no_visible_area_hl\" off"), true),
              scaled(1.5f), .01f);
}

TEST(Highlight, LightBehindThinGlassIsCountedOnce) {
  const std::string pane =
      "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, \"refr_color\" .5 .5 .5, "
      "\"thin_walled\" on";
  for (const bool visible : {false, true})
    for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
      // The view itself passes below the pane.
      Measured open = plate_under_lamp(metal(.3f), visible);
      open.mean *= .5f;
      open.error *= .5f;
      expect_same(fmt::format("plate under lamp and half pane, estimator {}, visible {}",
                              static_cast<int>(e), visible),
                  plate_under_lamp(metal(.3f), visible, e, pane), open, .015f);
    }
}

TEST(Highlight, SkyBehindThinGlassIsCountedOnce) {
  const auto plate = [](bool pane, Estimator e) {
    SceneText scene;
    scene.uniform_sky(1)
        .material("m", metal(.2f))
        .material("pane",
                  "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, "
                  "\"refr_color\" .5 .5 .5, \"thin_walled\" on")
        .square("m", Vec3(0), 1, kUp);
    if (pane) scene.square("pane", Vec3(0, 0, 1), 3000, kUp);
    return falling(Probe(scene).estimator(e), 30, 65536);
  };
  Measured half = plate(false, Estimator::Mis);
  half.mean *= .5f;
  half.error *= .5f;
  EXPECT_NEAR(half.mean.x, .5f, .0025f);
  for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly})
    expect_same(fmt::format("white metal under a half pane, estimator {}", static_cast<int>(e)),
                plate(true, e), half);
}

// acceptance: B3
TEST(CutOut, PicturesOfOpacityAreSharpAtEachPoint) {
  // Opaque on the left, a hole on the right; the rest of the material is filtered as always.
  SceneText scene;
  scene
      .statement(
          "color texture \"two\" [2 1 1] 'ff00'\n"
          "shader \"place\" \"mib_texture_vector\" ( \"select\" 0 )\n"
          "shader \"tiled\" \"mib_texture_remap\" ( \"input\" = \"place\", \"torus_x\" on )\n"
          "shader \"plain_look\" \"mib_texture_lookup\" ( \"tex\" \"two\", \"coord\" = \"place\" "
          ")\n"
          "shader \"moved_look\" \"mib_texture_lookup\" ( \"tex\" \"two\", \"coord\" = \"tiled\" "
          ")\n"
          "shader \"input\" \"mia_material_x\" ( \"reflectivity\" 0 )\n")
      .statement(
          "material \"chain\" \"mib_opacity\" ( \"input\" = \"input\", \"opacity\" = "
          "\"moved_look\" ) "
          "end material");
  for (const char* source : {"plain", "moved"})
    scene.material(source, fmt::format("\"reflectivity\" 0, \"cutout_opacity\" = \"{0}_look\", "
                                       "\"diffuse\" = \"{0}_look\"",
                                       source));
  for (const char* name : {"chain", "plain", "moved"}) scene.plate(name);
  const Probe probe(scene);
  int seen = 0;
  for (const Material& m : probe.world().materials) {
    if (m.name != "chain" && m.name != "plain" && m.name != "moved") continue;
    for (const float width : {0.0f, .1f, 1.0f, 10.0f})
      for (const float u : {.25f, .75f}) {
        ShadingPoint point;
        point.world = &probe.world();
        point.texture_spaces = 1;
        point.tex[0] = Vec3(u, .5f, 0);
        point.dpdu = Vec3(1, 0, 0);
        point.dpdv = Vec3(0, 1, 0);
        point.dpdx = Vec3(width, 0, 0);
        point.dpdy = Vec3(0, width, 0);
        Closure closure;
        shade(m, point, closure);
        EXPECT_FLOAT_EQ(closure.opacity, u < .5f ? 1 : 0) << m.name << ' ' << width;
        if (m.name == "plain" && u < .5f && width == 10) {
          EXPECT_NEAR(closure.albedo.x, .5f, .01f);
        }
        ++seen;
      }
  }
  EXPECT_EQ(seen, 24);
}

TEST(CutOut, HolesAreOpenForEveryKindOfRay) {
  // A mirror with cut-out opacity .4 in front of an emitter of radiance 2.
  const std::string fence = std::string(kMirror) + ", \"cutout_opacity\" .4";
  const auto behind_fence = [&](SceneText scene) {
    scene.material("fence", fence).emitter("glow", 2);
    return scene;
  };
  const auto fence_and_glow = [&](SceneText scene) {
    scene.square("fence", Vec3(0, 0, 2), 30, -kUp).square("glow", Vec3(0, 0, 3), 30, -kUp);
    return scene;
  };
  const Vec3 up = kUp;
  // The camera sees .6 of the emitter, and nothing in the mirror.
  expect_exact("cut-out seen",
               Probe(fence_and_glow(behind_fence(SceneText()))).ray(Vec3(0), up, 16384), 1.2f);
  SceneText mirror = behind_fence(SceneText());
  mirror.material("mirror", kMirror).square("mirror", Vec3(0), 5, kUp);
  // Interreflections of mirror and fence: .6 (1 + .4 + .4^2 ...) = 1 of the emitter.
  mirror = fence_and_glow(mirror);
  const Measured m = Probe(mirror).ray(Vec3(0, 0, 1), -up, 1 << 17);
  EXPECT_NEAR(m.mean.x, 2 * (1 - std::pow(.4f, 4)), .06f);  // trace depth 8
  SceneText glass = behind_fence(SceneText());
  glass
      .material("gel",
                "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, \"refr_ior\" 1")
      .box("gel", Vec3(-1, -1, .2f), Vec3(1, 1, .4f));
  expect_exact("cut-out through glass", Probe(fence_and_glow(glass)).ray(Vec3(0), up, 16384), 1.2f);
  SceneText black_fence;
  black_fence.lambert("fence", 0, "\"cutout_opacity\" .4").emitter("glow", 2).lambert("card", 1);
  SceneText gather = black_fence;
  gather.square("card", Vec3(0), .01f, kUp)
      .square("fence", Vec3(0, 0, 2), 3000, -kUp)
      .square("glow", Vec3(0, 0, 3), 4000, -kUp);
  expect_exact("cut-out for gather rays", Probe(gather).onto(Vec3(0), kUp, 10, 65536, .05f), 1.2f);
  SceneText shadow = black_fence;
  shadow.square("card", Vec3(0), 5, kUp)
      .square("fence", Vec3(0, 0, 2), 30, -kUp)
      .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
  expect_exact("cut-out for shadow rays", Probe(shadow).onto(Vec3(0), kUp, 10, 16384), .6f);
  // Transparency of the same amount keeps the reflection that a hole takes away.
  SceneText see_through;
  see_through.emitter("glow", 2).uniform_sky(1);
  see_through.material("fence", std::string(kMirror) + ", \"transparency\" .6")
      .square("fence", Vec3(0, 0, 2), 30, -kUp)
      .square("glow", Vec3(0, 0, 3), 30, -kUp);
  expect_exact("mirror with transparency", Probe(see_through).ray(Vec3(0), up, 64), 1);
}

// acceptance: B4
TEST(AdditionalColor, AnyShaderIsAddedAsItIs) {
  SceneText scene;
  scene.uniform_sky(1)
      .statement("shader \"place\" \"test_place\" ( \"scale\" 3 0 0 )")
      .material("m", "\"reflectivity\" 0, \"diffuse\" .5 .5 .5, \"additional_color\" = \"place\"")
      .plate("m");
  for (const float x : {0.0f, .5f, 1.5f})
    expect_exact(fmt::format("added colour at {}", x),
                 Probe(scene).onto(Vec3(x, 0, 0), kUp, 0, 4096), Rgb(.5f + 3 * x, .5f, .5f));
}

}  // namespace reflection_test
}  // namespace oriel::testing
