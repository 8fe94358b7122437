// SPDX-License-Identifier: Apache-2.0
// Procedural textures: shaders/oriel/oriel_noise.cpp, oriel_wave.cpp, oriel_voronoi.cpp,
// oriel_brick.cpp.
#include <algorithm>

#include "cases.h"

namespace oriel::effects {
namespace oriel_textures {
namespace {

/// Values of a parameter, with those of the others.
struct TextureRow {
  const char* parameter;
  const char* others;
  std::vector<Given> values;
};

// The results are those of the texture nodes of Blender 3.4, rendered by Cycles in single
// precision.
constexpr float kCyclesError = 5e-5f;
std::vector<TextureRow> noise_rows() {
  return {
      {"coord", "octaves 1", {{"0.31 0.62 0.17", Rgb(.56797f)}, {"-1.7 0.2 3.9", Rgb(.37725f)}}},
      {"w",
       "octaves 1, dimensions 4, coord .31 .62 .17",
       {{"0", Rgb(.46055f)}, {".37", Rgb(.3414f)}}},
      {"scale", "octaves 1, coord .31 .62 .17", {{"5", Rgb(.56797f)}, {"2.3", Rgb(.55243f)}}},
      {"octaves",
       "coord .31 .62 .17",
       {{"1", Rgb(.56797f)}, {"3", Rgb(.5814f)}, {"4.5", Rgb(.5662f)}}},
      {"roughness", "coord .31 .62 .17", {{".5", Rgb(.5814f)}, {".9", Rgb(.57785f)}}},
      {"lacunarity",
       "coord .31 .62 .17, octaves 3.4, normalize off",
       {{"2", Rgb(.27204f)}, {"3", Rgb(-.05674f)}}},
      {"distortion", "coord .31 .62 .17", {{"0", Rgb(.5814f)}, {"1.5", Rgb(.52512f)}}},
      {"offset",
       "coord .31 .62 .17, octaves 3.4, type 4",
       {{"0", Rgb(.1544f)}, {".6", Rgb(1.25f)}}},
      {"gain",
       "coord .31 .62 .17, octaves 3.4, type 2, offset .4",
       {{"1", Rgb(.73674f)}, {"2.5", Rgb(.96878f)}}},
      {"type",
       "coord .31 .62 .17, octaves 3.4, normalize off, offset .8",
       {{"0", Rgb(.27204f)},
        {"1", Rgb(1.2903f)},
        {"2", Rgb(1.5477f)},
        {"3", Rgb(.51941f)},
        {"4", Rgb(1.7909f)},
        {"5", Rgb(.582039f)}}},
      {"dimensions",
       "coord .31 .62 .17, w .4",
       {{"1", Rgb(.5f)}, {"2", Rgb(.45933f)}, {"3", Rgb(.5814f)}, {"4", Rgb(.38954f)}}},
      {"normalize", "coord .31 .62 .17, octaves 2", {{"on", Rgb(.59084f)}, {"off", Rgb(.27253f)}}},
      {"color", "coord .31 .62 .17", {{"off", Rgb(.5814f)}, {"on", Rgb(.5814f, .46675f, .53959f)}}},
  };
}

std::vector<TextureRow> wave_rows() {
  return {
      {"coord", "", {{"0.31 0.62 0.17", Rgb(.04263f)}, {"-0.7 0.2 0.9", Rgb(.1833f)}}},
      {"scale", "coord .31 .62 .17", {{"5", Rgb(.04263f)}, {"1.3", Rgb(.60229f)}}},
      {"distortion", "coord .31 .62 .17, scale 1", {{"0", Rgb(.00173f)}, {"4", Rgb(.11756f)}}},
      {"octaves",
       "coord .31 .62 .17, scale 1, distortion 4",
       {{"1", Rgb(.03959f)}, {"4", Rgb(.11744f)}}},
      {"noise_scale",
       "coord .31 .62 .17, scale 1, distortion 4",
       {{"1", Rgb(.11756f)}, {"2.5", Rgb(.02185f)}}},
      {"roughness",
       "coord .31 .62 .17, scale 1, distortion 4",
       {{".5", Rgb(.11756f)}, {"1", Rgb(.15333f)}}},
      {"phase", "coord .31 .62 .17, scale 1", {{"0", Rgb(.00173f)}, {"1", Rgb(.19583f)}}},
      {"shape", "coord .31 .62 .17, scale 1", {{"0", Rgb(.00173f)}, {"1", Rgb(.02107f)}}},
      {"direction",
       "coord .31 .62 .17, scale 1",
       {{"0", Rgb(.00173f)}, {"1", Rgb(.0069f)}, {"2", Rgb(.9834f)}, {"3", Rgb(.49778f)}}},
      {"profile",
       "coord .31 .62 .17, scale 1",
       {{"0", Rgb(.00173f)}, {"1", Rgb(.98676f)}, {"2", Rgb(.02647f)}}},
  };
}

std::vector<TextureRow> magic_rows() {
  return {
      {"coord",
       "",
       {{"0.31 0.62 0.17", Rgb(.8963f, .89895f, .99435f)},
        {"-0.7 0.2 0.9", Rgb(.10069f, .90095f, .04815f)}}},
      {"scale",
       "coord .31 .62 .17",
       {{"5", Rgb(.8963f, .89895f, .99435f)}, {"1.3", Rgb(.70121f, .99851f, .61283f)}}},
      {"distortion",
       "coord .31 .62 .17",
       {{"1", Rgb(.8963f, .89895f, .99435f)}, {"1.7", Rgb(.93898f, .72685f, .99435f)}}},
      {"depth",
       "coord .31 .62 .17",
       {{"0", Rgb(.15038f, .96823f, .99435f)},
        {"1", Rgb(.15038f, .89895f, .99435f)},
        {"2", Rgb(.8963f, .89895f, .99435f)},
        {"3", Rgb(.8963f, .89895f, .23339f)},
        {"4", Rgb(.92923f, .89895f, .23339f)},
        {"5", Rgb(.92923f, .77975f, .23339f)},
        {"6", Rgb(.92923f, .83663f, .23339f)},
        {"7", Rgb(.22923f, .83663f, .23339f)},
        {"8", Rgb(.22923f, .83663f, .8085f)},
        {"9", Rgb(.94227f, .83663f, .8085f)},
        {"10", Rgb(.94227f, .13162f, .8085f)}}},
  };
}

std::vector<TextureRow> voronoi_rows() {
  return {
      {"coord", "", {{"0.31 0.62 0.17", Rgb(.46368f)}, {"-0.7 0.2 0.9", Rgb(.47056f)}}},
      {"w", "coord .31 .62 .17, dimensions 4", {{"0", Rgb(.814094f)}, {".37", Rgb(.458623f)}}},
      {"scale", "coord .31 .62 .17", {{"5", Rgb(.46368f)}, {"2.3", Rgb(.34104f)}}},
      {"randomness", "coord .31 .62 .17", {{"1", Rgb(.46368f)}, {".4", Rgb(.67052f)}}},
      {"smoothness",
       "coord 0.77 0.35 0.25, feature 2, output 1",
       {{"1", Rgb(.38908f, .41691f, .40579f)},
        {".5", Rgb(.48688f, .49012f, .44234f)},
        {"0", Rgb(.53882f, .60149f, .53677f)}}},
      {"exponent", "coord .31 .62 .17, metric 3", {{".5", Rgb(2.3648f)}, {"3", Rgb(.39068f)}}},
      {"feature",
       "coord .31 .62 .17",
       {{"0", Rgb(.46368f)},
        {"1", Rgb(.86545f)},
        {"2", Rgb(.46139f)},
        {"3", Rgb(.20654f)},
        {"4", Rgb(.50867f)}}},
      {"metric",
       "coord .31 .62 .17",
       {{"0", Rgb(.46368f)}, {"1", Rgb(.79326f)}, {"2", Rgb(.31601f)}, {"3", Rgb(2.3648f)}}},
      {"dimensions",
       "coord .31 .62 .17, w .4",
       {{"1", Rgb(.85164f)}, {"2", Rgb(.127549f)}, {"3", Rgb(.46368f)}, {"4", Rgb(.363918f)}}},
      {"output",
       "coord .31 .62 .17, w .4, dimensions 4",
       {{"0", Rgb(.363918f)},
        {"1", Rgb(.586331f, .378576f, .975053f)},
        {"2", Rgb(.317266f, .623629f, .107811f)},
        {"3", Rgb(.436932f)}}},
  };
}

std::vector<TextureRow> brick_rows() {
  return {
      {"coord", "", {{"0.31 0.62 0.17", Rgb(.25721f)}, {"0.7 0.21 0", Rgb(.27133f)}}},
      {"color1",
       "coord .31 .62 .17",
       {{"1 .5 0", Rgb(.27627f, .2286f, .18093f)}, {"0 .2 1", Rgb(.18093f, .2f, .27627f)}}},
      {"color2",
       "coord .31 .62 .17",
       {{"1 .5 0", Rgb(.98093f, .5286f, .07627f)}, {"0 .2 1", Rgb(.07627f, .25721f, .98093f)}}},
      {"mortar",
       "coord .3 .6 0, mortar_size .1",
       {{"1 .5 0", Rgb(1, .5f, 0)}, {"0 .2 1", Rgb(0, .2f, 1)}}},
      {"scale", "coord .31 .62 .17", {{"5", Rgb(.25721f)}, {"2.3", Rgb(.36527f)}}},
      {"mortar_size",
       "coord .31 .62 .17, factor on, mortar_smooth 1",
       {{".02", Rgb(0)}, {".12", Rgb(.07407f)}}},
      {"mortar_smooth",
       "coord .31 .62 .17, factor on, mortar_size .12",
       {{".1", Rgb(1)}, {"1", Rgb(.07407f)}}},
      {"bias", "coord .31 .62 .17", {{"0", Rgb(.25721f)}, {"-.2", Rgb(.37721f)}}},
      {"width",
       "coord .31 .62 .17",
       {{".5", Rgb(.25721f)}, {".8", Rgb(.64939f)}, {".3", Rgb(.5383f)}}},
      {"height", "coord .31 .62 .17", {{".25", Rgb(.25721f)}, {".4", Rgb(.53617f)}}},
      {"offset", "coord .31 .62 .17", {{".5", Rgb(.25721f)}, {".2", Rgb(.25721f)}, {".9", Rgb(0)}}},
      {"squash",
       "coord .31 .62 .17",
       {{"1", Rgb(.25721f)}, {".6", Rgb(.5383f)}, {"3", Rgb(.39687f)}}},
      {"offset_rows",
       "coord .31 .77 0, offset .9",
       {{"2", Rgb(.7352f)}, {"3", Rgb(0)}, {"5", Rgb(0)}}},
      {"squash_rows",
       "coord .31 .77 0, squash .6",
       {{"2", Rgb(.7352f)}, {"3", Rgb(.55976f)}, {"5", Rgb(.55976f)}}},
      {"factor", "coord .3 .6 0, mortar_size .1", {{"off", Rgb(0)}, {"on", Rgb(1)}}},
  };
}

void expect_row(const std::string& shader, const TextureRow& row) {
  for (const Given& each : row.values) {
    const std::string set = std::string(row.others) + ", " + row.parameter + " " + each.value;
    const Rgb found = value()(call_of(shader, set)).mean;
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(found[k], each.expected[k], kCyclesError * std::max(1.0f, each.expected[k]))
          << shader << ": " << set << ", channel " << k;
  }
}

void add_rows(Cases& all, const std::string& shader, const std::vector<TextureRow>& rows) {
  for (const TextureRow& row : rows)
    all.push_back(shows(shader + "." + row.parameter, [=] { expect_row(shader, row); }));
}

}  // namespace
}  // namespace oriel_textures

Cases oriel_texture_cases() {
  Cases all;
  oriel_textures::add_rows(all, "oriel_noise", oriel_textures::noise_rows());
  oriel_textures::add_rows(all, "oriel_wave", oriel_textures::wave_rows());
  oriel_textures::add_rows(all, "oriel_magic", oriel_textures::magic_rows());
  oriel_textures::add_rows(all, "oriel_voronoi", oriel_textures::voronoi_rows());
  oriel_textures::add_rows(all, "oriel_brick", oriel_textures::brick_rows());
  return all;
}

}  // namespace oriel::effects
