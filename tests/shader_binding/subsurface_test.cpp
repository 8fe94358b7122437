// SPDX-License-Identifier: Apache-2.0
// The subsurface library: scenes as exporters write them, without its declarations.
#include <cmath>

#include "probe.h"
#include "runtime/closure.h"
#include "runtime/material.h"
#include "shaders/subsurface/subsurface.h"

namespace oriel {
namespace subsurface_test {

Closure closure_of(const ProbeScene& s) {
  ShadingPoint point;
  point.world = s.world.get();
  Closure closure;
  shade(*s.material("m"), point, closure);
  return closure;
}

TEST(Subsurface, PhenomenaWithGroupedParametersAreTheirLayers) {
  // As the declaration of the reference groups them; textures and lists without effect.
  const ProbeScene s(
      "local color texture \"map\" \"sss.map\"\n"
      "material \"m\" \"misss_fast_simple_phen\" ( \"lightmap_group\" \"sss\", \"lightmap_size\" "
      "50., \"samples\" 64, \"d\" { \"ambient\" .1 0 0, \"overall_color\" 1 1 1, "
      "\"diffuse_color\" .5 .5 .5, \"diffuse_weight\" .4, \"front_sss_color\" 1 .5 .2, "
      "\"front_sss_weight\" .5, \"front_sss_radius\" 10., \"back_sss_color\" .8 .4 .1, "
      "\"back_sss_weight\" .25, \"back_sss_radius\" 10., \"back_sss_depth\" 10. }, "
      "\"s\" { \"specular\" .2 .2 .2, \"exponent\" 40. }, "
      "\"a\" { \"lightmap_gamma\" 1., \"indirect\" on, \"scale_conversion\" 1., "
      "\"scatter_bias\" 0., \"falloff\" 2., \"screen_composit\" off }, \"mode\" 4 ) end "
      "material\n");
  for (const Diagnostic& d : s.diagnostics.all())
    EXPECT_EQ(d.severity, Severity::Note) << s.messages();
  const Closure c = closure_of(s);
  ASSERT_EQ(c.count, 3);
  // In sum .9, .65 and .325: nothing is scaled.
  EXPECT_EQ(c.lobes[0].kind, LobeKind::Diffuse);
  EXPECT_NEAR(c.lobes[0].weight.x, .7f, 1e-6f);
  EXPECT_NEAR(c.lobes[0].weight.z, .3f, 1e-6f);
  EXPECT_EQ(c.lobes[1].kind, LobeKind::Translucency);
  EXPECT_NEAR(c.lobes[1].weight.x, .2f, 1e-6f);
  EXPECT_EQ(c.lobes[2].kind, LobeKind::PhongHighlight);
  EXPECT_EQ(c.lobes[2].roughness, 40);
  EXPECT_NEAR(c.emission.x, .07f, 1e-6f);
  EXPECT_EQ(s.report.binding.fallbacks.count("misss_fast_simple_phen"), 1u);
  EXPECT_EQ(s.report.binding.approximated.count("misss_fast_simple_maya.front_sss_radius"), 1u);
  EXPECT_EQ(s.report.binding.ignored.count("misss_fast_simple_maya.lightmap_gamma"), 1u);
}

TEST(Subsurface, LightMapShadersLeaveThePictureAsItIs) {
  const ProbeScene s(
      "material \"m\" \"misss_fast_skin_maya\" ( \"diffuse_weight\" .3 ) "
      "lightmap \"misss_fast_lmap_maya\" ( \"scatter_bias\" .1 ) end material\n");
  for (const Diagnostic& d : s.diagnostics.all())
    EXPECT_TRUE(d.code == "OR-RT-045") << s.messages();
  EXPECT_EQ(closure_of(s).lobes[0].kind, LobeKind::Diffuse);
}

TEST(Subsurface, EveryNameOfTheLibraryIsKnown) {
  for (const char* name :
       {"misss_fast_simple_maya", "misss_fast_simple_phen", "misss_fast_simple_phen_d",
        "misss_fast_skin_maya",   "misss_fast_skin_phen",   "misss_fast_skin_phen_d",
        "misss_mia_skin2_phen",   "misss_mia_skin2_phen_d", "misss_mia_skin2_surface_phen",
        "misss_fast_shader",      "misss_fast_shader_x",    "misss_fast_shader2",
        "misss_fast_shader2_x",   "misss_physical",         "misss_physical_phen",
        "misss_skin_specular",    "misss_lightmap_write",   "misss_lightmap_phen",
        "misss_fast_lmap_maya",   "misss_lambert_gamma",    "misss_call_shader",
        "misss_set_normal"})
    EXPECT_NE(builtin_shaders().find(name), nullptr) << name;
}

TEST(Subsurface, LayersNeverReflectMoreThanFallsIn) {
  for (const char* shader : {"misss_fast_simple_maya", "misss_fast_skin_maya"})
    for (const char* screen : {"on", "off"}) {
      const ProbeScene s(std::string("material \"m\" \"") + shader +
                         "\" ( \"diffuse_weight\" 1, \"front_sss_weight\" 1, \"mid_sss_weight\" 1, "
                         "\"back_sss_weight\" 1, \"screen_composit\" " +
                         screen + " ) end material\n");
      const Closure c = closure_of(s);
      Rgb sum(0);
      for (int i = 0; i < c.count; ++i) sum += c.lobes[i].weight;
      for (int k = 0; k < 3; ++k) EXPECT_LE(sum[k], 1 + 1e-6f) << shader << ' ' << screen;
      EXPECT_GT(sum.x, .5f);
    }
}

TEST(Subsurface, DiffuseReflectanceIsThatOfThePaper) {
  // Without absorption all light leaves again. The paper gives an albedo for skim milk (1.3): red
  // s' = .70, a = .0014, reflectance .81; skin 1: red s' = .74, a = .032, reflectance .44.
  for (const float index : {1.0f, 1.3f, 1.5f}) EXPECT_FLOAT_EQ(diffusion_reflectance(1, index), 1);
  EXPECT_EQ(diffusion_reflectance(0, 1.3f), 0);
  EXPECT_NEAR(diffusion_reflectance(.70f / .7014f, 1.3f), .81f, .01f);
  EXPECT_NEAR(diffusion_reflectance(.74f / .772f, 1.3f), .44f, .01f);
}

}  // namespace subsurface_test
}  // namespace oriel
