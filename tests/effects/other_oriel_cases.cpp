// SPDX-License-Identifier: Apache-2.0
// Oriel's own textures and layers: shaders/oriel/oriel_normal_map.cpp, oriel_tex_vector.cpp,
// oriel_vertex_color.cpp, oriel_layers.cpp, oriel_direction_angle.cpp.
#include "bsdf/sheen.h"
#include "bsdf/thin_film.h"
#include "cases.h"
#include "other_stages.h"
#include "prepare/testing/prepared_scene.h"

namespace oriel::effects {
namespace other_own_textures {
namespace {

using namespace other_stages;

// 2 c / 255 - 1 of the bytes cc, 99, ff: .6, .2, 1.
const std::string kPictures =
    "vector texture \"tilted\" [1 1 3] 'cc99ff'\nvector texture \"leaning\" [1 1 3] '99ccff'\n";
Vec3 tilted(float factor = 1) { return normalize(Vec3(.6f * factor, .2f * factor, 1)); }

/// The call before a white Lambert shader in the material of a square with coordinates, lit from a
/// direction in which no shadow terminator is softened.
const Vec3 kToSun(-.48f, .36f, .8f);
Measured before_lambert(const std::string& call) {
  const std::string elements = fmt::format(
      "{}light \"sun\" \"mib_light_infinite\" ( \"color\" 1 1 1 ) direction {} end light\n"
      "instance \"sun_i\" \"sun\" end instance\n"
      "material \"m\" {} \"mib_illum_lambert\" ( \"diffuse\" 1 1 1 ) end material\n",
      kPictures, text_of(-kToSun), call);
  return Probe(testing::scene_text(elements, "\"sun_i\""), testing::test_registry())
      .ray(Vec3(0), Vec3(0, 0, -1), 64);
}
Rgb lit(const Vec3& normal) { return Rgb(std::max(0.0f, dot(normal, kToSun))); }

void add_normal_map(Cases& all) {
  const std::string name = "oriel_normal_map.";
  all.push_back(
      gives(name + "tex", before_lambert, "",
            {{"\"tilted\"", lit(tilted())}, {"\"leaning\"", lit(normalize(Vec3(.2f, .6f, 1)))}}));
  all.push_back(gives(name + "factor", before_lambert, "tex \"tilted\"",
                      {{"0", lit(Vec3(0, 0, 1))},
                       {".5", lit(tilted(.5f))},
                       {"1", lit(tilted())},
                       {"-2", lit(tilted(-2))}}));
  all.push_back(gives(name + "color", before_lambert, "",
                      {{"0.8 0.6 1", lit(tilted())}, {"0.5 0.5 1", lit(Vec3(0, 0, 1))}}));
  // The square has no second space, so that its normal is unchanged.
  all.push_back(gives(name + "space", before_lambert, "tex \"tilted\"",
                      {{"0", lit(tilted())}, {"1", lit(Vec3(0, 0, 1))}}));
  // The normal itself, what turns the old one into it, or nothing where it was turned at once.
  all.push_back(shows(name + "bump_mode", [] {
    const auto given = [](int mode) {
      const Rgb v = value(kPictures)(call_of("oriel_normal_map",
                                             fmt::format("tex \"tilted\", bump_mode {}", mode)))
                        .mean;
      return Vec3(v.x, v.y, v.z);
    };
    EXPECT_EQ(given(0), Vec3(0));
    for (int mode = 1; mode <= 8; ++mode) {
      const Vec3 from = mode <= 4 ? Vec3(0, 0, 1) : Vec3(0);
      EXPECT_LT(length(normalize(from + given(mode)) - tilted()), 1e-5f) << mode;
      EXPECT_GT(length(from + given(mode)), .5f) << mode;
    }
    EXPECT_GT(length(given(1) - given(5)), .5f);
  }));
}

void add_vector(Cases& all) {
  const std::string name = "oriel_tex_vector.vector";
  Case itself = gives(name, value(), "", {{"1 2 3", Rgb(1, 2, 3)}, {"0 0 0", Rgb(0)}});
  // A highlight five times as wide as high is seen along the vector, from a sun beside the mirror.
  const auto shown = [](const char* vector, const char* sun) {
    SceneText scene;
    scene.statement(fmt::format(
        "material \"m\" {} \"mia_material_x\" ( \"diffuse_weight\" 0, \"reflectivity\" 1, "
        "\"brdf_0_degree_refl\" 1, \"refl_gloss\" .5, \"refl_hl_only\" on, \"anisotropy\" 5, "
        "\"anisotropy_channel\" -4 ) end material",
        call_of("oriel_tex_vector", std::string("vector ") + vector)));
    scene.plate("m");
    scene.light("sun", fmt::format("\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction {}", sun));
    return Probe(scene.str()).onto(Vec3(0), Vec3(0, 0, 1), 0, 64).mean.x;
  };
  all.push_back(both(itself, shows(name, [shown] {
                       const char *right = "-.3 0 -1", *above = "0 -.3 -1";
                       EXPECT_GT(shown("1 0 0", right), 2 * shown("0 1 0", right));
                       EXPECT_GT(shown("0 1 0", above), 2 * shown("1 0 0", above));
                       EXPECT_NEAR(shown("1 0 0", right), shown("0 1 0", above), 1e-4f);
                       EXPECT_NEAR(shown("3 0 0", right), shown("1 0 0", right), 1e-4f);
                     })));
}

void add_vertex_color(Cases& all) {
  const std::string name = "oriel_vertex_color.";
  const Rgb first(.2f, .4f, .6f), second(.5f, .7f, .9f), tint(1, .5f, 2);
  const std::string square = square_of_spaces(Vec3(.2f, .4f, .6f), Vec3(.5f, .7f, .9f));
  all.push_back(
      gives(name + "color", value(kTint + square), "",
            {{"1 1 1 1", first}, {"1 .5 2 1", first * tint}, {"= \"tint\"", first * kTinted}}));
  all.push_back(gives(name + "space", value(square), "color 1 .5 2 1",
                      {{"0", first * tint}, {"1", second * tint}, {"-1", tint}, {"2", tint}}));
  const Stage alpha = inside("\"mib_color_alpha\" ( \"input\" = \"inner\", \"factor\" 1 )", square);
  all.push_back(gives(name + "alpha_space", alpha, "color 1 1 1 .5",
                      {{"-1", Rgb(.5f)}, {"0", Rgb(.1f)}, {"1", Rgb(.25f)}, {"2", Rgb(.5f)}}));
}

/// The call as the material of a plate under a white sky, seen at an angle; "red", "black" and
/// "white" are matte materials.
Stage plate_in_sky(float degrees) {
  std::string elements;
  for (const auto& [name, color] :
       {std::pair("red", "1 0 0"), std::pair("black", "0 0 0"), std::pair("white", "1 1 1")})
    elements +=
        fmt::format("shader \"{}\" \"mib_illum_lambert\" ( \"diffuse\" {} )\n", name, color);
  return square_in([](SceneText& scene) { scene.uniform_sky(1); }, {degrees, 16384}, elements);
}

void add_sheen(Cases& all) {
  const std::string name = "oriel_sheen.";
  const float cosine = std::cos(60 * kPi / 180);
  const float half = bsdf::sheen_albedo(.25f, cosine), narrow = bsdf::sheen_albedo(.09f, cosine);
  all.push_back(
      gives(name + "base_material", plate_in_sky(60), "color 1 1 1 1",
            {{"\"black\"", Rgb(half)}, {"\"red\"", Rgb(1, half, half)}, {"\"white\"", Rgb(1)}}));
  all.push_back(gives(name + "color", plate_in_sky(60), "base_material \"white\"",
                      {{"0 0 0 1", Rgb(1)},
                       {"1 .5 .25 1", Rgb(1, 1 - .5f * half, 1 - .75f * half)},
                       {"= \"tint\"", Rgb(1, 1 - .4f * half, 1 - .5f * half)}}));
  all.push_back(gives(name + "roughness", plate_in_sky(60), "base_material \"black\"",
                      {{".5", Rgb(half)}, {".3", Rgb(narrow)}, {"= \"tint\"", Rgb(narrow)}}));
}

void add_thin_film(Cases& all) {
  const std::string name = "oriel_thin_film.";
  const auto film = [](float cosine, float ior, const Rgb& base, float thickness) {
    return bsdf::thin_film_color(cosine, ior, base, thickness);
  };
  const Rgb glass(.04f), copper(.9f, .6f, .4f);
  all.push_back(gives(name + "reflectance", value(kTint), "",
                      {{".04 .04 .04 1", film(1, 1.3f, glass, 400)},
                       {".9 .6 .4 1", film(1, 1.3f, copper, 400)},
                       {"= \"tint\"", film(1, 1.3f, kTinted, 400)}}));
  const Rgb coloured = film(1, 1.3f, copper, 400);
  all.push_back(gives(name + "factor", value(kTint), "reflectance .9 .6 .4 1",
                      {{"0", copper},
                       {"1", coloured},
                       {".5", (copper + coloured) * .5f},
                       {"= \"tint\"", copper + (coloured - copper) * .3f}}));
  all.push_back(
      gives(name + "ior", value(kTint), "reflectance .9 .6 .4 1",
            {{"1", copper}, {"1.8", film(1, 1.8f, copper, 400)}, {"= \"tint\"", copper}}));
  const std::string thick = "shader \"thick\" \"mib_color_mix\" ( \"color_base\" 250 250 250 1 )\n";
  all.push_back(
      gives(name + "thickness", value(thick), "reflectance .9 .6 .4 1",
            {{"0", copper}, {"400", coloured}, {"= \"thick\"", film(1, 1.3f, copper, 250)}}));
  // At an angle: the film is seen along a shorter difference of paths.
  const Stage at_60 = [](const std::string& call) {
    SceneText scene;
    scene.statement(shown_as_light(call)).plate("m");
    return Probe(scene.str(), known_shaders()).onto(Vec3(0), Vec3(0, 0, 1), 60, 16);
  };
  all.back() =
      both(all.back(),
           gives(name + "thickness", at_60, "reflectance .9 .6 .4 1",
                 {{"400", film(.5f, 1.3f, copper, 400)}, {"250", film(.5f, 1.3f, copper, 250)}}));
}

void add_direction_angle(Cases& all) {
  const std::string name = "oriel_direction_angle.";
  all.push_back(gives(name + "direction", value(kTint), "offset .5",
                      {{"1 .5 0 1", Rgb(.5f)},
                       {".5 1 0 1", Rgb(.75f)},
                       {".5 0 0 1", Rgb(.25f)},
                       {"1 1 0 1", Rgb(.625f)},
                       {".5 .5 0 1", Rgb(.5f)},
                       {"= \"tint\"", Rgb(.5f + std::atan2(-.6f, .2f) / kTwoPi)}}));
  all.push_back(gives(name + "offset", value(kTint), "direction .5 1 0 1",
                      {{"0", Rgb(.25f)}, {".5", Rgb(.75f)}, {"= \"tint\"", Rgb(.55f)}}));
}

Cases cases() {
  Cases all;
  add_sheen(all);
  add_thin_film(all);
  add_direction_angle(all);
  add_normal_map(all);
  add_vector(all);
  add_vertex_color(all);
  return all;
}

}  // namespace
}  // namespace other_own_textures

Cases other_oriel_cases() { return other_own_textures::cases(); }

}  // namespace oriel::effects
