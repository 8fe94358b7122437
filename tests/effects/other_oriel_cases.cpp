// SPDX-License-Identifier: Apache-2.0
// Oriel's own textures: shaders/oriel/oriel_normal_map.cpp, oriel_tex_vector.cpp,
// oriel_vertex_color.cpp.
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
  return Probe(testing::scene_text(elements, "\"sun_i\""), analytic::test_registry())
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
    scene.square("m", Vec3(0), 5, Vec3(0, 0, 1));
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

Cases cases() {
  Cases all;
  add_normal_map(all);
  add_vector(all);
  add_vertex_color(all);
  return all;
}

}  // namespace
}  // namespace other_own_textures

Cases other_oriel_cases() { return other_own_textures::cases(); }

}  // namespace oriel::effects
