// SPDX-License-Identifier: Apache-2.0
// Diffuse surfaces with highlights: shaders/base/mib_illum.cpp.
#include <fmt/format.h>

#include "base_stages.h"
#include "cases.h"
#include "prepare/testing/prepared_scene.h"

namespace oriel::effects {
namespace base_illum {

/// A surface of normal z with texture coordinates along x and y, seen along its normal. The light
/// instances are "sun0_i", "sun1_i".
struct Sun {
  Vec3 color, from;
};
Stage lit(const std::vector<Sun>& suns) {
  return [=](const std::string& call) {
    std::string elements = "material \"m\" " + call + " end material\n", names;
    for (std::size_t i = 0; i < suns.size(); ++i) {
      elements += fmt::format(
          "light \"sun{0}\" \"mib_light_infinite\" ( \"color\" {1} ) direction {2} end light\n"
          "instance \"sun{0}_i\" \"sun{0}\" end instance\n",
          i, text_of(suns[i].color), text_of(-suns[i].from));
      names += fmt::format("\"sun{}_i\" ", i);
    }
    return Probe(testing::scene_text(elements, names), known_shaders())
        .direct_only()
        .ray(Vec3(0), Vec3(0, 0, -1), 64);
  };
}
/// One white sun.
Stage lit_from(const Vec3& from) { return lit({{Vec3(1), from}}); }

const Vec3 kAbove(0, 0, 1), kAlongX(.6f, 0, .8f), kAlongY(0, .6f, .8f);

/// The parameters that all illumination shaders have.
void add_common(Cases& all, const std::string& shader) {
  const Stage stage = lit({{Vec3(1, 0, 0), kAbove}, {Vec3(0, 1, 0), kAlongY}});
  const Rgb red(1, 0, 0), green(0, .8f, 0);
  all.push_back(gives(shader + ".ambience", stage, "ambient .5 .4 .2",
                      {{"1 1 1", Rgb(.5f, .4f, .2f)}, {".5 0 2", Rgb(.25f, 0, .4f)}}));
  all.push_back(gives(shader + ".ambient", stage, "ambience .5 .4 .2",
                      {{"1 1 1", Rgb(.5f, .4f, .2f)}, {".5 0 2", Rgb(.25f, 0, .4f)}}));
  all.push_back(gives(shader + ".diffuse", stage, "",
                      {{"0 0 0", Rgb(0)}, {"1 1 1", red + green}, {".5 .25 1", Rgb(.5f, .2f, 0)}}));
  const std::string white = "diffuse 1 1 1";
  all.push_back(gives(shader + ".mode", stage, white + ", lights [ \"sun0_i\" ]",
                      {{"0", red}, {"1", red}, {"2", green}, {"4", red + green}}));
  all.push_back(gives(shader + ".lights", stage, white,
                      {{"[ ]", red + green},
                       {"[ \"sun0_i\" ]", red},
                       {"[ \"sun1_i\" ]", green},
                       {"[ \"sun0_i\", \"sun1_i\" ]", red + green}}));
}

/// The colour of a highlight; `level`: its radiance for white.
Case colored(const std::string& parameter, const Stage& stage, const std::string& others,
             float level) {
  return gives(parameter, stage, others,
               {{"0 0 0", Rgb(0)}, {"1 1 1", Rgb(level)}, {"2 .5 .25", Rgb(2, .5f, .25f) * level}});
}

void add_powers(Cases& all) {
  // Phong: the mirrored view is the normal, and its cosine to the light is .8. Hair: the fibre runs
  // along y, and the sine between fibre and light is .8 as well.
  for (const std::string shader : {"mib_illum_phong", "mib_illum_hair"}) {
    const Stage stage = lit_from(kAlongY);
    all.push_back(colored(shader + ".specular", stage, "exponent 2", .64f));
    all.push_back(gives(shader + ".exponent", stage, "specular 1 1 1",
                        {{"1", Rgb(.8f)}, {"2", Rgb(.64f)}, {"4", Rgb(.4096f)}}));
  }
  all.back() = both(all.back(), gives("mib_illum_hair.exponent", lit_from(kAlongX),
                                      "specular 1 1 1", {{"1", Rgb(1)}, {"4", Rgb(1)}}));
}

/// Fresnel reflectance at normal incidence.
float facing(float ior) { return (ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1)); }

void add_facets(Cases& all, const std::string& shader, const std::string& ior) {
  // With view and light along the normal the highlight is F / (4 m^2), m the slope.
  const Stage peak = lit_from(kAbove), beside = lit_from(kAlongX);
  all.push_back(colored(shader + ".specular", peak, "roughness .5, ior " + ior, facing(3)));
  const std::string white = "specular 1 1 1, ior " + ior;
  all.push_back(both(
      gives(shader + ".roughness", peak, white,
            {{".25", Rgb(4 * facing(3))}, {".5", Rgb(facing(3))}, {"1", Rgb(.25f * facing(3))}}),
      rises(shader + ".roughness", beside, white, {".05", ".1", ".3"})));
}

void add_torrance(Cases& all) {
  const std::string white = "specular 1 1 1, roughness .5";
  add_facets(all, "mib_illum_blinn", "3");
  all.push_back(gives("mib_illum_blinn.ior", lit_from(kAbove), white,
                      {{"1", Rgb(0)}, {"1.5", Rgb(facing(1.5f))}, {"3", Rgb(facing(3))}}));
  add_facets(all, "mib_illum_cooktorr", "3 3 3");
  all.push_back(gives("mib_illum_cooktorr.ior", lit_from(kAbove), white,
                      {{"1.5 2 3", Rgb(facing(1.5f), facing(2), facing(3))},
                       {"3 1.5 .5", Rgb(facing(3), facing(1.5f), 0)},
                       {"2 2 2", Rgb(facing(2))}}));
}

/// Ward's highlight of slopes 1 / u and 1 / v, seen along the normal. The light is tilted toward u:
/// its cosine to the normal is .8, the tangent of the half vector is 1 / 3.
float ward(float u, float v) { return u * v / 4 * std::exp(-u * u / 9) * std::sqrt(.8f); }

void add_ward(Cases& all, const std::string& shader, const std::string& basis) {
  const std::string white = "glossy 1 1 1" + basis;
  const Stage x = lit_from(kAlongX), y = lit_from(kAlongY);
  all.push_back(colored(shader + ".glossy", lit_from(kAbove), "shiny_u 2, shiny_v 4" + basis, 2));
  all.push_back(
      both(gives(shader + ".shiny_u", x, white + ", shiny_v 2",
                 {{"1", Rgb(ward(1, 2))}, {"3", Rgb(ward(3, 2))}, {"9", Rgb(ward(9, 2))}}),
           scales(shader + ".shiny_u", y, white + ", shiny_v 2", "1", "3", 3)));
  all.push_back(
      both(gives(shader + ".shiny_v", y, white + ", shiny_u 2",
                 {{"1", Rgb(ward(1, 2))}, {"3", Rgb(ward(3, 2))}, {"9", Rgb(ward(9, 2))}}),
           scales(shader + ".shiny_v", x, white + ", shiny_u 2", "1", "3", 3)));
}

void add_directions(Cases& all) {
  const std::string shader = "mib_illum_ward.", call = "glossy 1 1 1, shiny_u 1, shiny_v 4";
  const Stage stage = lit_from(kAlongX);
  all.push_back(
      gives(shader + "u", stage, call, {{"1 0 0", Rgb(ward(1, 4))}, {"0 1 0", Rgb(ward(4, 1))}}));
  all.push_back(
      gives(shader + "v", stage, call, {{"0 1 0", Rgb(ward(1, 4))}, {"1 0 0", Rgb(ward(4, 1))}}));
}

Cases cases() {
  Cases all;
  for (const char* model : {"lambert", "phong", "blinn", "cooktorr", "ward", "ward_deriv", "hair"})
    add_common(all, fmt::format("mib_illum_{}", model));
  add_powers(all);
  add_torrance(all);
  add_ward(all, "mib_illum_ward", ", u 1 0 0, v 0 1 0");
  add_ward(all, "mib_illum_ward_deriv", "");
  add_directions(all);
  return all;
}

}  // namespace base_illum

Cases base_illum_cases() { return base_illum::cases(); }

}  // namespace oriel::effects
