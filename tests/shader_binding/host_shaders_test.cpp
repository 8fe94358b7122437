// SPDX-License-Identifier: Apache-2.0
// Approximations of host shaders: results in scenes, and reports.
#include <cmath>

#include "lights/sample_light.h"
#include "output/camera_output.h"
#include "probe.h"
#include "runtime/closure.h"
#include "runtime/color_mapping.h"
#include "runtime/material.h"

namespace oriel {
namespace host_shaders_test {

/// As Maya's translator writes: no declaration at hand, an engine around the surface.
const std::string kScene =
    "shader \"phong1\" \"maya_phong\" ( \"color\" .5 .5 .5, \"diffuse\" .8, "
    "\"transparency\" .25 .25 .25, \"specularColor\" .5 .5 .5, \"reflectivity\" .4, "
    "\"incandescence\" .1 0 0 )\n"
    "shader \"engine\" \"maya_shadingengine\" ( \"surfaceShader\" = \"phong1.outColor\" )\n"
    "shader \"dark\" \"maya_shadow\" ( \"transparency\" .25 .25 .25 )\n"
    "material \"m\" = \"engine\" shadow = \"dark\" photon = \"engine\" end material\n";

TEST(HostShaders, MayasSurfacesBecomeTheirParts) {
  const ProbeScene s(kScene);
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  ShadingPoint point;
  point.world = s.world.get();
  Closure c;
  shade(*s.material("m"), point, c);
  ASSERT_EQ(c.count, 4);
  // A mirror of .2 leaves .8; a quarter of that is seen through.
  EXPECT_NEAR(c.lobes[0].weight.x, .8f * .75f * .5f * .8f, 1e-6f);
  EXPECT_EQ(c.lobes[1].kind, LobeKind::ThinTransmission);
  EXPECT_NEAR(c.lobes[1].weight.x, .2f, 1e-6f);
  EXPECT_EQ(c.lobes[2].kind, LobeKind::Mirror);
  EXPECT_NEAR(c.lobes[2].weight.x, .2f, 1e-6f);
  EXPECT_EQ(c.lobes[3].kind, LobeKind::PhongHighlight);
  EXPECT_FLOAT_EQ(c.emission.x, .1f);
}

TEST(HostShaders, TheirParametersAreReportedAsApproximated) {
  const ProbeScene s(kScene);
  EXPECT_EQ(s.report.binding.approximated.count("maya_phong.color"), 0u) << "as declared";
  EXPECT_EQ(s.report.binding.approximated.count("maya_phong.transparency"), 1u);
  EXPECT_EQ(s.report.binding.approximated.count("maya_shadow.transparency"), 1u);
}

/// Scene text of one light with that shader and its placement.
std::string lamp(const std::string& shader, const std::string& where = "origin 0 0 0") {
  return kScene + "light \"l\" " + shader + " " + where +
         " end light\ninstance \"l_i\" \"l\" end instance\n";
}

/// What a Lambert surface at `at` that faces up the z axis shows of the light, cosine apart.
Rgb shown(const ProbeScene& s, const Vec3& at) {
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  EXPECT_EQ(s.world->lights.size(), 1u);
  ShadingPoint point;
  point.world = s.world.get();
  point.position = at;
  const auto sample = sample_light(s.world->lights.at(0), point, Vec2(.5f));
  return sample ? sample->irradiance * (1 / kPi) : Rgb(0);
}

TEST(HostShaders, MayasLightsShine) {
  const ProbeScene s(lamp("\"maya_spotlight\" ( \"color\" 1 .5 .25, \"intensity\" 2, "
                          "\"decayRate\" 2 )",
                          "origin 0 0 0 direction 0 0 -1 spread .9"),
                     "\"l_i\"");
  const Rgb c = shown(s, Vec3(0, 0, -2));
  EXPECT_NEAR(c.x, 2.0f / 4, 1e-4f);
  EXPECT_NEAR(c.z, .5f / 4, 1e-4f);
  EXPECT_EQ(s.report.binding.fallbacks.count("maya_spotlight"), 1u);
}

TEST(HostShaders, SpotsFadeOverTheirPenumbra) {
  // A cone of 40 degrees and a rim of 10 on each side, written in radians and in degrees.
  for (const char* angles : {"\"coneAngle\" .6981317, \"penumbraAngle\" .1745329",
                             "\"coneAngle\" 40, \"penumbraAngle\" 10"}) {
    const ProbeScene s(lamp("\"maya_spotlight\" ( " + std::string(angles) + " )",
                            "origin 0 0 0 direction 0 0 -1 spread .5"),
                       "\"l_i\"");
    const auto at = [&](float degrees) {
      const float a = degrees * kPi / 180;
      return shown(s, Vec3(std::sin(a), 0, -std::cos(a))).x;
    };
    EXPECT_NEAR(at(0), 1, 1e-5f) << angles;
    EXPECT_NEAR(at(19), 1, 1e-5f) << angles;
    EXPECT_NEAR(at(25), .5f, 1e-3f) << angles;
    EXPECT_NEAR(at(31), 0, 1e-5f) << angles;
  }
}

TEST(HostShaders, AmbientLightIgnoresTheAngle) {
  for (const float shade : {0.0f, 1.0f}) {
    const ProbeScene s(lamp("\"maya_ambientlight\" ( \"color\" .5 .5 .5, \"ambientShade\" " +
                                std::to_string(shade) + " )",
                            "origin 0 0 10"),
                       "\"l_i\"");
    for (const float x : {0.0f, 5.0f, 10.0f}) {
      const float cosine = 10 / std::hypot(10.0f, x);
      EXPECT_NEAR(shown(s, Vec3(x, 0, 0)).x * cosine, shade == 0 ? .5f : .5f * cosine, 1e-4f);
    }
  }
}

TEST(HostShaders, EveryLightIsItsColourTimesItsStrength) {
  const struct {
    const char *shader, *where;
    float expected;  // two units below the light
  } cases[] = {
      {"\"maya_directionallight\" ( \"color\" .5 0 0, \"intensity\" 3 )", "direction 0 0 -1", 1.5f},
      {"\"maya_pointlight\" ( \"color\" .5 0 0, \"decayRate\" 1 )", "origin 0 0 0", .25f},
      {"\"maya_volumelight\" ( \"color\" .5 0 0 )", "origin 0 0 0", .5f},
      {"\"max_DefaultLight\" ( \"color\" .5 0 0, \"multiplier\" 2 )", "direction 0 0 -1", 1},
      {"\"adsk_Light_Default\" ( \"color\" .5 0 0 )", "direction 0 0 -1", .5f},
      {"\"max_OmniLight\" ( \"GeneralParameters\" { \"Color\" .5 0 0, \"Multiplier\" 2 }, "
       "\"AttenuationParameters\" { \"Decay\" 2, \"DecayRadius\" 1 } )",
       "origin 0 0 0", .25f},
      {"\"max_OmniLight\" ( \"Color\" .5 0 0, \"UseFarAttenuation\" on, \"FarStart\" 1, "
       "\"FarEnd\" 3 )",
       "origin 0 0 0", .25f},
      {"\"max_OmniLight\" ( \"On\" off )", "origin 0 0 0", 0},
      {"\"max_SpotLight\" ( \"HotSpot\" 20, \"Falloff\" 40, \"Color\" .5 0 0 )",
       "origin 0 0 0 direction 0 0 -1 spread .5", .5f},
      {"\"max_DirectionalLight\" ( \"Color\" .5 0 0 )", "direction 0 0 -1", .5f},
  };
  for (const auto& c : cases) {
    const ProbeScene s(lamp(c.shader, c.where), "\"l_i\"");
    EXPECT_NEAR(shown(s, Vec3(0, 0, -2)).x, c.expected, 1e-5f) << c.shader;
  }
}

Closure closure_of(const ProbeScene& s, const std::string& name = "m") {
  ShadingPoint point;
  point.world = s.world.get();
  point.dpdu = Vec3(1, 0, 0);
  point.dpdv = Vec3(0, 1, 0);
  Closure c;
  const Material* material = s.material(name);
  EXPECT_NE(material, nullptr) << s.messages();
  if (material) shade(*material, point, c);
  return c;
}

TEST(HostShaders, EverySurfaceHasItsColourAndHighlight) {
  const struct {
    const char* shader;
    LobeKind highlight;
  } cases[] = {{"maya_phong", LobeKind::PhongHighlight},
               {"maya_phongE", LobeKind::PhongHighlight},
               {"maya_phonge", LobeKind::PhongHighlight},
               {"maya_blinn", LobeKind::TorranceHighlight},
               {"maya_anisotropic", LobeKind::WardHighlight}};
  for (const auto& c : cases) {
    const ProbeScene s("material \"m\" \"" + std::string(c.shader) +
                       "\" ( \"color\" .5 .25 1, \"diffuse\" .5, \"specularColor\" .4 .4 .4 ) "
                       "end material\n");
    EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
    const Closure closure = closure_of(s);
    ASSERT_EQ(closure.count, 2) << c.shader;
    EXPECT_NEAR(closure.lobes[0].weight.x, .25f, 1e-6f) << c.shader;
    EXPECT_NEAR(closure.lobes[0].weight.z, .5f, 1e-6f) << c.shader;
    EXPECT_EQ(closure.lobes[1].kind, c.highlight) << c.shader;
    EXPECT_NEAR(closure.lobes[1].weight.x, .4f, 1e-6f) << c.shader;
    EXPECT_EQ(s.report.binding.fallbacks.count(c.shader), 1u);
  }
}

TEST(HostShaders, LayersLieOverEachOther) {
  const ProbeScene s(
      "shader \"top\" \"maya_lambert\" ( \"color\" 1 0 0, \"diffuse\" 1, \"transparency\" .25 .25 "
      ".25 )\n"
      "shader \"low\" \"maya_lambert\" ( \"color\" 0 1 0, \"diffuse\" 1 )\n"
      "shader \"both\" \"maya_layeredshader\" ( \"inputs\" [ { \"color\" = \"top.outColor\", "
      "\"transparency\" = \"top.outTransparency\" }, { \"color\" = \"low.outColor\", "
      "\"transparency\" .5 .5 .5 } ] )\n"
      "material \"m\" = \"both\" end material\n");
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  const Closure c = closure_of(s);
  ASSERT_EQ(c.count, 3);
  EXPECT_NEAR(c.lobes[0].weight.x, .75f, 1e-6f) << "red where the top hides";
  EXPECT_NEAR(c.lobes[1].weight.y, .25f, 1e-6f) << "green through it";
  EXPECT_EQ(c.lobes[2].kind, LobeKind::ThinTransmission);
  EXPECT_NEAR(c.lobes[2].weight.x, .125f, 1e-6f) << "what both leave";
}

TEST(HostShaders, UseBackgroundIsSeenThroughUnderAMirror) {
  const ProbeScene s(
      "material \"m\" \"maya_usebackground\" ( \"specularColor\" .5 .5 .5, \"reflectivity\" .5 ) "
      "end material\n");
  const Closure c = closure_of(s);
  ASSERT_EQ(c.count, 2);
  EXPECT_NEAR(c.lobes[0].weight.x, .25f, 1e-6f);
  EXPECT_EQ(c.lobes[1].kind, LobeKind::ThinTransmission);
  EXPECT_NEAR(c.lobes[1].weight.x, .75f, 1e-6f);
}

TEST(HostShaders, TheScenesOwnDeclarationGivesDefaultsAndMoreParameters) {
  const std::string declared =
      "declare shader color \"maya_lambert\" ( color \"color\" default .2 .4 .6, scalar "
      "\"Diffuse\" default .5, scalar \"matteOpacity\" default 1, struct \"more\" { color "
      "\"incandescence\" default .1 0 0 } ) version 4 apply material end declare\n";
  const ProbeScene s(declared +
                     "material \"m\" \"maya_lambert\" ( \"matteOpacity\" .5, \"more\" { "
                     "\"INCANDESCENCE\" .3 0 0, \"glow\" 2 } ) end material\n");
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  const Closure c = closure_of(s);
  EXPECT_NEAR(c.lobes[0].weight.x, .1f, 1e-6f);
  EXPECT_NEAR(c.lobes[0].weight.z, .3f, 1e-6f);
  EXPECT_NEAR(c.emission.x, .3f, 1e-6f);
  EXPECT_EQ(s.report.binding.ignored.count("maya_lambert.matteOpacity"), 1u);
  EXPECT_EQ(s.report.binding.ignored.count("maya_lambert.glow"), 1u);
}

TEST(HostShaders, BuffersOfTheHostLeaveThePictureAsItIs) {
  const testing::PreparedScene s(
      testing::scene_text(kScene, "", "lens \"max_base_GBuffer_lens\" ( \"MtlID\" on )"));
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  EXPECT_TRUE(s.world->lens.empty());
  EXPECT_TRUE(s.world->lens_rays.empty());
  EXPECT_EQ(s.report.binding.fallbacks.count("max_base_GBuffer_lens"), 1u);
}

TEST(HostShaders, NewerNamesOfMayasShadersAreTheSameShaders) {
  // As the translators of Maya 2012 to 2017 spell them.
  const char* const names[][2] = {
      {"adskMayaLambert", "maya_lambert"},
      {"adskMayaPhong", "maya_phong"},
      {"adskMayaPhongE", "maya_phongE"},
      {"adskMayaBlinn", "maya_blinn"},
      {"adskMayaShadingEngine", "maya_shadingengine"},
      {"adskMayaUseBackground", "maya_usebackground"},
      {"adskMayaShadow", "maya_shadow"},
      {"adskMayaVolumeEngine", "maya_volumeengine"},
      {"adskMayaDirectionalLight", "maya_directionallight"},
      {"adskMayaPointLight", "maya_pointlight"},
      {"adskMayaSpotLight", "maya_spotlight"},
      {"adskMayaFile", "maya_file"},
      {"adskMayaPlace2dTexture", "maya_place2dtex"},
      {"adskMayaShaderGlow", "maya_shaderglow"},
      {"maya_colormgt", "maya_colormanagement"},
  };
  for (const auto& name : names) {
    const ShaderSpec* spec = builtin_shaders().find(name[0]);
    ASSERT_NE(spec, nullptr) << name[0];
    EXPECT_STREQ(spec->name, name[1]) << name[0];
  }
  EXPECT_EQ(builtin_shaders().find("adskMayaNothing"), nullptr);
  EXPECT_EQ(builtin_shaders().find("adskMaya"), nullptr);
}

TEST(HostShaders, AValueOfNormalCameraIsNoBump) {
  for (const char* shader : {"adskMayaLambert", "maya_phong", "maya_anisotropic"}) {
    const ProbeScene s("material \"m\" \"" + std::string(shader) +
                       "\" ( \"color\" .5 .5 .5, \"normalCamera\" 1. 1. 1. ) end material\n");
    const Closure c = closure_of(s);
    ASSERT_GE(c.count, 1);
    for (int i = 0; i < c.count; ++i) EXPECT_EQ(c.lobes[i].frame.n, Vec3(0, 0, 1)) << shader;
  }
}

TEST(HostShaders, ColourManagementEncodesForADisplay) {
  // IEC 61966-2-1: .21404 is encoded as .5; a gamma of 2.2 gives .5 for .5^2.2 = .21764.
  const struct {
    const char* call;
    float linear;
  } cases[] = {{"\"maya_colormgt\" ( )", .21404f},
               {"\"maya_colormanagement\" ( \"gamma\" 2.2 )", .21764f}};
  for (const auto& c : cases)
    for (const std::string slot : {"lens ", "output \"rgba\" "}) {
      const testing::PreparedScene s(testing::scene_text(kScene, "", slot + c.call),
                                     probe_registry());
      EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
      Diagnostics diagnostics;
      World& world = *s.world;
      const NodeList nodes =
          slot == "lens " ? world.lens
                          : camera_output_shaders(*s.scene.get<scene::Camera>("cam"), s.scene,
                                                  probe_registry(), world, diagnostics);
      ASSERT_EQ(nodes.size(), 1u) << slot << c.call;
      EXPECT_NEAR(map_color(nodes, world, Vec2(.5f), Rgb(c.linear)).y, .5f, 1e-4f)
          << slot << c.call;
      world.options.gamma = 2.2f;
      EXPECT_EQ(map_color(nodes, world, Vec2(.5f), Rgb(.25f)), Rgb(.25f)) << "never twice";
    }
}

TEST(HostShaders, AllAreReportedAsApproximated) {
  int count = 0;
  for (const ShaderSpec* spec : builtin_shaders().all()) {
    if (std::string_view(spec->library) != "hosts") continue;
    ++count;
    EXPECT_TRUE(spec->fallback.is_fallback) << spec->name;
    for (const ParamSpec& p : spec->params)
      EXPECT_NE(p.support, Support::Exact) << spec->name << '.' << p.name;
    // A call without parameters, in the slot where it belongs, reads without an error.
    const std::string call = "\"" + std::string(spec->name) + "\" ( )";
    const ProbeScene s(spec->apply & kApplyLight ? lamp(call)
                       : spec->apply & kApplyShadow
                           ? kScene +
                                 "material \"x\" \"maya_lambert\" ( "
                                 ") shadow " +
                                 call + " end material"
                           : kScene + "material \"x\" " + call + " end material",
                       spec->apply & kApplyLight ? "\"l_i\"" : "");
    for (const Diagnostic& d : s.diagnostics.all())
      EXPECT_NE(d.severity, Severity::Error) << s.messages();
    if (spec->apply & kApplyLight) {
      EXPECT_EQ(s.report.binding.fallbacks.count(spec->name), 1u) << spec->name;
    }
  }
  EXPECT_GE(count, 60);
}

TEST(MaxShaders, TheStandardMaterialTakesItsIlluminationAndMaps) {
  const ProbeScene s(
      "color texture \"pic\" [1 1 3] '00ff00'\n"
      "shader \"map\" \"max_Bitmap\" ( \"Parameters\" { \"ClipU\" 0, \"Bitmap\" \"pic\" } )\n"
      "shader \"blinn\" \"max_base_BlinnIllumination\" ( \"Parameters\" { \"Diffuse\" .8 .4 0 1, "
      "\"SpecularLevel\" .5, \"Specular\" 1 1 1, \"Glossiness\" .3 } )\n"
      "shader \"std\" \"max_StandardMaterial\" ( \"Shader\" \"blinn\", \"ExtendedParameters\" { "
      "\"Opacity\" 75., \"FilterColor\" 1 0 0 }, \"Maps\" { \"MapEnables\" [ off, on ], \"Maps\" [ "
      "\"\", \"map\" ], \"MapAmounts\" [ 1, .5 ] } )\n"
      "material \"m\" = \"std\" shadow \"max_DefaultShadow\" ( ) end material\n");
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  const Closure c = closure_of(s);
  ASSERT_EQ(c.count, 3);
  EXPECT_NEAR(c.lobes[0].weight.x, .75f * .4f, 1e-5f) << "half of the colour";
  EXPECT_NEAR(c.lobes[0].weight.y, .75f * .7f, 1e-5f) << "half of the map";
  EXPECT_NEAR(c.lobes[1].weight.x, .5f, 1e-5f);
  EXPECT_NEAR(c.lobes[1].roughness, 8, 1e-4f) << "2^(10 x .3)";
  EXPECT_NEAR(c.lobes[2].weight.x, .25f, 1e-5f) << "seen through, in red";
  EXPECT_NEAR(c.lobes[2].weight.y, 0, 1e-5f);
  EXPECT_TRUE(s.material("m")->may_transmit) << "its shadows are the surface's";
}

TEST(MaxShaders, StoredElementsShowTheirMaterial) {
  for (const char* parameter : {"Material", "beautyShader"}) {
    const ProbeScene s(
        "shader \"red\" \"maya_lambert\" ( \"color\" 1 0 0, \"diffuse\" .5, \"transparency\" "
        ".5 .5 .5 )\n"
        "shader \"kept\" \"max_mrStoreElements\" ( \"index\" 2, \"" +
        std::string(parameter) +
        "\" = \"red\" )\n"
        "material \"m\" = \"kept\" shadow = \"kept\" end material\n");
    const Closure c = closure_of(s);
    ASSERT_EQ(c.count, 2) << parameter;
    EXPECT_NEAR(c.lobes[0].weight.x, .25f, 1e-6f);
    EXPECT_TRUE(s.material("m")->may_transmit);
  }
}

TEST(ProductionShaders, GammaAndGainAreUndoneByReverse) {
  // 2 x .125 = .25, and .25^(1/2) = .5.
  const ProbeScene s(probe_call(
      "\"tint\" = \"there\", \"tint_warm\" = \"back\"",
      "shader \"there\" \"mip_gamma_gain\" ( \"input\" .125 .125 .125, \"gamma\" 2, \"gain\" 2 "
      ")\n"
      "shader \"back\" \"mip_gamma_gain\" ( \"input\" = \"there\", \"gamma\" 2, \"gain\" 2, "
      "\"reverse\" on )\n"));
  EXPECT_NEAR(s.params().tint.r, .5f, 1e-5f);
  EXPECT_NEAR(s.params().tint_warm.r, .125f, 1e-5f);
}

TEST(ProductionShaders, EachKindOfRayHasItsOwnMaterial) {
  const ProbeScene s(
      "shader \"red\" \"maya_lambert\" ( \"color\" 1 0 0, \"diffuse\" 1 )\n"
      "material \"m\" \"mip_rayswitch\" ( \"eye\" = \"red\", \"reflection\" 0 1 0, \"default\" "
      "0 0 1 ) end material\n");
  const auto seen = [&](RayKind kind) {
    ShadingPoint point;
    point.world = s.world.get();
    point.ray_kind = kind;
    Closure c;
    shade(*s.material("m"), point, c);
    return c.count > 0 ? c.lobes[0].weight : c.emission;
  };
  EXPECT_EQ(seen(RayKind::Eye), Rgb(1, 0, 0));
  EXPECT_EQ(seen(RayKind::Reflect), Rgb(0, 1, 0));
  EXPECT_EQ(seen(RayKind::Refract), Rgb(0)) << "no fall-through";
  EXPECT_EQ(seen(RayKind::Probe), Rgb(0, 0, 1));
}

TEST(MaxShaders, WithoutAMaterialThingsAreGreyAndTheEnvironmentIsAMapOrAColour) {
  const ProbeScene s(
      "shader \"checks\" \"max_Checker\" ( \"Color1\" 1 0 0, \"Color2\" 0 0 1 )\n"
      "shader \"plain\" \"max_Environment\" ( \"Color\" .1 .2 .3 )\n"
      "shader \"mapped\" \"max_Environment\" ( \"Color\" .1 .2 .3, \"Map\" \"checks\" )\n"
      "shader \"product\" \"max_RGBMultiplier\" ( \"Color1\" .5 1 1, \"Map2\" \"checks\" )\n"
      "material \"m\" \"max_DefaultMaterial\" ( \"Parameters\" { \"specular\" .9 .9 .9 } ) end "
      "material\n"
      "material \"a\" \"probe\" ( \"tint\" = \"plain\" ) end material\n"
      "material \"b\" \"probe\" ( \"tint\" = \"mapped\" ) end material\n"
      "material \"c\" \"probe\" ( \"tint\" = \"product\" ) end material\n"
      "object \"o\" visible trace shadow tagged group -1 -1 -4 1 -1 -4 1 1 -4 v 0 v 1 v 2 p 0 0 1 "
      "2 end group end object\n"
      "instance \"oa\" \"o\" material [ \"a\" ] end instance\n"
      "instance \"ob\" \"o\" material [ \"b\" ] end instance\n"
      "instance \"oc\" \"o\" material [ \"c\" ] end instance\n",
      "\"oa\" \"ob\" \"oc\"");
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  const Closure c = closure_of(s);
  ASSERT_EQ(c.count, 2);
  EXPECT_FLOAT_EQ(c.lobes[0].weight.x, .5f);
  expect_color(s.params("a").tint, .1f, .2f, .3f, 1);
  expect_color(s.params("b").tint, 1, 0, 0, 1);
  expect_color(s.params("c").tint, .5f, 0, 0, 1);
}

TEST(MaxShaders, CoordinatesAreTiledAboutTheMiddle) {
  const ProbeScene s(
      probe_call("\"place\" = \"uv\"",
                 "shader \"uv\" \"max_base_UVGenerator\" ( \"UScale\" 2, \"VOffset\" .25 )\n"));
  ShadingPoint point;
  point.world = s.world.get();
  point.texture_spaces = 1;
  point.tex[0] = Vec3(.6f, .5f, 0);
  Vec3 uv(0);
  s.node()->with_params(point, [&](const Call& c) { uv = c.as<ProbeParams>().place; });
  EXPECT_NEAR(uv.x, .7f, 1e-6f);
  EXPECT_NEAR(uv.y, .25f, 1e-6f);
}

TEST(FallbackShaders, AreChosenByName) {
  const ProbeScene s(
      "color texture \"pic\" [1 1 3] '804020'\n"
      "light \"l\" \"acme_lamp\" ( \"light_color\" 1 .5 0, \"intensity\" 3 ) origin 0 0 0 end "
      "light\n"
      "instance \"l_i\" \"l\" end instance\n"
      "shader \"paint\" \"acme_paint\" ( \"image\" \"pic\", \"gloss_map\" 2 )\n"
      "shader \"wall\" \"acme_wall\" ( \"baseColor\" = \"paint\", \"diffuse\" .5, \"transparency\" "
      ".25 .25 .25, \"specular_color\" .2 .2 .2 )\n"
      "material \"m\" = \"wall\" end material\n",
      "\"l_i\"");
  EXPECT_EQ(s.report.binding.guessed.size(), 3u) << s.messages();
  EXPECT_TRUE(s.report.binding.missing_shaders.empty());
  ASSERT_EQ(s.report.binding.guessed.count("acme_wall"), 1u);
  EXPECT_NE(s.report.binding.guessed.at("acme_wall").find("color \"baseColor\""),
            std::string::npos);
  int said = 0;
  for (const Diagnostic& d : s.diagnostics.all()) {
    EXPECT_TRUE(d.code == "OR-RT-001" || d.code == "OR-MI-030") << s.messages();
    said += d.message.find("guessed") != std::string::npos;
  }
  EXPECT_EQ(said, 3);
  const Closure c = closure_of(s);
  ASSERT_EQ(c.count, 3);
  EXPECT_NEAR(c.lobes[0].weight.x, 128 / 255.0f * .5f * .75f, 1e-4f);
  EXPECT_NEAR(c.lobes[0].weight.z, 32 / 255.0f * .5f * .75f, 1e-4f);
  EXPECT_NEAR(c.lobes[1].weight.x, .25f, 1e-5f);
  EXPECT_NEAR(c.lobes[2].weight.x, .2f, 1e-5f);
  ShadingPoint point;
  point.world = s.world.get();
  point.position = Vec3(0, 0, -2);
  const auto sample = sample_light(s.world->lights.at(0), point, Vec2(.5f));
  ASSERT_TRUE(sample.has_value());
  EXPECT_NEAR(sample->irradiance.x / kPi, 3, 1e-4f);
  EXPECT_NEAR(sample->irradiance.y / kPi, 1.5f, 1e-4f);
}

TEST(FallbackShaders, UnrelatedOrMisspeltNamesHaveNone) {
  const ProbeScene s(
      "material \"m\" \"acme_thing\" ( \"frobnicate\" 3, \"color\" \"text\" ) end material\n"
      "material \"n\" \"mia_materiel\" ( \"diffuse\" 1 1 1 ) end material\n");
  EXPECT_TRUE(s.report.binding.guessed.empty());
  EXPECT_EQ(s.report.binding.missing_shaders.size(), 1u) << "the one that is used";
  const Closure c = closure_of(s);
  EXPECT_GT(c.lobes[0].weight.x, 4 * c.lobes[0].weight.y) << "magenta";
}

}  // namespace host_shaders_test
}  // namespace oriel
