// SPDX-License-Identifier: Apache-2.0
// Approximations of 3ds Max maps: shaders/max/max_textures.cpp.
#include "cases.h"
#include "other_stages.h"

namespace oriel::effects {
namespace other_max_textures {
namespace {

using namespace other_stages;

/// Colours .2 .4 .6 and white; red next to green; two shaders and three generators.
const std::string kMaps =
    "color texture \"pic\" [1 1 3] '336699'\n"
    "color texture \"white\" [1 1 3] 'ffffff'\n"
    "color texture \"pair\" [2 1 3] 'ff000000ff00'\n"
    "shader \"a\" \"max_RGBMultiplier\" ( \"Color1\" .6 .2 .1, \"Color2\" 1 1 1 )\n"
    "shader \"b\" \"max_RGBMultiplier\" ( \"Color1\" .1 .3 .5, \"Color2\" 1 1 1 )\n"
    "shader \"quarter\" \"max_RGBMultiplier\" ( \"Color1\" .25 .25 .25, \"Color2\" 1 1 1 )\n"
    "shader \"left\" \"max_base_UVGenerator\" ( \"UOffset\" .25 )\n"
    "shader \"right\" \"max_base_UVGenerator\" ( \"UOffset\" -.25 )\n"
    "shader \"doubled\" \"max_base_Output\" ( \"RGBAmount\" 2 )\n"
    "shader \"inverse\" \"max_base_Output\" ( \"Invert\" on )\n";
const Rgb kPic(.2f, .4f, .6f), kA(.6f, .2f, .1f), kB(.1f, .3f, .5f), kRed(1, 0, 0), kGreen(0, 1, 0);
const std::string kPictured = "\"max_Bitmap\" ( \"Bitmap\" \"white\", \"Coords\" \"inner\" )";

/// Coordinates where u, or v, is .625 and the other .5 (the picture is 4 units wide for 3 high).
struct Axis {
  const char* name;
  Vec2 place;
  float at;
  Rgb coordinate(float t) const { return name[0] == 'U' ? Rgb(t, .5f, 0) : Rgb(.5f, t, 0); }
};

void add_generator(Cases& all, const std::string& shader) {
  const float top = .5f + .125f * .75f;
  for (const Axis& axis : {Axis{"U", Vec2(1, .5f), .625f}, Axis{"V", Vec2(.5f, 1), top}}) {
    const std::string name = shader + "." + axis.name;
    const Stage at = value({}, axis.place);
    const float off = axis.at - .5f;
    all.push_back(gives(name + "Offset", at, "",
                        {{"0", axis.coordinate(axis.at)},
                         {".25", axis.coordinate(axis.at - .25f)},
                         {"-.1", axis.coordinate(axis.at + .1f)}}));
    all.push_back(gives(name + "Scale", at, "",
                        {{"1", axis.coordinate(axis.at)},
                         {"3", axis.coordinate(.5f + 3 * off)},
                         {"-1", axis.coordinate(.5f - off)}}));
    // The tile and its mirrored twin in the place of one.
    all.push_back(gives(name + "Mirror", at, "",
                        {{"off", axis.coordinate(axis.at)}, {"on", axis.coordinate(1 - 2 * off)}}));
    const Stage pictured = inside(kPictured, kMaps, axis.place);
    all.push_back(both(gives(name + "Wrap", pictured, name.substr(shader.size() + 1) + "Offset -.6",
                             {{"on", Rgb(1)}, {"off", Rgb(0)}}),
                       gives(name + "Wrap", pictured, "", {{"on", Rgb(1)}, {"off", Rgb(1)}})));
  }
  all.push_back(gives(shader + ".MapChannel",
                      value(square_of_spaces(Vec3(.1f, .2f, 0), Vec3(.3f, .7f, 0))), "",
                      {{"1", Rgb(.1f, .2f, 0)}, {"2", Rgb(.3f, .7f, 0)}}));
  // A rotation about the middle; the direction is undocumented. Radians, or degrees.
  all.push_back(shows(shader + ".WAngle", [shader] {
    const auto turned = [&](const char* angle) {
      return value({}, Vec2(1, .5f))(call_of(shader, std::string("WAngle ") + angle)).mean;
    };
    for (const char* half : {"3.14159265", "180"}) EXPECT_NEAR(turned(half).x, .375f, 1e-5f);
    for (const char* quarter : {"1.57079633", "90", "-90"}) {
      EXPECT_NEAR(turned(quarter).x, .5f, 1e-5f);
      EXPECT_NEAR(std::abs(turned(quarter).y - .5f), .125f, 1e-5f);
    }
    EXPECT_NEAR(turned("90").y + turned("-90").y, 1, 1e-5f);
  }));
}

void add_bitmap(Cases& all, const std::string& shader) {
  all.push_back(
      gives(shader + ".Bitmap", value(kMaps), "", {{"\"pic\"", kPic}, {"\"white\"", Rgb(1)}}));
  all.push_back(gives(shader + ".Coords", value(kMaps), "Bitmap \"pair\"",
                      {{"\"left\"", kRed}, {"\"right\"", kGreen}}));
  all.push_back(gives(shader + ".Output", value(kMaps), "Bitmap \"pic\"",
                      {{"\"doubled\"", kPic * 2.f}, {"\"inverse\"", Rgb(1) - kPic}}));
}

void add_output(Cases& all) {
  const std::string name = "max_base_Output.";
  const Stage seen = inside("\"max_Bitmap\" ( \"Bitmap\" \"pic\", \"Output\" \"inner\" )", kMaps);
  for (const char* factor : {"RGBAmount", "OutputAmount"})
    all.push_back(
        gives(name + factor, seen, "",
              {{"0", Rgb(0)}, {"1", kPic}, {"3", kPic * 3.f}, {"= \"quarter\"", kPic * .25f}}));
  all.push_back(gives(name + "RGBOffset", seen, "",
                      {{"0", kPic}, {".5", kPic + Rgb(.5f)}, {"-.1", kPic - Rgb(.1f)}}));
  all.push_back(gives(name + "Invert", seen, "", {{"off", kPic}, {"on", Rgb(1) - kPic}}));
  all.push_back(
      gives(name + "Clamp", seen, "RGBAmount 2", {{"off", kPic * 2.f}, {"on", Rgb(.4f, .8f, 1)}}));
}

/// Colours, maps and their switches; `one` shows the first alone, `other` the second.
void add_pair(Cases& all, const std::string& shader, const Stage (&stages)[2],
              const std::string (&others)[2]) {
  for (int i = 0; i < 2; ++i) {
    const std::string number = std::to_string(i + 1), name = shader + ".";
    const Stage& seen = stages[i];
    const std::string color = others[i] + ", Color" + number + " .6 .2 .1 1";
    all.push_back(gives(name + "Color" + number, seen, others[i],
                        {{".6 .2 .1 1", kA}, {".1 .3 .5 1", kB}, {"= \"b\"", kB}}));
    all.push_back(
        gives(name + "Map" + number, seen, color, {{"\"quarter\"", Rgb(.25f)}, {"\"b\"", kB}}));
    all.push_back(gives(name + "Map" + number + "Enabled", seen,
                        color + ", Map" + number + " \"b\"", {{"on", kB}, {"off", kA}}));
  }
}

void add_pairs(Cases& all) {
  const Stage middle = value(kMaps);
  // Above and right of the middle; below and right of it.
  const Stage first = value(kMaps, Vec2(.9f, .9f)), second = value(kMaps, Vec2(.9f, .1f));
  add_pair(all, "max_Checker", {first, second}, {"", ""});
  all.push_back(gives("max_Checker.Coords", first, "Color1 1 0 0 1, Color2 0 1 0 1",
                      {{"\"right\"", kRed}, {"\"left\"", kGreen}}));
  add_pair(all, "max_Mix", {middle, middle}, {"MixAmount 0", "MixAmount 1"});
  const std::string colors = "Color1 .6 .2 .1 1, Color2 .1 .3 .5 1";
  const Rgb mixed = kA * .75f + kB * .25f;
  all.push_back(
      gives("max_Mix.MixAmount", middle, colors,
            {{"0", kA}, {".25", mixed}, {"25", mixed}, {"1", kB}, {"= \"quarter\"", mixed}}));
  all.push_back(gives("max_Mix.Mask", middle, colors + ", MixAmount 1",
                      {{"\"quarter\"", mixed}, {"\"\"", kB}}));
  add_pair(all, "max_RGBMultiplier", {middle, middle}, {"Color2 1 1 1 1", "Color1 1 1 1 1"});
  // The product, not one of the two.
  Case& map = all[all.size() - 2];
  map = both(map, gives(map.parameter, middle, "Color1 .6 .2 .1 1",
                        {{"\"b\"", kA * kB}, {"\"quarter\"", kA * .25f}}));
}

/// Seen straight ahead.
Stage around(const std::string& elements) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.statement(elements).environment(call);
    return Probe(scene.str()).ray(Vec3(0), Vec3(0, 0, -1), 64);
  };
}

void add_environment(Cases& all, const std::string& shader) {
  const Stage seen = around(kMaps);
  all.push_back(gives(shader + ".Color", seen, "",
                      {{".6 .2 .1 1", kA}, {".1 .3 .5 1", kB}, {"= \"a\"", kA}}));
  all.push_back(gives(shader + ".Map", seen, "Color 1 1 1 1, Sky \"quarter\"",
                      {{"\"a\"", kA}, {"\"b\"", kB}}));
  all.push_back(both(gives(shader + ".Sky", seen, "Color 1 1 1 1", {{"\"a\"", kA}, {"\"b\"", kB}}),
                     gives(shader + ".Sky", seen, "Map \"quarter\"",
                           {{"\"a\"", Rgb(.25f)}, {"\"\"", Rgb(.25f)}})));
}

Cases cases() {
  Cases all;
  for (const std::string name : {"max", "adsk"}) {
    add_generator(all, name + "_base_UVGenerator");
    add_bitmap(all, name == "max" ? "max_Bitmap" : "adsk_bitmap");
    add_environment(all, name == "max" ? "max_Environment" : "adsk_environment");
  }
  add_output(all);
  add_pairs(all);
  return all;
}

}  // namespace
}  // namespace other_max_textures

Cases other_max_texture_cases() { return other_max_textures::cases(); }

}  // namespace oriel::effects
