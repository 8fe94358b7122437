// SPDX-License-Identifier: Apache-2.0
// Oriel's nodes and the plastic: shaders/oriel/oriel_arithmetic.cpp, oriel_facing.cpp,
// oriel_bump.cpp, oriel_plastic.cpp.
#include "cases.h"
#include "other_stages.h"
#include "prepare/testing/prepared_scene.h"

namespace oriel::effects {
namespace oriel_nodes {
namespace {

using namespace other_stages;

void add_math(Cases& all) {
  const std::string name = "oriel_math.";
  all.push_back(gives(name + "operation", value(), "input1 .8 .5 .25, input2 .5 .5 2, input3 1 2 3",
                      {{"0", Rgb(1.3f, 1, 2.25f)},
                       {"1", Rgb(.3f, 0, -1.75f)},
                       {"2", Rgb(.4f, .25f, .5f)},
                       {"3", Rgb(1.6f, 1, .125f)},
                       {"4", Rgb(1.4f, 2.25f, 3.5f)},
                       {"5", Rgb(.894427f, .707107f, .0625f)},
                       {"7", Rgb(.894427f, .707107f, .5f)},
                       {"13", Rgb(0, 0, 1)},
                       {"14", Rgb(1, 0, 0)},
                       {"23", Rgb(.8f, .5f, .25f)},
                       {"24", Rgb(.3f, 0, .25f)},
                       {"27", Rgb(.5f, .5f, 0)}}));
  all.push_back(gives(name + "input1", value(kTint), "input2 1 1 1",
                      {{"1 2 3", Rgb(2, 3, 4)}, {"= \"tint\"", kTinted + Rgb(1)}}));
  all.push_back(gives(name + "input2", value(kTint), "input1 1 1 1",
                      {{"1 2 3", Rgb(2, 3, 4)}, {"= \"tint\"", kTinted + Rgb(1)}}));
  all.push_back(gives(name + "input3", value(kTint), "operation 4",
                      {{"1 2 3", Rgb(1, 2, 3)}, {"= \"tint\"", kTinted}}));
  all.push_back(gives(name + "clamp", value(), "input1 2 .5 -1",
                      {{"off", Rgb(2, .5f, -1)}, {"on", Rgb(1, .5f, 0)}}));
}

void add_blend(Cases& all) {
  const std::string name = "oriel_blend.";
  const std::string both = "below .8 .5 .2, above .5 .5 .8";
  all.push_back(gives(name + "mode", value(), both,
                      {{"0", Rgb(.5f, .5f, .8f)},
                       {"1", Rgb(1.3f, 1, 1)},
                       {"2", Rgb(.4f, .25f, .16f)},
                       {"3", Rgb(.3f, 0, -.6f)},
                       {"4", Rgb(.9f, .75f, .84f)},
                       {"5", Rgb(1.6f, 1, .25f)},
                       {"6", Rgb(.3f, 0, .6f)},
                       {"8", Rgb(.5f, .5f, .2f)},
                       {"9", Rgb(.8f, .5f, .8f)},
                       {"10", Rgb(.8f, .5f, .32f)},
                       {"12", Rgb(.8f, .5f, .8f)},
                       {"13", Rgb(1, 1, 1)},
                       {"14", Rgb(.6f, 0, 0)},
                       {"16", Rgb(.8f, .65f, .5f)},
                       {"17", Rgb(.5f, .5f, .8f)},
                       {"18", Rgb(.8f, .5f, .2f)}}));
  all.push_back(gives(name + "factor", value(kTint), "below 1 1 1, above 0 0 0",
                      {{"0", Rgb(1)}, {".25", Rgb(.75f)}, {"= \"tint\"", Rgb(.7f)}}));
  all.push_back(gives(name + "below", value(kTint), "factor 0",
                      {{"1 2 3", Rgb(1, 2, 3)}, {"= \"tint\"", kTinted}}));
  all.push_back(
      gives(name + "above", value(kTint), "", {{"1 2 3", Rgb(1, 2, 3)}, {"= \"tint\"", kTinted}}));
  all.push_back(gives(name + "clamp", value(), "mode 1, below 1 .5 -1, above 1 0 0",
                      {{"off", Rgb(2, .5f, -1)}, {"on", Rgb(1, .5f, 0)}}));
}

void add_hue_saturation(Cases& all) {
  const std::string name = "oriel_hue_saturation.";
  const std::string red = "input .8 .4 .4";
  all.push_back(gives(name + "input", value(kTint), "",
                      {{".1 .2 .3", Rgb(.1f, .2f, .3f)}, {"= \"tint\"", kTinted}}));
  all.push_back(gives(
      name + "hue", value(), red,
      {{".5", Rgb(.8f, .4f, .4f)}, {"0", Rgb(.4f, .8f, .8f)}, {".8333333", Rgb(.4f, .8f, .4f)}}));
  all.push_back(gives(name + "saturation", value(kTint), red,
                      {{"0", Rgb(.8f)}, {"1.5", Rgb(.8f, .2f, .2f)}, {"9", Rgb(.8f, 0, 0)}}));
  all.push_back(
      gives(name + "value", value(kTint), red, {{"0", Rgb(0)}, {"2", Rgb(1.6f, .8f, .8f)}}));
  all.push_back(gives(name + "factor", value(), red + ", value 0",
                      {{"0", Rgb(.8f, .4f, .4f)}, {".5", Rgb(.4f, .2f, .2f)}}));
}

/// The call as light of a square that is seen at 60 degrees.
Measured facing_at_60(const std::string& call) {
  SceneText scene;
  scene.statement(shown_as_light(call)).plate("m");
  return Probe(scene.str(), known_shaders()).onto(Vec3(0), Vec3(0, 0, 1), 60, 16);
}

void add_facing(Cases& all) {
  const std::string name = "oriel_facing.";
  // Fresnel at 60 degrees for an index of 1.5: refracted at 35.264 degrees; s .4201^2, p .0424^2.
  all.push_back(gives(name + "mode", facing_at_60, "",
                      {{"0", Rgb(.5f)},
                       {"1", Rgb(.0891867f)},
                       {"2", Rgb(.5f)},
                       {"3", Rgb(.03125f)},
                       {"4", Rgb(0)}}));
  all.push_back(gives(name + "ior", value(), "mode 1", {{"1.5", Rgb(.04f)}, {"3", Rgb(.25f)}}));
  all.push_back(gives(name + "blend", facing_at_60, "mode 2",
                      {{".25", Rgb(1 - .7071068f)}, {".5", Rgb(.5f)}, {".75", Rgb(.75f)}}));
}

void add_plastic_diffuse(Cases& all) {
  const std::string name = "oriel_plastic.", matte = "ior 1, diffuse 1 1 1";
  all.push_back(gives(name + "diffuse", material_in_sun(), "ior 1",
                      {{".2 .4 .6", Rgb(.2f, .4f, .6f)}, {"1 1 1", Rgb(1)}}));
  // At 60 degrees (1 - cos)^5 is 1/32; the light is along the normal.
  const auto seen_by = [&](const char* roughness, float expected) {
    return gives(name + "retro_reflective", material_in_sun(60), matte + ", roughness " + roughness,
                 {{"off", Rgb(1)}, {"on", Rgb(expected)}});
  };
  all.push_back(both(seen_by("0", 1 - 1 / 64.0f), seen_by("1", 1 - 1 / 64.0f + 1.5f / 32)));
  all.push_back(
      gives(name + "bump", material_in_sun(), matte, {{"0 0 1", Rgb(1)}, {"0 .6 .8", Rgb(.8f)}}));
  all.push_back(gives(name + "bump_mode", material_in_sun(), matte + ", bump 0 .6 .8",
                      {{"5", Rgb(.8f)}, {"1", Rgb(1.8f / 1.8973666f)}}));
}

void add_plastic_reflection(Cases& all) {
  const std::string name = "oriel_plastic.", bare = "diffuse 0 0 0";
  // Along the normal F D / 4 of the sun's irradiance pi: F / (4 roughness^4).
  all.push_back(gives(name + "roughness", material_in_sun(), bare,
                      {{".5", Rgb(.16f)}, {".75", Rgb(.0316049f)}, {"1", Rgb(.01f)}}));
  all.push_back(gives(name + "ior", material_in_sun(), bare,
                      {{"1", Rgb(0)}, {"1.5", Rgb(.16f)}, {"3", Rgb(1)}}));
  all.push_back(gives(name + "reflection_color", material_in_sun(), bare,
                      {{"1 1 1", Rgb(.16f)}, {"1 .5 0", Rgb(.16f, .08f, 0)}}));
  const std::string dark = "diffuse 1 1 1, reflection_color 0 0 0, albedo_0 .5, albedo_90 .8";
  all.push_back(
      gives(name + "conserve", material_in_sun(), dark, {{"off", Rgb(1)}, {"on", Rgb(.5f)}}));
  all.push_back(
      gives(name + "albedo_0", material_in_sun(), dark, {{".2", Rgb(.8f)}, {".5", Rgb(.5f)}}));
  all.push_back(gives(name + "albedo_90", material_in_sun(60), dark + ", albedo_curve 1",
                      {{".7", Rgb(.4f)}, {".9", Rgb(.3f)}}));
  all.push_back(gives(name + "albedo_curve", material_in_sun(60), dark,
                      {{"1", Rgb(.35f)}, {"2", Rgb(.425f)}}));
  const std::string glow =
      "shader \"glow\" \"mia_material_x\" ( \"diffuse\" 0 0 0, \"reflectivity\" 0, "
      "\"additional_color\" .1 .2 .3 )\n";
  const Stage stage = square_in(sun_above, {}, glow);
  all.push_back(gives(name + "base_material", stage, "ior 1, diffuse .5 .5 .5",
                      {{"null", Rgb(.5f)}, {"\"glow\"", Rgb(.6f, .7f, .8f)}}));
}

/// The bumped normal on a plane whose height "ramp" falls by .75 per unit of x. Differences of
/// single precision are not exact.
Case bumped(const std::string& parameter, const std::string& others,
            const std::vector<Given>& values) {
  return shows("oriel_bump." + parameter, [=] {
    const std::string ramp =
        "shader \"at\" \"mib_texture_vector\" ( \"select\" -1, \"selspace\" 1 )\n"
        "shader \"slope\" \"oriel_math\" ( \"operation\" 2, \"input1\" = \"at\", "
        "\"input2\" -.75 0 0 )\n"
        "shader \"ramp\" \"mib_color_average\" ( \"input\" = \"slope\", \"factor\" 3 )\n";
    for (const Given& each : values) {
      const std::string set = others + ", " + parameter + " " + each.value;
      const Rgb found = value(ramp)(call_of("oriel_bump", set)).mean;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], each.expected[k], 2e-3f) << set;
    }
  });
}

void add_bump(Cases& all) {
  const std::string ramp = "height = \"ramp\"";
  const Rgb flat(0, 0, 1), tilted(.6f, 0, .8f);
  all.push_back(bumped("height", "distance 1", {{"1", flat}, {"= \"ramp\"", tilted}}));
  all.push_back(
      bumped("distance", ramp, {{"0", flat}, {"1", tilted}, {"2", {.83205f, 0, .5547f}}}));
  all.push_back(
      bumped("strength", ramp, {{"0", flat}, {".5", {.316228f, 0, .948683f}}, {"1", tilted}}));
  all.push_back(bumped("bump_mode", ramp, {{"5", tilted}, {"6", tilted}, {"7", tilted}}));
  all.push_back(bumped("normal", "height 1", {{"0 0 0", flat}, {".6 0 .8", tilted}}));
}

}  // namespace
}  // namespace oriel_nodes

Cases oriel_node_cases() {
  Cases all;
  oriel_nodes::add_math(all);
  oriel_nodes::add_blend(all);
  oriel_nodes::add_hue_saturation(all);
  oriel_nodes::add_facing(all);
  oriel_nodes::add_bump(all);
  oriel_nodes::add_plastic_diffuse(all);
  oriel_nodes::add_plastic_reflection(all);
  return all;
}

}  // namespace oriel::effects
