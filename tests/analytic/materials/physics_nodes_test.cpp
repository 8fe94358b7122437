// SPDX-License-Identifier: Apache-2.0
// Physics library: materials, glossy and occlusion nodes, lens and volume shaders.
#include "runtime/color_mapping.h"
#include "support/picture.h"
#include "support/probe.h"

namespace oriel::testing {
namespace physics_nodes_test {

SceneText plate(const std::string& call) {
  SceneText scene;
  scene.statement("shader \"l\" \"mib_illum_lambert\" ( \"diffuse\" .5 .5 .5 )")
      .statement("material \"m\" " + call + " end material")
      .plate("m");
  return scene;
}
Measured seen(const SceneText& scene, float degrees = 0, int samples = 16384) {
  return Probe(scene).onto(Vec3(0), kUp, degrees, samples);
}

/// Tables of albedos of glossy lobes are within a thousandth.
void expect_exact_but_for_tables(const std::string& name, const Measured& m, const Rgb& exact) {
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(m.mean[k], exact[k], 1e-3f * exact[k] + 4 * m.error[k]) << name << " channel " << k;
}

TEST(Physics, DgsAddsItsThreeParts) {
  // In a white room each part contributes its colour.
  for (const char* shader : {"dgs_material", "path_material"}) {
    const std::string call = fmt::format(
        "\"{}\" ( \"diffuse\" .1 .2 .3, \"glossy\" .3 .2 .1, \"specular\" .2 .2 .2, \"shiny\" 20 )",
        shader);
    expect_exact_but_for_tables(call, seen(plate(call).uniform_sky(1)), Rgb(.6f, .6f, .6f));
  }
}

TEST(Physics, DgsSharesItsPartsWithTheTransmittedLight) {
  SceneText scene = plate(
      "\"dgs_material\" ( \"diffuse\" .2 .2 .2, \"glossy\" .3 .3 .3, \"specular\" .5 .5 .5, "
      "\"shiny\" 50, \"transp\" .25 )");
  scene.environment("\"test_sky\" ( \"above\" 1 1 1, \"below\" .2 .2 .2 )");
  expect_exact("transp", seen(scene), .75f + .25f * .2f, .01f);
}

TEST(Physics, ShininessNarrowsTheReflection) {
  const auto beside = [](const char* shiny) {
    SceneText scene = plate(fmt::format("\"dgs_material\" ( \"glossy\" 1 1 1, {} )", shiny));
    scene.emitter("glow", 1).square("glow", Vec3(0, 0, 2), .3f, -kUp);
    return Probe(scene).onto(Vec3(0), kUp, 25, 16384).mean.x;
  };
  EXPECT_GT(beside("\"shiny\" 5"), 2 * beside("\"shiny\" 100"));
  // Along one axis alone: the surface's u is that of no texture here, so any pair is as good.
  EXPECT_NE(beside("\"shiny_u\" 5, \"shiny_v\" 100"), beside("\"shiny_u\" 5, \"shiny_v\" 5"));
}

TEST(Physics, DielectricIsGlassThatAbsorbsByLength) {
  const float tau = .5f, r = .04f;  // an index of 1.5
  SceneText scene;
  scene
      .statement(
          "material \"m\" \"dielectric_material\" ( \"ior\" 1.5, \"col\" .5 1 1 ) "
          "end material")
      .box("m", Vec3(-20, -20, -1), Vec3(20, 20, 0))
      .uniform_sky(1);
  const Measured m = Probe(scene).onto(Vec3(0), kUp, 0, 65536);
  // Both faces and the interreflections between them.
  const float t = sqr(1 - r) * tau / (1 - sqr(r * tau));
  expect_exact("dielectric", m, Rgb(r + t * (1 + r * tau), 1, 1), .01f);
}

TEST(Physics, DielectricBetweenLiquidsUsesTheIndexRatio) {
  const auto mirror = [](const char* indices) {
    SceneText scene;
    scene
        .statement(fmt::format("material \"m\" \"dielectric_material\" ( \"col\" 1 1 1, {} ) "
                               "end material",
                               indices))
        .plate("m")
        .half_sky(1, kUp);
    return seen(scene);
  };
  expect_exact("same", mirror("\"ior\" 1.33, \"ior_out\" 1.33"), 0.0f);
  expect_exact("ratio", mirror("\"ior\" 3, \"ior_out\" 2"), .04f, .02f);
}

TEST(Physics, TransmatIsInvisible) {
  SceneText scene = plate("\"transmat\" ( )");
  scene.environment("\"test_sky\" ( \"above\" 1 1 1, \"below\" .2 .3 .4 )");
  expect_exact("transmat", seen(scene, 40), Rgb(.2f, .3f, .4f));
}

TEST(GlossyNodes, ReflectionIsBlendedByTheAngle) {
  const auto at = [](float degrees, const char* more) {
    return seen(plate(fmt::format("\"mib_glossy_reflection\" ( \"base_material\" \"l\", "
                                  "\"reflection_color\" 1 1 1, \"reflection_base_weight\" .2, "
                                  "\"reflection_edge_weight\" .8, \"edge_factor\" 3{} )",
                                  more))
                    .uniform_sky(1),
                degrees);
  };
  for (const char* more : {"", ", \"samples\" 0", ", \"u_spread\" .4, \"v_spread\" .4"})
    for (const float degrees : {0.f, 50.f}) {
      const float k = .2f + .6f * std::pow(1 - std::cos(degrees * kPi / 180), 3.0f);
      expect_exact_but_for_tables(more, at(degrees, more), Rgb((1 - k) * .5f + k));
    }
}

TEST(GlossyNodes, RefractionIsBlendedAndTellsTheBack) {
  SceneText scene = plate(
      "\"mib_glossy_refraction\" ( \"top_material\" \"l\", \"back_material\" \"e\", "
      "\"refraction_base_weight\" .4, \"refraction_edge_weight\" .4 )");
  scene.environment("\"test_sky\" ( \"above\" 1 1 1, \"below\" 1 1 1 )");
  scene.statement("shader \"e\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" 3 3 3 )");
  const Probe probe(scene);
  // The table of albedos is within a few thousandths.
  EXPECT_NEAR(probe.onto(Vec3(0), kUp, 0, 16384).mean.x, .6f * .5f + .4f, .002f);
  EXPECT_NEAR(probe.onto(Vec3(0), -kUp, 0, 16384).mean.x, .6f * 3 + .4f, .002f);
}

TEST(OcclusionNodes, HalfAHemisphereIsHalfOpen) {
  // A wall that starts at the point occludes half of the cosine-weighted hemisphere.
  const auto open = [](const std::string& call, float wall) {
    SceneText scene = plate(call);
    scene.lambert("wall", .5f);
    if (wall > 0)
      scene.polygon("wall", {Vec3(wall, -1000, -1), Vec3(wall, 1000, -1), Vec3(wall, 1000, 2000),
                             Vec3(wall, -1000, 2000)});
    return Probe(scene).onto(Vec3(0), kUp, 0, 8192);
  };
  const std::string amb =
      "\"mib_amb_occlusion\" ( \"spread\" 1, \"bright\" 1 .5 1, "
      "\"dark\" 0 0 .5";
  expect_exact("open", open(amb + " )", 0), Rgb(1, .5f, 1));
  expect_exact("half", open(amb + " )", .01f), Rgb(.5f, .25f, .75f), .02f);
  expect_exact("narrow", open("\"mib_amb_occlusion\" ( \"spread\" .1, \"max_distance\" 3 )", 1),
               1.0f);
  expect_exact("near", open(amb + ", \"max_distance\" .5 )", 1), Rgb(1, .5f, 1));
  EXPECT_GT(open(amb + ", \"max_distance\" 2 )", 1).mean.x, open(amb + " )", 1).mean.x);
  expect_exact(
      "fast",
      open("\"mib_fast_occlusion\" ( \"samples\" 16, \"bright\" 1 1 1, \"spread\" 0 )", .01f), .5f,
      .02f);
  expect_exact("off", open("\"mib_fg_occlusion\" ( \"result_when_fg_is_off\" .3 .3 .3 )", .01f),
               .3f);
}

TEST(OcclusionNodes, BentDirectionPointsToTheOpenSide) {
  SceneText scene = plate("\"mib_amb_occlusion\" ( \"spread\" 1, \"output_mode\" 2 )");
  scene.lambert("wall", .5f);
  scene.polygon("wall", {Vec3(.01f, -1000, -1), Vec3(.01f, 1000, -1), Vec3(.01f, 1000, 2000),
                         Vec3(.01f, -1000, 2000)});
  const Rgb c = Probe(scene).onto(Vec3(0), kUp, 0, 8192).mean;
  EXPECT_LT(c.x, .4f);
  EXPECT_NEAR(c.y, .5f, .05f);
  EXPECT_GT(c.z, .7f);
}

TEST(OcclusionNodes, BentNormalLooksUpTheEnvironment) {
  const auto at = [](const char* more) {
    return seen(plate(fmt::format("\"mib_bent_normal_env\" ( \"strength\" .5{} )", more))
                    .environment("\"test_sky\" ( \"above\" 1 1 1, \"below\" .2 .2 .2 )"),
                0, 64);
  };
  expect_exact("up", at(", \"bent_normals\" .5 .5 1 .5"), .25f);
  expect_exact("down", at(", \"bent_normals\" .5 .5 0 1"), .1f);
  expect_exact("occlusion",
               at(", \"bent_normals\" .5 .5 1 .5, \"occlusion_in_alpha\" off, "
                  "\"occlusion\" .5 1 1"),
               Rgb(.25f, .5f, .5f));
}

TEST(VolumeNodes, FogIsFullAtItsDistance) {
  const auto at = [](float distance) {
    SceneText scene;
    scene.emitter("glow", 1)
        .square("glow", Vec3(0, 0, -distance), 50, kUp)
        .camera(
            "focal 1 aperture 1 aspect 1 resolution 32 32 volume \"mib_volume\" ( "
            "\"color\" .2 .4 .6, \"max\" 8 )");
    return Probe(scene).ray(Vec3(0), Vec3(0, 0, -1), 64);
  };
  expect_exact("quarter", at(2), Rgb(.75f) + Rgb(.2f, .4f, .6f) * .25f);
  expect_exact("full", at(20), Rgb(.2f, .4f, .6f));
}

/// A medium in front of an emissive wall, lit by a sun along x.
SceneText airy(const std::string& air, float distance = 4) {
  SceneText scene;
  scene.emitter("glow", 1)
      .square("glow", Vec3(0, 0, -distance), 50, kUp)
      .light("sun", "\"mib_light_infinite\" ( \"color\" 2 2 2 ) direction 1 0 0")
      .camera("focal 1 aperture 1 aspect 1 resolution 32 32 volume \"parti_volume\" ( " + air +
              " )");
  return scene;
}
Measured along_z(const SceneText& scene) {
  return Probe(scene).direct_only().ray(Vec3(0), Vec3(0, 0, -1), 16384);
}

TEST(PartiVolume, ScattersTheExtinctLightOnce) {
  const float kept = std::exp(-.25f * 4);
  expect_exact("dims", along_z(airy("\"extinction\" .25")), kept);
  // At a right angle an even phase sends 1 / 4 pi of the irradiance, which is pi x colour.
  const float even = (1 - kept) * .5f * 2 / 4;
  expect_exact("even", along_z(airy("\"extinction\" .25, \"scatter\" .5 .5 .5")), kept + even);
  const float g = .6f;
  const float forward = (1 - g * g) / std::pow(1 + g * g, 1.5f);
  expect_exact("forward",
               along_z(airy("\"extinction\" .25, \"scatter\" .5 .5 .5, \"r\" 1, \"g1\" .6")),
               kept + even * forward);
  expect_exact("two lobes",
               along_z(airy("\"extinction\" .25, \"scatter\" .5 .5 .5, \"r\" .25, \"g1\" .6")),
               kept + even * (.25f * forward + .75f));
}

TEST(PartiVolume, ForwardLobesShineAgainstTheLight) {
  const auto facing = [](const char* direction) {
    SceneText scene = airy("\"extinction\" .25, \"scatter\" 1 1 1, \"r\" 1, \"g1\" .7");
    scene.light("lamp",
                fmt::format("\"mib_light_infinite\" ( \"color\" 9 9 9 ) direction {}", direction));
    return along_z(scene).mean.x;
  };
  // Light toward the eye continues to it.
  EXPECT_GT(facing("0 0 1"), 3 * facing("0 0 -1"));
}

TEST(PartiVolume, EndsAtItsHeight) {
  const auto below = [](float height) {
    return along_z(airy(fmt::format("\"mode\" 1, \"extinction\" .25, \"height\" {}", height)));
  };
  expect_exact("below", below(1), std::exp(-1.0f));
  expect_exact("above", below(-1), 1.0f);
}

TEST(PartiVolume, LightListsAndShadowsAct) {
  SceneText other = airy("\"extinction\" .25, \"scatter\" .5 .5 .5, \"lights\" [ \"lamp_i\" ]");
  other.light("lamp", "\"mib_light_infinite\" ( \"color\" 0 0 0 ) direction 1 0 0");
  expect_exact("list", along_z(other), std::exp(-1.0f));
}

Rgb through_lens(const std::string& call, const Rgb& color, Vec2 raster = Vec2(16, 16)) {
  SceneText scene;
  scene.statement("scalar texture \"t\" [4 1 1] '003366ff'")
      .camera("focal 1 aperture 1 aspect 1 resolution 32 32 lens " + call);
  const Probe probe(scene);
  return map_color(probe.world().lens, probe.world(), raster, color);
}

void expect_rgb(const Rgb& c, const Rgb& wanted) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(c[k], wanted[k], 2e-3f) << k;
}

TEST(LensNodes, ClampMapsARangeToTheUnitInterval) {
  const std::string range = "\"mib_lens_clamp\" ( \"floor\" 1, \"ceiling\" 3";
  expect_rgb(through_lens(range + " )", Rgb(0, 2, 5)), Rgb(0, .5f, 1));
  const std::string light =
      range + ", \"luminance\" on, \"floor_color\" 1 0 0, \"ceil_color\" 0 1 0 )";
  expect_rgb(through_lens(light, Rgb(.5f)), Rgb(1, 0, 0));
  expect_rgb(through_lens(light, Rgb(4)), Rgb(0, 1, 0));
  expect_rgb(through_lens(light, Rgb(2)), Rgb(.5f));
  expect_rgb(through_lens("\"mib_lens_clamp\" ( )", Rgb(-1, .5f, 2)), Rgb(0, .5f, 1));
}

TEST(LensNodes, StencilCoversPartsOfThePicture) {
  const std::string call =
      "\"mib_lens_stencil\" ( \"floor\" .1, \"ceiling\" .5, \"floor_color\" 1 0 0, "
      "\"ceil_color\" 0 1 0, \"stencil\" \"t\" )";
  const Rgb seen(.8f, .8f, .8f);
  expect_rgb(through_lens(call, seen, Vec2(4, 16)), Rgb(1, 0, 0));                    // 0
  expect_rgb(through_lens(call, seen, Vec2(28, 16)), Rgb(0, 1, 0));                   // 1
  expect_rgb(through_lens(call, seen, Vec2(12, 16)), seen * .25f + Rgb(.75f, 0, 0));  // 0.2
}

TEST(LensNodes, OversamplingChangesNothing) {
  expect_rgb(through_lens("\"oversampling_lens\" ( )", Rgb(.1f, .2f, 3)), Rgb(.1f, .2f, 3));
}

}  // namespace physics_nodes_test
}  // namespace oriel::testing
