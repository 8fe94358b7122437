// SPDX-License-Identifier: Apache-2.0
// Results of base library nodes, as documented.
#include <fmt/format.h>

#include <cmath>

#include "probe.h"
#include "runtime/texture_node.h"
#include "support/expect_near.h"

namespace oriel {
namespace base_values_test {

using testing::expect_near;

/// One call of a shader, evaluated at a point.
struct Node {
  ProbeScene scene;
  ShadingPoint point;

  Node(std::string_view shader, std::string_view arguments, std::string_view before = {})
      : scene(fmt::format("{}\nmaterial \"m\" \"{}\" ( {} ) end material", before, shader,
                          arguments)) {
    EXPECT_TRUE(scene.diagnostics.all().empty()) << scene.messages();
    point.world = scene.world.get();
  }
  Rgba color() { return scene.node()->color(point); }
  template <class T>
  T raw() {
    alignas(16) std::byte bytes[kMaxParamBytes];
    scene.node()->value(point, bytes);
    return *reinterpret_cast<const T*>(bytes);
  }
};

Rgba color_of(std::string_view shader, std::string_view arguments, std::string_view before = {}) {
  return Node(shader, arguments, before).color();
}

TEST(BaseColors, GreysAreCopiedToAllChannels) {
  const std::string in = "\"input\" .2 .4 .9 .3, \"factor\" 2";
  expect_near(color_of("mib_color_alpha", in), Rgba(.6f));
  expect_near(color_of("mib_color_average", in), Rgba(1));
  expect_near(color_of("mib_color_intensity", in),
              Rgba(2 * (.299f * .2f + .587f * .4f + .114f * .9f)));
  for (const char* shader : {"mib_color_alpha", "mib_color_average", "mib_color_intensity"})
    expect_near(color_of(shader, "\"input\" 1 1 1 1"), Rgba(0));
}

TEST(BaseColors, InterpolateBlendsNeighbours) {
  const auto at = [](float x) {
    return color_of("mib_color_interpolate",
                    fmt::format("\"input\" {}, \"num\" 3, \"weight_1\" .25, \"color_0\" 0 0 0 0, "
                                "\"color_1\" 1 0 0 1, \"color_2\" 1 1 0 1, \"color_3\" 0 0 1 1",
                                x));
  };
  expect_near(at(-1), Rgba(0));
  expect_near(at(.125f), Rgba(.5f, 0, 0, .5f));
  expect_near(at(.25f), Rgba(1, 0, 0, 1));
  expect_near(at(.625f), Rgba(1, .5f, 0, 1));
  expect_near(at(2), Rgba(1, 1, 0, 1));
  expect_near(color_of("mib_color_interpolate", "\"num\" 1, \"color_0\" .1 .2 .3 .4"),
              Rgba(.1f, .2f, .3f, .4f));
  expect_near(color_of("mib_color_interpolate",
                       "\"input\" .9, \"num\" 8, \"weight_6\" .8, \"color_6\" 1 0 0 1, "
                       "\"color_7\" 0 0 1 1"),
              Rgba(.5f, 0, .5f, 1));
}

TEST(BaseColors, MixFollowsItsModes) {
  const auto over = [](int mode, float weight, const char* layer = ".8 .2 .6 .5") {
    return color_of("mib_color_mix",
                    fmt::format("\"num\" 1, \"mode_0\" {}, \"weight_0\" {}, \"color_0\" {}, "
                                "\"color_base\" .5 1 .1 1",
                                mode, weight, layer));
  };
  // Blend: base x (1 - alpha x weight) + layer x weight.
  expect_near(over(0, .5f), Rgba(.5f * .75f + .4f, .75f + .1f, .1f * .75f + .3f, .75f + .25f));
  expect_near(over(1, .5f), Rgba(.65f, .6f, .35f, .75f));
  expect_near(over(2, 1), Rgba(1.3f, 1.2f, .7f, 1.5f));
  expect_near(over(3, 1), Rgba(1, 1, .7f, 1));
  expect_near(over(4, 2), Rgba(.8f, .4f, .12f, 1));
  expect_near(over(5, 4, "1 1 1 1"), Rgba(1, 1, .4f, 1));
  expect_near(over(6, 1), Rgba(.5f, 1, .1f, .5f));
  // A layer of weight 0 leaves what lies below.
  for (const int mode : {0, 1, 2, 3}) expect_near(over(mode, 0), Rgba(.5f, 1, .1f, 1));
}

TEST(BaseColors, MixLaysUpToEightOverATransparentBase) {
  std::string layers = "\"num\" 8";
  for (int i = 0; i < 8; ++i)
    layers += fmt::format(", \"mode_{0}\" 2, \"weight_{0}\" .5, \"color_{0}\" {1} 0 0 .1", i, i);
  expect_near(color_of("mib_color_mix", layers), Rgba(14, 0, 0, .4f));
  expect_near(color_of("mib_color_mix", "\"num\" 0, \"color_0\" 1 1 1 1"), Rgba(0));
}

TEST(BaseColors, SpreadSplitsAColour) {
  const std::string spread =
      "shader \"s\" \"mib_color_spread\" ( \"input\" .2 .4 .9 .3, \"num\" 5, \"mode_1\" 1, "
      "\"mode_2\" 2, \"mode_3\" 3, \"mode_4\" 4, \"weight_0\" 1 .5 1 1, \"weight_1\" 2 2 2 2, "
      "\"weight_2\" 1 1 1 1, \"weight_3\" 1 1 1 1, \"weight_4\" 1 0 0 1, \"weight_5\" 1 1 1 1 )";
  const Rgba wanted[] = {
      Rgba(.2f, .2f, .9f, .3f), Rgba(.6f), Rgba(.5f), Rgba(.299f * .2f + .587f * .4f + .114f * .9f),
      Rgba(.2f, 0, 0, .2f),     Rgba(0)};
  for (int i = 0; i < 6; ++i) {
    const ProbeScene s(probe_call(fmt::format("\"tint\" = \"s.out_{}\"", i), spread));
    EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
    expect_near(s.params().tint, wanted[i]);
  }
}

TEST(BaseColors, TemperaturesHaveTheRequestedLuminance) {
  for (const char* shader : {"mib_cie_d", "mib_blackbody"}) {
    const auto at = [&](float kelvin) {
      return color_of(shader, fmt::format("\"temperature\" {}, \"intensity\" 2", kelvin));
    };
    for (const float kelvin : {4500.f, 6500.f, 15000.f}) {
      const Rgba c = at(kelvin);
      EXPECT_NEAR(.2126f * c.r + .7152f * c.g + .0722f * c.b, 2, 1e-3) << shader << kelvin;
      EXPECT_EQ(c.a, 1);
    }
    EXPECT_GT(at(4500).r, at(6500).r);
    EXPECT_GT(at(15000).b, at(6500).b);
  }
  // CIE D65 is the white of the pixels.
  expect_near(color_of("mib_cie_d", "\"temperature\" 6504, \"intensity\" 1"), Rgba(1), .005f);
  // A connected temperature differs from the one the colour was precomputed for.
  const Rgba warm = color_of("mib_blackbody", "\"temperature\" = \"t\", \"intensity\" 1",
                             "shader \"t\" \"probe_scalar\" ( \"amount\" 2800 )");
  expect_near(warm, color_of("mib_blackbody", "\"temperature\" 2800, \"intensity\" 1"));
}

TEST(BasePatterns, CheckerboardHasEightBoxesByTheirDigits) {
  std::string colors;
  for (int i = 0; i < 8; ++i)
    colors += fmt::format(", \"color{}{}{}\" {} 0 0 1", i >> 2 & 1, i >> 1 & 1, i & 1, i + 1);
  for (int i = 0; i < 8; ++i) {
    const auto box = [&](float shift) {
      return color_of("mib_texture_checkerboard",
                      fmt::format("\"xsize\" .25, \"ysize\" .5, \"zsize\" .75, "
                                  "\"coord\" {} {} {}{}",
                                  (i & 4 ? .3f : .2f) + shift, (i & 2 ? .6f : .4f) - shift,
                                  i & 1 ? .8f : .7f, colors));
    };
    EXPECT_EQ(box(0).r, static_cast<float>(i + 1));
    EXPECT_EQ(box(3).r, static_cast<float>(i + 1)) << "it repeats";
  }
}

TEST(BasePatterns, DotsLieInTheMiddleOfTheirCells) {
  const auto dot_at = [](const char* shader, float x, float y, float z) {
    return color_of(shader, fmt::format("\"coord\" {} {} {}, \"radius\" .3, \"fgcolor\" 1 0 0 1, "
                                        "\"bgcolor\" 0 0 1 1",
                                        x, y, z))
        .r;
  };
  for (const char* shader : {"mib_texture_polkadot", "mib_texture_polkasphere"}) {
    EXPECT_EQ(dot_at(shader, .5f, .79f, .5f), 1);
    EXPECT_EQ(dot_at(shader, .5f, .81f, .5f), 0);
    EXPECT_EQ(dot_at(shader, -2.5f, 7.5f, 3.5f), 1);
    EXPECT_EQ(dot_at(shader, 0, 0, .5f), 0);
  }
  EXPECT_EQ(dot_at("mib_texture_polkadot", .5f, .5f, .9f), 1);
  EXPECT_EQ(dot_at("mib_texture_polkasphere", .5f, .5f, .9f), 0);
}

TEST(BasePatterns, WaveIsASumOfCosines) {
  expect_near(color_of("mib_texture_wave",
                       "\"coord\" 0 .25 3.5, \"amplitude_x\" 1, \"amplitude_y\" 10, "
                       "\"amplitude_z\" 100, \"offset\" .5"),
              Rgba(1 - 100 + .5f), 1e-4f);
}

TEST(BasePatterns, TurbulenceTakesZeroAsItsDefaults) {
  const auto at = [](const std::string& more) {
    return Node("mib_texture_turbulence", "\"coord\" .37 1.21 2.6" + more).raw<float>();
  };
  const float plain = at("");
  EXPECT_GT(plain, 0);
  EXPECT_EQ(plain, at(", \"spacing\" 1, \"strength\" 1, \"power\" 1, \"iteration\" 2"));
  EXPECT_FLOAT_EQ(at(", \"strength\" 3"), 3 * plain);
  EXPECT_NE(at(", \"spacing\" 2"), plain);
  EXPECT_NE(at(", \"power\" 2"), plain);
  EXPECT_GT(at(", \"iteration\" 8"), plain);
  EXPECT_EQ(at(", \"iteration\" 30"), at(", \"iteration\" 8"));
  EXPECT_NE(at(", \"polar_dim\" 1"), plain);
  EXPECT_NE(at(", \"polar_dim\" 2"), at(", \"polar_dim\" 1"));
}

// 4 x 4 texels, red grows to the right in steps of 1/5, green upward.
const std::string kRamp = [] {
  std::string text = "color texture \"t\" [4 4 3]";
  for (int y = 0; y < 4; ++y) {
    text += " '";
    for (int x = 0; x < 4; ++x) text += fmt::format("{:02x}{:02x}00", 51 * x, 51 * y);
    text += "'";
  }
  return text;
}();

TEST(BaseLookups, Lookup2ScalesTheFirstSpaceAndRepeats) {
  const auto at = [](const char* more, float u, float v) {
    Node node("mib_texture_lookup2", fmt::format("\"tex\" \"t\"{}", more), kRamp);
    node.point.texture_spaces = 1;
    node.point.tex[0] = Vec3(u, v, 0);
    return node.color();
  };
  expect_near(at("", .625f, .125f), Rgba(.4f, 0, 0, 1), 1e-3f);
  expect_near(at(", \"factor\" 2", .5f * 1.625f, .5f * 2.375f), Rgba(.4f, .2f, 0, 1), 1e-3f);
}

// 8 x 8 texels, red on the right half, green in the upper one.
const std::string kQuarters = [] {
  std::string text = "color texture \"t\" [8 8 3]";
  for (int y = 0; y < 8; ++y) {
    text += " '";
    for (int x = 0; x < 8; ++x)
      text += fmt::format("{}{}00", x < 4 ? "00" : "ff", y < 4 ? "00" : "ff");
    text += "'";
  }
  return text;
}();

TEST(BaseLookups, FilterLookupBlursAlongTheFootprint) {
  const auto at = [](const char* more, const Vec3& dpdx, const Vec3& dpdy,
                     const char* before = "") {
    Node node("mib_texture_filter_lookup",
              fmt::format("\"tex\" \"t\", \"coord\" .375 .375 0{}", more), kQuarters + before);
    node.point.texture_spaces = 1;
    node.point.tex[0] = Vec3(.375f, .375f, 0);
    node.point.dpdu = Vec3(1, 0, 0);
    node.point.dpdv = Vec3(0, 1, 0);
    node.point.dpdx = dpdx;
    node.point.dpdy = dpdy;
    return node.color();
  };
  const Vec3 narrow(.01f, 0, 0), thin(0, .01f, 0), wide(.8f, 0, 0);
  expect_near(at("", narrow, thin), Rgba(0, 0, 0, 1), 1e-3f);
  // Wide along u: red comes in from the right, green stays.
  const Rgba along = at("", wide, thin);
  EXPECT_GT(along.r, .1f);
  EXPECT_LT(along.g, .02f);
  EXPECT_LT(at(", \"disc_r\" .05", wide, thin).r, .5f * along.r);
  // Limited to a circle it blurs upward as well.
  EXPECT_GT(at(", \"eccmax\" 1", wide, thin).g, .1f);
  // A remap shader that scales its input down scales the footprint down.
  const Rgba remapped = at(", \"remap\" \"r\"", wide, thin,
                           "\nshader \"c\" \"mib_texture_vector\" ( \"select\" 0 )\nshader \"r\" "
                           "\"mib_texture_remap\" ( \"input\" = \"c\", \"max\" .01 .01 .01 )");
  EXPECT_LT(remapped.r, .02f);
}

TEST(BaseLookups, TheFilterGoesByTheCoordinate) {
  // Coordinates in hundredths of the picture, as of a wall in centimetres.
  const auto at = [](float width, const char* remap) {
    Node node(
        "mib_texture_lookup", "\"tex\" \"t\", \"coord\" = \"r\"",
        kQuarters + fmt::format("\nshader \"c\" \"mib_texture_vector\" ( \"select\" 0 )\n"
                                "shader \"r\" \"mib_texture_remap\" ( \"input\" = \"c\", {} )",
                                remap));
    node.point.texture_spaces = 1;
    node.point.tex[0] = Vec3(37.5f, 37.5f, 0);
    node.point.dpdu = Vec3(1, 0, 0);
    node.point.dpdv = Vec3(0, 1, 0);
    node.point.dpdx = Vec3(width, 0, 0);
    node.point.dpdy = Vec3(0, .01f, 0);
    return node.color();
  };
  for (const char* remap :
       {"\"max\" .01 .01 .01", "\"transform\" .01 0 0 0 0 .01 0 0 0 0 1 0 0 0 0 1",
        "\"max\" .01 .01 .01, \"torus_x\" on"}) {
    EXPECT_LT(at(.8f, remap).r, .02f) << remap;
    const bool repeats = std::string(remap).ends_with("on");
    EXPECT_EQ(at(80, remap).r > .1f, !repeats) << remap;
  }
}

TEST(BaseLookups, FilterLookupWithoutInterpolationShowsTexels) {
  const auto at = [](const char* bilinear) {
    return color_of("mib_texture_filter_lookup",
                    fmt::format("\"tex\" \"t\", \"coord\" .48 .1 0, \"bilinear\" {}", bilinear),
                    kRamp);
  };
  EXPECT_NEAR(at("off").r, .2f, 1e-3f);
  EXPECT_GT(at("on").r, .25f);
}

struct Ratio {
  float ior;
  bool enter;
};

TEST(BaseRays, RefractionIndexIsTheRatioTheRayMeets) {
  Node node("mib_refraction_index", "\"mtl_ior\" 1.5");
  EXPECT_FLOAT_EQ(node.raw<Ratio>().ior, 1.5f);
  EXPECT_TRUE(node.raw<Ratio>().enter);
  node.point.back_side = true;
  EXPECT_FLOAT_EQ(node.raw<Ratio>().ior, 1 / 1.5f);
  EXPECT_FALSE(node.raw<Ratio>().enter);
  EXPECT_EQ(Node("mib_refraction_index", "").raw<Ratio>().ior, 1);
}

struct Tangents {
  Vec3 u, v;
};

TEST(BaseLookups, RotateTurnsAnOrthonormalPairAboutTheNormal) {
  const auto turned = [](const char* more) {
    Node node("mib_texture_rotate", more);
    node.point.dpdu = Vec3(2, 0, 0);
    node.point.dpdv = Vec3(0, 1, 0);
    return node.raw<Tangents>();
  };
  const auto is = [](const Vec3& v, const Vec3& wanted) { return length(v - wanted) < 1e-5f; };
  const Vec3 x(1, 0, 0), y(0, 1, 0);
  EXPECT_TRUE(is(turned("\"angle\" 0").u, x));
  EXPECT_TRUE(is(turned("\"angle\" 1").u, y)) << "a quarter turn by default";
  EXPECT_TRUE(is(turned("\"angle\" .5, \"max\" 1").u, -x));
  EXPECT_TRUE(is(turned("\"angle\" 0, \"min\" .25, \"max\" .5").u, y));
  EXPECT_TRUE(is(turned("\"angle\" 0, \"input\" 0 3 0").u, y));
  const Tangents t = turned("\"angle\" .3, \"input\" 1 1 5");
  EXPECT_NEAR(length(t.u), 1, 1e-5);
  EXPECT_NEAR(dot(t.u, t.v), 0, 1e-5);
  EXPECT_TRUE(is(cross(t.u, t.v), Vec3(0, 0, 1)));
}

/// Six faces of one colour each, in the order -x, x, -y, y, -z, z from the top down.
const std::string kStrip =
    "color texture \"t\" [1 6 3] '0000ff' '00ff00' '00ffff' 'ff0000' 'ff00ff' 'ffff00'";

Rgba looking(Node& node, const Vec3& direction, const Vec3& origin = Vec3(0)) {
  node.point.environment = true;
  node.point.ray_origin = origin;
  node.point.ray_direction = normalize(direction);
  return node.color();
}

TEST(BaseLookups, Cube1StacksItsFacesFromTheTop) {
  Node node("mib_lookup_cube1", "\"tex\" \"t\"", kStrip);
  // Rows of pixels in a scene begin at the bottom.
  const Rgba faces[] = {Rgba(1, 1, 0, 1), Rgba(1, 0, 1, 1), Rgba(1, 0, 0, 1),
                        Rgba(0, 1, 1, 1), Rgba(0, 1, 0, 1), Rgba(0, 0, 1, 1)};
  const Vec3 ways[] = {{-1, .4f, .3f}, {1, 0, 0},      {.2f, -1, 0},
                       {0, 1, -.9f},   {.5f, .9f, -1}, {0, -.9f, 1}};
  for (int i = 0; i < 6; ++i) expect_near(looking(node, ways[i]), faces[i], 1e-3f);
}

TEST(BaseLookups, Cube6ShowsItsFacesUprightFromInside) {
  // Each face is the ramp: red to the right, green upward.
  const std::string faces =
      "\"tex_mx\" \"t\", \"tex_px\" \"t\", \"tex_my\" \"t\", \"tex_py\" \"t\", \"tex_mz\" \"t\", "
      "\"tex_pz\" \"t\"";
  Node node("mib_lookup_cube6", faces, kRamp);
  const Rgba right(.4f, .3f, 0, 1);
  // Looking level at each wall, a quarter of a face to the right.
  expect_near(looking(node, Vec3(.25f, 0, -1)), right, 1e-3f);
  expect_near(looking(node, Vec3(1, 0, .25f)), right, 1e-3f);
  expect_near(looking(node, Vec3(-.25f, 0, 1)), right, 1e-3f);
  expect_near(looking(node, Vec3(-1, 0, -.25f)), right, 1e-3f);
  for (const Vec3& d : {Vec3(0, .25f, -1), Vec3(1, .25f, 0), Vec3(0, .25f, 1), Vec3(-1, .25f, 0),
                        Vec3(0, 1, .25f), Vec3(0, -1, -.25f)})
    expect_near(looking(node, d), Rgba(.3f, .4f, 0, 1), 1e-3f);
  Node dark("mib_lookup_cube6", "\"tex_px\" \"t\"", kRamp);
  expect_near(looking(dark, Vec3(-1, 0, 0)), Rgba(0));
  Node fixed("mib_lookup_cube6", "\"tex_px\" \"t\", \"dir\" 1 0 .25", kRamp);
  expect_near(looking(fixed, Vec3(-1, 0, 0)), right, 1e-3f);
}

TEST(BaseLookups, CubesOfASizeAreSeenFromWhereTheRayStarts) {
  const std::string face = "\"tex_mz\" \"t\", ";
  Node node("mib_lookup_cube6", face + "\"point\" 1 0 0, \"size\" 4 4 4", kRamp);
  // From x = 2 straight ahead the wall is met at 1 of 2 to the right of its middle.
  expect_near(looking(node, Vec3(0, 0, -1), Vec3(2, 0, 0)), Rgba(.5f, .3f, 0, 1), 1e-3f);
  Node far("mib_lookup_cube6", face, kRamp);
  expect_near(looking(far, Vec3(0, 0, -1), Vec3(2, 0, 0)), Rgba(.3f, .3f, 0, 1), 1e-3f);
}

TEST(BaseLookups, CylinderRunsFromXTowardsYWithoutCaps) {
  const auto on = [](const char* more, const Vec3& d) {
    Node node("mib_lookup_cylindrical", fmt::format("\"tex\" \"t\"{}", more), kRamp);
    return looking(node, d);
  };
  // Texel centres lie at an eighth, three eighths, ...
  const float eighth = kTwoPi / 8;
  for (int i = 0; i < 4; ++i) {
    const float a = static_cast<float>(2 * i + 1) * eighth;
    expect_near(on("", Vec3(std::cos(a), std::sin(a), .25f)),
                Rgba(.2f * static_cast<float>(i), .4f, 0, 1), 1e-3f);
  }
  expect_near(on("", Vec3(.1f, 0, 1)), Rgba(0));
  // Only the quarter from x to y.
  const char* quarter = ", \"begin\" 0, \"end\" 1.5707963";
  EXPECT_EQ(on(quarter, Vec3(1, 1, 0)).a, 1);
  EXPECT_EQ(on(quarter, Vec3(-1, 1, 0)).a, 0);
  // Twice as tall in the world.
  const char* tall = ", \"xform\" 1 0 0 0 0 1 0 0 0 0 .5 0 0 0 0 1";
  EXPECT_EQ(on("", Vec3(1, 0, 1.5f)).a, 0);
  EXPECT_EQ(on(tall, Vec3(1, 0, 1.5f)).a, 1);
}

}  // namespace base_values_test
}  // namespace oriel
