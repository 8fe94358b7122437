// SPDX-License-Identifier: Apache-2.0
// Approximations of Maya textures: coordinates and results.
#include <cmath>

#include "probe.h"

namespace oriel {
namespace host_textures_test {

/// The colour a probe's `tint` is given at texture coordinates (u, v), texels unfiltered.
Rgba tint_at(const ProbeScene& s, float u, float v) {
  ShadingPoint point;
  point.world = s.world.get();
  point.texture_spaces = 1;
  point.tex[0] = Vec3(u, v, 0);
  point.dpdu = Vec3(1, 0, 0);
  point.dpdv = Vec3(0, 1, 0);
  point.look_up = LookUp::Nearest;
  Rgba tint(0);
  const ShaderNode* node = s.node();
  EXPECT_NE(node, nullptr) << s.messages();
  if (node) node->with_params(point, [&](const Call& c) { tint = c.as<ProbeParams>().tint; });
  return tint;
}

/// Four texels: red at the lower left, green at its right, blue over it, white.
const std::string kPicture = "color texture \"pic\" [2 2 3] 'ff0000' '00ff00' '0000ff' 'ffffff'\n";

ProbeScene placed(const std::string& place, const std::string& file = {}) {
  return ProbeScene(probe_call(
      "\"tint\" = \"file1.outColor\"",
      kPicture + "shader \"place1\" \"maya_place2dtex\" ( " + place + " )\n" +
          "shader \"file1\" \"maya_file\" ( \"fileTextureName\" \"pic\", \"uvCoord\" = "
          "\"place1.outUV\", \"repeatUV\" = \"place1.repeatUV\", \"coverage\" = "
          "\"place1.coverage\", \"uvFilterSize\" = \"place1.outUvFilterSize\", \"defaultColor\" "
          ".25 .5 .75" +
          file + " )\n"));
}

std::string name_of(const Rgba& c) {
  if (c.r > .9f && c.g > .9f && c.b > .9f) return "white";
  if (c.r > .9f) return "red";
  if (c.g > .9f) return "green";
  if (c.b > .9f) return "blue";
  return std::abs(c.g - .5f) < .01f ? "outside" : "none";
}

TEST(MayaTextures, ImagesAreUprightWithUToTheRight) {
  const ProbeScene s = placed("");
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  EXPECT_EQ(name_of(tint_at(s, .25f, .25f)), "red");
  EXPECT_EQ(name_of(tint_at(s, .75f, .25f)), "green");
  EXPECT_EQ(name_of(tint_at(s, .25f, .75f)), "blue");
  EXPECT_EQ(name_of(tint_at(s, .75f, .75f)), "white");
  EXPECT_EQ(name_of(tint_at(s, 1.25f, -.75f)), "red") << "it comes again";
}

TEST(MayaTextures, PlacementTilesMirrorsMovesAndTurns) {
  const struct {
    const char *place, *lower_left, *lower_right, *upper_left;  // at .2 and .8
  } cases[] = {
      {"\"offset\" .5 0 0", "green", "red", "white"},
      {"\"offset\" 0 .5 0", "blue", "white", "red"},
      {"\"rotateUV\" 1.5707963", "green", "white", "red"},
      {"\"rotateUV\" 90.", "green", "white", "red"},
      {"\"rotateFrame\" 3.1415927", "white", "blue", "green"},
      {"\"translateFrame\" .5 0 0", "green", "red", "white"},
  };
  for (const auto& c : cases) {
    const ProbeScene s = placed(c.place);
    EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
    EXPECT_EQ(name_of(tint_at(s, .2f, .2f)), c.lower_left) << c.place;
    EXPECT_EQ(name_of(tint_at(s, .8f, .2f)), c.lower_right) << c.place;
    EXPECT_EQ(name_of(tint_at(s, .2f, .8f)), c.upper_left) << c.place;
  }
  // Two tiles along u, three along v: the file is not tiled a second time.
  const ProbeScene tiled = placed("\"repeatUV\" 2 3 0");
  EXPECT_EQ(name_of(tint_at(tiled, .1f, .05f)), "red");
  EXPECT_EQ(name_of(tint_at(tiled, .4f, .05f)), "green");
  EXPECT_EQ(name_of(tint_at(tiled, .6f, .05f)), "red");
  EXPECT_EQ(name_of(tint_at(tiled, .1f, .30f)), "blue");
  EXPECT_EQ(name_of(tint_at(tiled, .1f, .40f)), "red");
  const ProbeScene mirrored = placed("\"repeatUV\" 2 1 0, \"mirrorU\" on");
  EXPECT_EQ(name_of(tint_at(mirrored, .4f, .2f)), "green");
  EXPECT_EQ(name_of(tint_at(mirrored, .6f, .2f)), "green");
  EXPECT_EQ(name_of(tint_at(mirrored, .9f, .2f)), "red");
  const ProbeScene bricks = placed("\"repeatUV\" 1 2 0, \"stagger\" on");
  EXPECT_EQ(name_of(tint_at(bricks, .2f, .1f)), "red");
  EXPECT_EQ(name_of(tint_at(bricks, .2f, .6f)), "green");
}

TEST(MayaTextures, OutsideOfTheFrameTheDefaultColourShows) {
  const ProbeScene half = placed("\"coverage\" .5 1 0, \"wrapU\" off, \"wrapV\" off");
  EXPECT_EQ(name_of(tint_at(half, .1f, .2f)), "red");
  EXPECT_EQ(name_of(tint_at(half, .4f, .2f)), "green");
  EXPECT_EQ(name_of(tint_at(half, .6f, .2f)), "outside");
  EXPECT_EQ(name_of(tint_at(half, 1.1f, .2f)), "outside");
  const ProbeScene again = placed("\"coverage\" .5 1 0");
  EXPECT_EQ(name_of(tint_at(again, 1.1f, .2f)), "red");
  EXPECT_EQ(name_of(tint_at(again, 1.6f, .2f)), "outside");
}

TEST(MayaTextures, ValuesAreAdjustedAndAlphaIsTheirLuminance) {
  const ProbeScene s =
      placed("", ", \"invert\" on, \"colorGain\" .5 .5 .5, \"colorOffset\" .1 0 0");
  const Rgba red = tint_at(s, .2f, .2f);
  EXPECT_NEAR(red.r, .1f, 1e-5f);
  EXPECT_NEAR(red.g, .5f, 1e-5f);
  const ProbeScene alpha(
      probe_call("\"tint\" = \"file1.outAlpha\"",
                 kPicture + "shader \"file1\" \"maya_file\" ( \"fileTextureName\" \"pic\", "
                            "\"alphaIsLuminance\" on, \"alphaGain\" 2, \"alphaOffset\" .1 )\n"));
  EXPECT_NEAR(tint_at(alpha, .2f, .2f).r, 2 * .3f + .1f, 1e-5f);
  const ProbeScene one(
      probe_call("\"tint\" = \"file1.outColor.b\"",
                 kPicture + "shader \"file1\" \"maya_file\" ( \"fileTextureName\" \"pic\" )\n"));
  EXPECT_TRUE(one.diagnostics.all().empty()) << one.messages();
  EXPECT_FLOAT_EQ(tint_at(one, .2f, .8f).r, 1) << "a component of a member";
  EXPECT_NEAR(tint_at(one, .2f, .2f).r, 0, 1e-6f);
}

ProbeScene ramp(const std::string& parameters) {
  return ProbeScene(probe_call(
      "\"tint\" = \"ramp1.outColor\"",
      "shader \"ramp1\" \"maya_ramp\" ( " + parameters +
          ", \"colorEntryList\" [ { \"position\" .75, \"color\" 1 0 0 }, { \"position\" .25, "
          "\"color\" 0 1 0 }, { \"position\" 1, \"color\" 0 0 1 } ] )\n"));
}

TEST(MayaTextures, RampsRunBetweenTheirEntriesInAnyOrder) {
  const ProbeScene s = ramp("\"type\" 0, \"interpolation\" 1");
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  expect_color(tint_at(s, .9f, .1f), 0, 1, 0, 1);
  for (const float v : {.3f, .5f, .6f}) {
    const Rgba c = tint_at(s, .9f, v);
    EXPECT_NEAR(c.r, (v - .25f) * 2, 1e-5f) << v;
    EXPECT_NEAR(c.g, 1 - (v - .25f) * 2, 1e-5f) << v;
  }
  EXPECT_NEAR(tint_at(s, .9f, 1).b, 1, 1e-5f) << "the end of the tile belongs to it";
  EXPECT_NEAR(tint_at(ramp("\"type\" 1"), .5f, .1f).r, .5f, 1e-5f) << "along u";
  EXPECT_NEAR(tint_at(ramp("\"type\" 2"), .4f, .6f).r, .5f, 1e-5f) << "across";
  EXPECT_NEAR(tint_at(ramp("\"type\" 4"), .5f + std::sqrt(.125f), .5f).r, .5f, 1e-5f) << "outward";
  EXPECT_NEAR(tint_at(ramp("\"type\" 5"), .5f, .75f).r, .5f, 1e-5f) << "squares";
  EXPECT_NEAR(tint_at(ramp("\"interpolation\" 0"), 0, .7f).g, 1, 1e-5f) << "steps";
  EXPECT_NEAR(tint_at(ramp("\"interpolation\" 2"), 0, .5f).r, .25f, 1e-5f) << "slow start";
  EXPECT_NEAR(tint_at(ramp("\"interpolation\" 3"), 0, .5f).r, .75f, 1e-5f) << "slow end";
  EXPECT_NEAR(tint_at(ramp("\"interpolation\" 4"), 0, .35f).r, .104f, 1e-5f) << "3t^2 - 2t^3";
}

TEST(MayaTextures, CheckersHaveTwoByTwoFields) {
  const ProbeScene s(
      probe_call("\"tint\" = \"checker1.outColor\"",
                 "shader \"checker1\" \"maya_checker\" ( \"color1\" 1 0 0, \"color2\" 0 0 1 )\n"));
  EXPECT_EQ(name_of(tint_at(s, .2f, .2f)), "red");
  EXPECT_EQ(name_of(tint_at(s, .7f, .2f)), "blue");
  EXPECT_EQ(name_of(tint_at(s, .7f, .7f)), "red");
  const ProbeScene grey(probe_call(
      "\"tint\" = \"c.outColor\"",
      "shader \"c\" \"maya_checker\" ( \"contrast\" 0, \"color1\" 1 0 0, \"color2\" 0 0 1 )\n"));
  EXPECT_NEAR(tint_at(grey, .2f, .2f).b, .5f, 1e-5f);
}

TEST(MayaTextures, NoiseVariesAboutItsMiddle) {
  for (const char* type : {"maya_noise", "maya_fractal"}) {
    const ProbeScene s(probe_call("\"tint\" = \"n.outColor\"",
                                  "shader \"n\" \"" + std::string(type) + "\" ( )\n"));
    double sum = 0, squares = 0;
    constexpr int kN = 40;
    for (int i = 0; i < kN * kN; ++i) {
      const float x = tint_at(s, static_cast<float>(i % kN) / kN + .0123f,
                              static_cast<float>(i / kN) / kN + .0071f)
                          .r;
      EXPECT_GE(x, 0);
      EXPECT_LE(x, 1);
      sum += x;
      squares += x * x;
    }
    const double mean = sum / (kN * kN);
    EXPECT_NEAR(mean, .5, .05) << type;
    EXPECT_GT(squares / (kN * kN) - mean * mean, 1e-3) << type;
  }
}

// A ramp along u of height u x depth tilts the normal of a plate by atan(depth / width).
TEST(MayaTextures, BumpsTiltTheNormalByTheSlopeOfTheirHeight) {
  const std::string before =
      "shader \"ramp1\" \"maya_ramp\" ( \"type\" 1, \"colorEntryList\" [ { \"position\" 0, "
      "\"color\" 0 0 0 }, { \"position\" 1, \"color\" 1 1 1 } ] )\n"
      "shader \"bump1\" \"maya_bump2d\" ( \"bumpValue\" = \"ramp1.outAlpha\", \"bumpDepth\" .5 )\n";
  const ProbeScene s(probe_call("\"place\" = \"bump1.outNormal\"", before));
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  for (const bool back : {false, true}) {
    ShadingPoint point;
    point.world = s.world.get();
    point.texture_spaces = 1;
    point.tex[0] = Vec3(.4f, .6f, 0);
    point.dpdu = Vec3(2, 0, 0);
    point.dpdv = Vec3(0, 3, 0);
    // Seen from behind the normal is turned over; what comes out is the front's all the same.
    point.normal = point.geometric_normal = Vec3(0, 0, back ? -1.0f : 1.0f);
    point.back_side = back;
    Vec3 normal(0);
    s.node()->with_params(point, [&](const Call& c) { normal = c.as<ProbeParams>().place; });
    const Vec3 expected = normalize(Vec3(-.5f / 2, 0, 1));
    EXPECT_LT(length(normalize(normal) - expected), 1e-4f) << normal.x << ' ' << normal.z;
  }
}

TEST(MayaTextures, UtilityNodesMatchTheirFormulas) {
  const struct {
    const char *shader, *value;
    float r, g, b;
  } cases[] = {
      {"\"maya_reverse\" ( \"input\" .25 1 0 )", "n.output", .75f, 0, 1},
      {"\"maya_multdiv\" ( \"operation\" 1, \"input1\" .5 1 2, \"input2\" .5 2 3 )", "n.output",
       .25f, 2, 6},
      {"\"maya_multdiv\" ( \"operation\" 2, \"input1\" 1 1 2, \"input2\" 4 0 4 )", "n.output", .25f,
       0, .5f},
      {"\"maya_multdiv\" ( \"operation\" 3, \"input1\" 2 3 4, \"input2\" 3 2 .5 )", "n.output", 8,
       9, 2},
      {"\"maya_plusminusavg\" ( \"operation\" 1, \"input3D\" [ 1 2 3, .5 0 1 ] )", "n.output3D",
       1.5f, 2, 4},
      {"\"maya_plusminusavg\" ( \"operation\" 2, \"input3D\" [ 1 2 3, .5 0 1 ] )", "n.output3D",
       .5f, 2, 2},
      {"\"maya_plusminusavg\" ( \"operation\" 3, \"input1D\" [ 1, 2, 6 ] )", "n.output1D", 3, 3, 3},
      {"\"maya_blend\" ( \"blender\" .25, \"color1\" 1 0 0, \"color2\" 0 1 0 )", "n.output", .25f,
       .75f, 0},
      {"\"maya_gamma\" ( \"value\" .25 .25 .25, \"gamma\" 2 1 .5 )", "n.outValue", .5f, .25f,
       .0625f},
      {"\"maya_clamp\" ( \"input\" -1 .5 7, \"max\" 1 1 2 )", "n.output", 0, .5f, 2},
      {"\"maya_setrange\" ( \"value\" 5 0 9, \"oldMax\" 10 10 6, \"max\" 1 1 1, \"min\" 0 .5 0 )",
       "n.outValue", .5f, .5f, 1},
      {"\"maya_luminance\" ( \"value\" 0 1 0 )", "n.outValue", .59f, .59f, .59f},
      {"\"maya_condition\" ( \"firstTerm\" 2, \"secondTerm\" 1, \"operation\" 2, \"colorIfTrue\" "
       ".1 .2 .3 )",
       "n.outColor", .1f, .2f, .3f},
      {"\"maya_condition\" ( \"firstTerm\" 2, \"secondTerm\" 1, \"operation\" 4 )", "n.outColor", 1,
       1, 1},
      {"\"maya_rgb_to_color\" ( \"r\" .1, \"g\" .2, \"b\" .3 )", "n", .1f, .2f, .3f},
      {"\"maya_color_to_rgb\" ( \"color\" .1 .2 .3 )", "n.g", .2f, .2f, .2f},
      {"\"maya_samplerinfo\" ( )", "n.facingRatio", 1, 1, 1},
      {"\"maya_samplerinfo\" ( )", "n.uvCoord", .25f, .75f, 0},
  };
  for (const auto& c : cases) {
    const ProbeScene s(probe_call("\"tint\" = \"" + std::string(c.value) + "\"",
                                  "shader \"n\" " + std::string(c.shader) + "\n"));
    EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
    const Rgba t = tint_at(s, .25f, .75f);
    EXPECT_NEAR(t.r, c.r, 1e-5f) << c.shader;
    EXPECT_NEAR(t.g, c.g, 1e-5f) << c.shader;
    EXPECT_NEAR(t.b, c.b, 1e-5f) << c.shader;
  }
}

}  // namespace host_textures_test
}  // namespace oriel
