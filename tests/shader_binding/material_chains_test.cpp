// SPDX-License-Identifier: Apache-2.0
// Materials connected to materials: resulting closures, and rejected connections.
#include <fmt/format.h>

#include "probe.h"
#include "runtime/closure.h"
#include "runtime/material.h"

namespace oriel {
namespace material_chains_test {

const std::string kLambert =
    "shader \"l\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" .2 .2 .2, "
    "\"diffuse\" .8 .4 .2 )\n";

struct Chain {
  ProbeScene scene;
  Closure closure;

  explicit Chain(const std::string& text, bool back = false) : scene(text) {
    const Material* m = scene.material("m");
    if (!m) {
      ADD_FAILURE() << scene.messages();
      return;
    }
    ShadingPoint point;
    point.world = scene.world.get();
    point.back_side = back;
    shade(*m, point, closure);
  }
  void expect_silent() const { EXPECT_TRUE(scene.diagnostics.all().empty()) << scene.messages(); }
};

std::string material(const std::string& call) { return "material \"m\" " + call + " end material"; }

void expect_rgb(const Rgb& c, float r, float g, float b) {
  EXPECT_NEAR(c.x, r, 1e-6f);
  EXPECT_NEAR(c.y, g, 1e-6f);
  EXPECT_NEAR(c.z, b, 1e-6f);
}

TEST(MaterialChains, InputIsScaledAndTheRayIsAdded) {
  const Chain c(kLambert + material("\"mib_reflect\" ( \"input\" = \"l\", \"reflect\" .5 .25 0 )"));
  c.expect_silent();
  ASSERT_EQ(c.closure.count, 2);
  EXPECT_EQ(c.closure.lobes[0].kind, LobeKind::Diffuse);
  expect_rgb(c.closure.lobes[0].weight, .4f, .3f, .2f);
  EXPECT_EQ(c.closure.lobes[1].kind, LobeKind::Mirror);
  expect_rgb(c.closure.lobes[1].weight, .5f, .25f, 0);
  expect_rgb(c.closure.emission, .1f, .15f, .2f);
  expect_rgb(c.closure.albedo, .9f, .55f, .2f);
}

TEST(MaterialChains, InputMayBeAColour) {
  const Chain c(material("\"mib_transparency\" ( \"input\" 1 .5 0, \"transp\" .2 .2 .2 )"));
  c.expect_silent();
  ASSERT_EQ(c.closure.count, 1);
  EXPECT_EQ(c.closure.lobes[0].kind, LobeKind::ThinTransmission);
  expect_rgb(c.closure.emission, .8f, .4f, 0);
  const Chain connected("shader \"p\" \"probe\" ( \"tint\" .1 .2 .3 )\n" +
                        material("\"mib_transparency\" ( \"input\" = \"p\" )"));
  connected.expect_silent();
  expect_rgb(connected.closure.emission, .1f, .2f, .3f);
}

TEST(MaterialChains, BlackKeepsTheInputWhiteDropsIt) {
  for (const char* shader : {"reflect", "refract"}) {
    const auto with = [&](const char* level) {
      return kLambert +
             material(fmt::format("\"mib_{0}\" ( \"input\" = \"l\", \"{0}\" {1} )", shader, level));
    };
    const Chain none(with("0 0 0"));
    ASSERT_EQ(none.closure.count, 1);
    EXPECT_EQ(none.closure.lobes[0].kind, LobeKind::Diffuse);
    const Chain all(with("1 1 1"));
    ASSERT_EQ(all.closure.count, 1);
    EXPECT_NE(all.closure.lobes[0].kind, LobeKind::Diffuse);
    EXPECT_EQ(all.closure.emission, Rgb(0));
  }
}

TEST(MaterialChains, ChainsMultiply) {
  const Chain c(kLambert +
                "shader \"r\" \"mib_reflect\" ( \"input\" = \"l\", \"reflect\" .5 .5 .5 )\n" +
                material("\"mib_refract\" ( \"input\" = \"r\", \"refract\" .2 .2 .2, "
                         "\"ior\" 1.5 )"));
  c.expect_silent();
  ASSERT_EQ(c.closure.count, 3);
  expect_rgb(c.closure.lobes[0].weight, .32f, .16f, .08f);
  expect_rgb(c.closure.lobes[1].weight, .4f, .4f, .4f);
  expect_rgb(c.closure.lobes[2].weight, .2f, .2f, .2f);
  EXPECT_EQ(c.closure.lobes[2].kind, LobeKind::ClearRefraction);
  EXPECT_FLOAT_EQ(c.closure.lobes[2].eta, 1.5f);
  EXPECT_FALSE(c.closure.thin_walled);
}

TEST(MaterialChains, TwosidedUsesTheVisibleSide) {
  const std::string text =
      kLambert + material("\"mib_twosided\" ( \"front\" = \"l\", \"back\" 0 1 0 )");
  const Chain front(text), back(text, true);
  front.expect_silent();
  ASSERT_EQ(front.closure.count, 1);
  EXPECT_EQ(back.closure.count, 0);
  expect_rgb(back.closure.emission, 0, 1, 0);
}

TEST(MaterialChains, OpacityIsACutOutAsFarAsAllChannelsLetPass) {
  const Chain grey(kLambert +
                   material("\"mib_opacity\" ( \"input\" = \"l\", \"opacity\" .5 .5 .5 )"));
  EXPECT_EQ(grey.closure.count, 1);
  EXPECT_FLOAT_EQ(grey.closure.opacity, .5f);
  expect_rgb(grey.closure.lobes[0].weight, .8f, .4f, .2f);
  const Chain tinted(kLambert +
                     material("\"mib_opacity\" ( \"input\" = \"l\", \"opacity\" .5 .25 0 )"));
  ASSERT_EQ(tinted.closure.count, 2);
  EXPECT_FLOAT_EQ(tinted.closure.opacity, .5f);
  expect_rgb(tinted.closure.lobes[0].weight, .8f, .2f, 0);
  expect_rgb(tinted.closure.lobes[1].weight, 0, .5f, 1);
  const Chain twice(kLambert +
                    "shader \"o\" \"mib_opacity\" ( \"input\" = \"l\", \"opacity\" .5 .5 .5 )\n" +
                    material("\"mib_continue\" ( \"input\" = \"o\", \"transp\" .2 .2 .2 )"));
  EXPECT_FLOAT_EQ(twice.closure.opacity, .4f);
}

TEST(MaterialChains, ArchitecturalMaterialsMayLieBelow) {
  const Chain c(
      "shader \"a\" \"mia_material_x\" ( \"diffuse\" 1 1 1, \"reflectivity\" 0, "
      "\"ao_on\" on, \"ao_ambient\" .4 .4 .4 )\n" +
      material("\"mib_reflect\" ( \"input\" = \"a.result\", \"reflect\" .25 .25 .25 )"));
  c.expect_silent();
  ASSERT_EQ(c.closure.count, 2);
  expect_rgb(c.closure.lobes[0].weight, .75f, .75f, .75f);
  expect_rgb(c.closure.occlusion.ambient, .3f, .3f, .3f);
  EXPECT_EQ(c.closure.occlusion.samples, 16);
}

TEST(MaterialChains, PhenomenaMayBeChains) {
  const std::string phenomenon =
      "declare phenomenon color \"coat\" ( color \"base\", color \"level\" )\n"
      "  shader \"l\" \"mib_illum_lambert\" ( \"diffuse\" = interface \"base\" )\n"
      "  shader \"r\" \"mib_reflect\" ( \"input\" = \"l\", \"reflect\" = interface \"level\" )\n"
      "  root = \"r\"\nend declare\n";
  const Chain c(phenomenon + material("\"coat\" ( \"base\" .5 .5 .5, \"level\" .2 .2 .2 )"));
  c.expect_silent();
  ASSERT_EQ(c.closure.count, 2);
  expect_rgb(c.closure.lobes[0].weight, .4f, .4f, .4f);
  // And may lie below others themselves.
  const Chain outer(phenomenon +
                    "shader \"c\" \"coat\" ( \"base\" .5 .5 .5, \"level\" .2 .2 .2 )\n" +
                    material("\"mib_opacity\" ( \"input\" = \"c\", \"opacity\" 1 1 1 )"));
  outer.expect_silent();
  EXPECT_EQ(outer.closure.count, 2);
}

TEST(MaterialChains, UnknownShadersBelowBecomeTheFallback) {
  const Chain c("shader \"u\" \"nobody_has_this\" ( )\n" +
                material("\"mib_reflect\" ( \"input\" = \"u\", \"reflect\" .5 .5 .5 )"));
  EXPECT_NE(c.scene.only("OR-RT-001"), nullptr) << c.scene.messages();
  ASSERT_EQ(c.closure.count, 2);
  EXPECT_EQ(c.closure.lobes[0].kind, LobeKind::Diffuse);
}

TEST(MaterialChains, ExcessLobesAreDroppedAndReported) {
  std::string text = kLambert;
  std::string below = "l";
  for (int i = 0; i < 12; ++i) {
    text += fmt::format(
        "shader \"r{}\" \"mib_reflect\" ( \"input\" = \"{}\", \"reflect\" .1 .1 .1 )\n", i, below);
    below = fmt::format("r{}", i);
  }
  const Chain c(text + material(fmt::format("= \"{}\"", below)));
  EXPECT_NE(c.scene.only("OR-RT-008"), nullptr) << c.scene.messages();
  EXPECT_GE(c.closure.count, 1);
  EXPECT_LE(c.closure.count, Closure::kMaxLobes);
}

TEST(MaterialChains, CyclesAreRefused) {
  const Chain c(
      "shader \"a\" \"mib_reflect\" ( \"input\" = \"b\", \"reflect\" .5 .5 .5 )\n"
      "shader \"b\" \"mib_reflect\" ( \"input\" = \"a\", \"reflect\" .5 .5 .5 )\n" +
      material("= \"a\""));
  EXPECT_NE(c.scene.only("OR-RT-004"), nullptr) << c.scene.messages();
  EXPECT_LE(c.closure.count, 2);
}

TEST(MaterialChains, LayersMayBeMaterials) {
  const Chain c(kLambert + "shader \"g\" \"mib_illum_lambert\" ( \"diffuse\" 0 1 0 )\n" +
                material("\"mib_color_mix\" ( \"num\" 2, \"mode_0\" 1, \"weight_0\" .25, "
                         "\"color_0\" = \"g\", \"mode_1\" 4, \"weight_1\" 1, "
                         "\"color_1\" .5 .5 1, \"color_base\" = \"l\" )"));
  c.expect_silent();
  ASSERT_EQ(c.closure.count, 2);
  expect_rgb(c.closure.lobes[0].weight, .75f * .8f * .5f, .75f * .4f * .5f, .75f * .2f);
  expect_rgb(c.closure.lobes[1].weight, 0, .25f * .5f, 0);
  expect_rgb(c.closure.emission, .2f * .75f * .5f, .2f * .75f * .5f, .2f * .75f);
  const Chain plain(
      material("\"mib_color_mix\" ( \"num\" 1, \"mode_0\" 2, \"weight_0\" .5, "
               "\"color_0\" 1 0 0, \"color_base\" .1 .2 .3 )"));
  EXPECT_EQ(plain.closure.count, 0);
  expect_rgb(plain.closure.emission, .6f, .2f, .3f);
}

TEST(MaterialChains, MaterialsAreBlackWhereNothingCanBeTraced) {
  const ProbeScene s(probe_call("\"tint\" = \"l\"", kLambert));
  EXPECT_EQ(s.messages(), "");
  const Rgba tint = s.params().tint;
  EXPECT_EQ(tint.r + tint.g + tint.b, 0);
}

TEST(MaterialChains, LightPassesAsFarAsSomePartOfTheChainLetsIt) {
  const auto transmits = [](const std::string& call) {
    const ProbeScene s(
        kLambert +
        "shader \"t\" \"mib_transparency\" ( \"input\" = \"l\", \"transp\" .5 .5 .5 )\n"
        "shader \"m_s\" " +
        call + "\nmaterial \"m\" = \"m_s\" shadow = \"m_s\" end material");
    EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
    return s.material("m")->may_transmit;
  };
  EXPECT_TRUE(transmits("\"mib_transparency\" ( \"input\" = \"l\", \"transp\" .1 0 0 )"));
  EXPECT_FALSE(transmits("\"mib_transparency\" ( \"input\" = \"l\" )"));
  EXPECT_TRUE(transmits("\"mib_reflect\" ( \"input\" = \"t\", \"reflect\" .1 0 0 )"));
  EXPECT_FALSE(transmits("\"mib_reflect\" ( \"input\" = \"l\", \"reflect\" .1 0 0 )"));
  EXPECT_FALSE(transmits("\"mib_opacity\" ( \"input\" = \"l\", \"opacity\" 1 1 1 )"));
  EXPECT_TRUE(transmits("\"mib_opacity\" ( \"input\" = \"l\", \"opacity\" 1 1 .9 )"));
  EXPECT_TRUE(transmits("\"mib_twosided\" ( \"front\" = \"l\", \"back\" = \"t\" )"));
}

}  // namespace material_chains_test
}  // namespace oriel
