// SPDX-License-Identifier: Apache-2.0
// Texture coordinates and look-ups: shaders/base/mib_texture.cpp, mib_texture_filter.cpp.
#include <fmt/format.h>

#include "base_stages.h"
#include "cases.h"

namespace oriel::effects {
namespace base_texture {

constexpr float kHalf = .70710678f;  // cosine of 45 degrees

/// A place in the picture of value(), and the texture coordinate of the surface there.
constexpr Vec2 kPlace(.7f, .3f), kUv(.55f, .4625f);

/// Radiance where the call is evaluated at the world point (.8, .4, 1.125), which is (.3, .15, 1)
/// in object space and (.9, .6, 1.425) in camera space.
Measured in_spaces(const std::string& call) {
  SceneText scene;
  scene.statement(shown_as_light(call))
      .polygon("m", {Vec3(-5, -5, 1), Vec3(5, -5, 1), Vec3(5, 5, 1), Vec3(-5, 5, 1)},
               "transform 1 0 0 0 0 1 0 0 0 0 1 0 -.5 -.25 -.125 1")
      .camera("focal 1 aperture 1 aspect 1 resolution 32 32", "1 0 0 0 0 1 0 0 0 0 1 0 .1 .2 .3 1");
  return Probe(scene.str(), known_shaders()).ray(Vec3(0), Vec3(.8f, .4f, 1.125f), 64);
}

/// Spherical coordinates: a quarter turn about y changes u by .25, 45 degrees of elevation add .25
/// to v.
void expect_sphere() {
  const auto at = [](const Vec3& direction) {
    return inside_cube(direction)(call_of("mib_texture_vector", "select -4, project 4")).mean;
  };
  const Rgb ahead = at(Vec3(0, 0, 1)), aside = at(Vec3(1, 0, 0)), above = at(Vec3(0, 1, 1));
  EXPECT_NEAR(std::abs(aside.x - ahead.x), .25f, 1e-5f);
  EXPECT_NEAR(aside.y, ahead.y, 1e-5f);
  EXPECT_NEAR(above.x, ahead.x, 1e-5f);
  EXPECT_NEAR(above.y - ahead.y, .25f, 1e-5f);
}

void add_vector(Cases& all) {
  const std::string name = "mib_texture_vector.";
  const Vec3 way = normalize(Vec3(.5f, .25f, 1));
  // The point is (1, .75, -5). A texture space that does not exist gives the point.
  const Stage here = value({}, Vec2(.7f, .7f));
  const Vec3 point(1, .75f, 0);
  const Vec3 ray = point * (1 / length(Vec3(1, .75f, -5)));
  all.push_back(gives(
      name + "select", here, "project 1",
      {{"0", Vec3(.55f, .5375f, 0)}, {"1", point}, {"-1", point}, {"-2", Vec3(0)}, {"-4", ray}}));
  all.back() = both(all.back(), gives(name + "select", inside_cube(way), "project 1",
                                      {{"-1", Vec3(1, .5f, 0)}, {"-10", way}}));
  all.push_back(gives(
      name + "selspace", in_spaces, "select -1",
      {{"1", Vec3(.3f, .15f, 1)}, {"2", Vec3(.8f, .4f, 1.125f)}, {"3", Vec3(.9f, .6f, 1.425f)}}));
  // Screen space ignores `select` and `project`.
  all.back() =
      both(all.back(), gives(name + "selspace", value({}, kPlace), "select 0, project 2",
                             {{"4", Vec3(kPlace.x, kPlace.y, 0)}, {"0", Vec3(kUv.x, 0, 0)}}));
  all.push_back(both(gives(name + "project", inside_cube(way), "select -1",
                           {{"0", Vec3(1, .5f, 2)},
                            {"1", Vec3(1, .5f, 0)},
                            {"2", Vec3(1, 2, 0)},
                            {"3", Vec3(.5f, 2, 0)}}),
                     shows(name + "project", expect_sphere)));
}

void add_remap(Cases& all) {
  const std::string name = "mib_texture_remap.";
  const Vec3 in(.3f, .6f, .9f);
  const std::string input = "input .3 .6 .9";
  all.push_back(
      gives(name + "input", value(), "", {{".3 .6 .9", in}, {"1 .5 0", Vec3(1, .5f, 0)}}));
  all.back() = both(all.back(),
                    gives(name + "input", value("shader \"uv\" \"mib_texture_vector\" ( )", kPlace),
                          "", {{"= \"uv\"", Vec3(kUv.x, kUv.y, 0)}, {"0 0 0", Vec3(0)}}));
  all.push_back(gives(name + "transform", value(), input,
                      {{"2 0 0 0 0 1 0 0 0 0 1 0 .5 .25 .125 1", Vec3(1.1f, .85f, 1.025f)},
                       {"2 0 0 0 0 1 0 0 0 0 1 0 .5 .25 .125 0", in}}));
  // 0 means 1. Coordinates outside 0..1 are not repeated.
  all.push_back(
      both(gives(name + "repeat", value(), input,
                 {{"0 0 0", in}, {"4 3 2", Vec3(.2f, .8f, .8f)}, {"2 1 0", Vec3(.6f, .6f, .9f)}}),
           gives(name + "repeat", value(), "input 1.5 2.5 .375",
                 {{"2 2 2", Vec3(1.5f, 2.5f, .75f)}, {"1 1 4", Vec3(1.5f, 2.5f, .5f)}})));
  for (int k = 0; k < 3; ++k) {
    // Only the second of two copies is mirrored.
    const Vec3 second(.4f, .6f, .8f), first(.2f, .4f, .6f);
    const std::string alternate = fmt::format("{}alt_{}", name, kAxes[k]);
    all.push_back(both(gives(alternate, value(), "input .7 .8 .9, repeat 2 2 2",
                             {{"off", second}, {"on", with_axis(second, k, 1 - second[k])}}),
                       gives(alternate, value(), "input .1 .2 .3, repeat 2 2 2",
                             {{"off", first}, {"on", first}})));
    const Vec3 far(1.3f, 2.6f, 3.9f);
    all.push_back(gives(fmt::format("{}torus_{}", name, kAxes[k]), value(), "input 1.3 2.6 3.9",
                        {{"off", far}, {"on", with_axis(far, k, far[k] - std::floor(far[k]))}}));
  }
  // A crop maps 0..1 to min..max.
  all.push_back(gives(name + "min", value(), input + ", max 1 1 .5",
                      {{"0 0 0", Vec3(.3f, .6f, .45f)}, {".5 .25 .5", Vec3(.65f, .7f, .9f)}}));
  all.push_back(gives(name + "max", value(), input + ", min .25 .5 0",
                      {{".25 1 1", Vec3(.3f, .8f, .9f)}, {"1 2 .5", Vec3(.475f, 1.4f, .45f)}}));
  // The end of one copy joins the start of the next.
  all.back() = both(all.back(),
                    gives(name + "max", value(), "input .499 .501 0, repeat 2 2 0",
                          {{".5 .5 1", Vec3(.499f, .001f, 0)}, {"1 1 1", Vec3(.998f, .002f, 0)}}));
  all.push_back(gives(name + "offset", value(), "input 1.3 .6 .9, torus_x on",
                      {{"0 0 0", in}, {"2 1 .5", Vec3(2.3f, 1.6f, 1.4f)}}));
}

/// The parameters `tex` and `coord`, which several shaders have.
void add_tex(Cases& all, const std::string& shader, const std::string& others) {
  const std::string procedural = "color texture \"p\" \"mib_texture_wave\" ( \"offset\" .7 )";
  all.push_back(gives(shader + ".tex", value(kPlainTextures + procedural), others,
                      {{"\"a\"", kColorA}, {"\"b\"", kColorB}, {"\"p\"", Rgb(.7f)}}));
}
void add_coord(Cases& all, const std::string& shader, const std::string& others) {
  const std::string uv = "shader \"uv\" \"mib_texture_vector\" ( )";
  all.push_back(gives(shader + ".coord", value(kRampTexture + uv, kPlace), "tex \"t\"" + others,
                      {{".125 .875 0", ramp_color(.125f, .875f)},
                       {".625 .25 0", ramp_color(.625f, .25f)},
                       {"1.25 .5 0", Rgb(0)},
                       {".5 -.25 0", Rgb(0)},
                       {"= \"uv\"", ramp_color(kUv.x, kUv.y)}}));
}

/// Texture "t" of 256 x 8 texels: white where `white` holds, else black.
std::string halves(const std::function<bool(int x, int y)>& white) {
  return texels("t", 256, 8, [&](int x, int y) { return white(x, y) ? "ffffff" : "000000"; });
}

void add_filter(Cases& all) {
  const std::string name = "mib_texture_filter_lookup.";
  add_tex(all, "mib_texture_filter_lookup", "coord .5 .5 0");
  add_coord(all, "mib_texture_filter_lookup", ", bilinear on");
  all.push_back(gives(name + "bilinear", value(kRampTexture), "tex \"t\", coord .55 .4625 0",
                      {{"off", Rgb(.4f, .2f, 0)}, {"on", ramp_color(.55f, .4625f)}}));
  // A pixel is 4 texels wide. The look-up is 2 texels left of the white half: a larger disc
  // overlaps more of it.
  const std::string beside = "tex \"t\", coord .4921875 .5 0, bilinear on";
  const Stage edge = value(halves([](int x, int) { return x >= 128; }));
  all.push_back(
      both(rises(name + "disc_r", edge, beside, {"1", "2", "4"}),
           scales(name + "disc_r", edge, beside + ", coord .498046875 .5 0", "0", ".3", 1)));
  // The footprint is long in u. A lower limit of eccentricity makes it longer in v, so that it
  // overlaps the white upper half.
  all.push_back(falls(name + "eccmax", value(halves([](int, int y) { return y >= 4; })),
                      "tex \"t\", coord .5 .4375 0, bilinear on, disc_r 1", {"1", "2", "16"}));
  // A remap by 8 makes the footprint 8 times as large.
  const std::string remaps =
      "shader \"uv\" \"mib_texture_vector\" ( )\n"
      "shader \"one\" \"mib_texture_remap\" ( \"input\" = \"uv\" )\n"
      "shader \"eight\" \"mib_texture_remap\" ( \"input\" = \"uv\", \"transform\" 8 0 0 0 0 8 0 0 "
      "0 0 1 0 0 0 0 1 )\n";
  all.push_back(rises(name + "remap", value(remaps + halves([](int x, int) { return x >= 128; })),
                      beside, {"\"one\"", "\"eight\""}));
}

void add_rotate(Cases& all) {
  const std::string name = "mib_texture_rotate.";
  const Stage u = member("u"), v = member("v");
  const Vec3 x(1, 0, 0), y(0, 1, 0), between(kHalf, kHalf, 0);
  all.push_back(
      gives(name + "input", u, "angle 0", {{"0 0 0", x}, {"0 3 0", y}, {"1 1 5", between}}));
  all.back() = both(all.back(), gives(name + "input", v, "angle 0", {{"0 0 0", y}, {"0 -2 0", x}}));
  const std::string eighth = "min .0, max .125";
  all.push_back(gives(name + "angle", u, eighth, {{"0", x}, {"1", between}, {"2", y}}));
  all.push_back(
      gives(name + "min", u, "angle 0, max .5", {{"0", x}, {".125", between}, {".25", y}}));
  all.push_back(gives(name + "max", u, "angle 1", {{".125", between}, {".25", y}, {"1", x}}));
}

Cases cases() {
  Cases all;
  add_vector(all);
  add_remap(all);
  add_tex(all, "mib_texture_lookup", "coord .5 .5 0");
  add_coord(all, "mib_texture_lookup", "");
  add_tex(all, "mib_texture_lookup2", "");
  all.push_back(both(gives("mib_texture_lookup2.factor", value(kRampTexture, kPlace), "tex \"t\"",
                           {{"0", ramp_color(kUv.x, kUv.y)},
                            {"1", ramp_color(kUv.x, kUv.y)},
                            {".5", ramp_color(kUv.x / 2, kUv.y / 2)},
                            {"3", ramp_color(3 * kUv.x - 1, 3 * kUv.y - 1)}}),
                     shows("mib_texture_lookup2.factor", [] {
                       // Stripes of 8 texels, of which a pixel covers 64 at that factor.
                       const Stage stripes =
                           value(halves([](int x, int) { return x / 8 % 2 == 1; }), kPlace);
                       const std::string call = "tex \"t\", factor 16";
                       EXPECT_NEAR(stripes(call_of("mib_texture_lookup2", call)).mean.x, .5f, .1f);
                     })));
  add_filter(all);
  add_rotate(all);
  return all;
}

}  // namespace base_texture

Cases base_texture_cases() { return base_texture::cases(); }

}  // namespace oriel::effects
