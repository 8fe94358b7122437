// SPDX-License-Identifier: Apache-2.0
// Approximations of 3ds Max materials: shaders/max/max_materials.cpp, max_elements.cpp.
#include "cases.h"
#include "other_stages.h"

namespace oriel::effects {
namespace other_max_materials {
namespace {

using namespace other_stages;

/// "test_sky" ( above 1, below .2 ).
void two_skies(SceneText& scene) {
  scene.environment("\"test_sky\" ( \"above\" 1 1 1, \"below\" .2 .2 .2 )");
}
void no_light(SceneText&) {}

/// The mirrored view is 30 degrees off the sun.
const View kAside{.degrees = 30};
float phong(float exponent) { return std::pow(std::sqrt(.75f), exponent); }

void add_default(Cases& all) {
  const std::string name = "max_DefaultMaterial.";
  all.push_back(
      gives(name + "diffuse", square_in(sun_above), "",
            {{".2 .4 .6 1", Rgb(.2f, .4f, .6f)}, {"0 0 0 1", Rgb(0)}, {"= \"tint\"", kTinted}}));
  all.push_back(gives(name + "specular", square_in(sun_above), "diffuse .1 .1 .1, shinyness .5",
                      {{"0 0 0 1", Rgb(.1f)}, {".5 .25 .75 1", Rgb(.6f, .35f, .85f)}}));
  const std::string shiny = "diffuse 0 0 0, specular 1 1 1";
  all.push_back(both(
      falls(name + "shinyness", square_in(sun_above, kAside), shiny, {"0", ".2", ".4", ".8"}),
      gives(name + "shinyness", square_in(sun_above), shiny, {{"0", Rgb(1)}, {".8", Rgb(1)}})));
}

void add_illumination(Cases& all, const std::string& shader) {
  const std::string name = shader + ".";
  const Stage sun = square_in(sun_above), dark = square_in(no_light);
  const Rgb color(.2f, .4f, .6f);
  const std::string written = ".2 .4 .6 1";
  all.push_back(gives(name + "Diffuse", sun, "",
                      {{written, color}, {"1 0 0 1", Rgb(1, 0, 0)}, {"= \"tint\"", kTinted}}));
  const std::string black = "Diffuse 0 0 0 1, ";
  all.push_back(
      gives(name + "Specular", sun, black + "SpecularLevel .5",
            {{written, color * .5f}, {"1 0 0 1", Rgb(.5f, 0, 0)}, {"= \"tint\"", kTinted * .5f}}));
  // Shares of 0 to 1, or in percent.
  all.push_back(
      gives(name + "SpecularLevel", sun, black + "Specular " + written,
            {{"0", Rgb(0)}, {".5", color * .5f}, {"2", color * 2.f}, {"50", color * .5f}}));
  all.push_back(gives(
      name + "Glossiness", square_in(sun_above, kAside),
      black + "Specular 1 1 1 1, SpecularLevel 1",
      {{"0", Rgb(phong(1))}, {".1", Rgb(phong(2))}, {".3", Rgb(phong(8))}, {"30", Rgb(phong(8))}}));
  const std::string glow = "Diffuse .8 .4 .2 1, SelfIllumAmount .5, SelfIllumColor " + written;
  const Rgb own(.8f, .4f, .2f);
  all.push_back(
      both(gives(name + "UseSelfIllumColor", dark, glow, {{"off", own * .5f}, {"on", color}}),
           gives(name + "UseSelfIllumColor", sun, glow, {{"off", own}, {"on", own + color}})));
  // A material with self-illumination colour is not lit.
  all.push_back(both(gives(name + "SelfIllumAmount", dark, glow,
                           {{"0", Rgb(0)}, {".25", own * .25f}, {"1", own}, {"25", own * .25f}}),
                     gives(name + "SelfIllumAmount", sun, glow, {{"0", own}, {"1", own}})));
  all.push_back(gives(name + "SelfIllumColor", dark, glow + ", UseSelfIllumColor on",
                      {{written, color}, {"2 0 1 1", Rgb(2, 0, 1)}, {"= \"tint\"", kTinted}}));
}

/// Illuminations and maps that a standard material refers to.
const std::string kParts =
    "shader \"tinted\" \"max_base_BlinnIllumination\" ( \"Diffuse\" = \"tint\" )\n"
    "shader \"lit\" \"max_base_BlinnIllumination\" ( \"Diffuse\" .8 .4 0 1 )\n"
    "shader \"shiny\" \"max_base_PhongIllumination\" ( \"Diffuse\" 0 0 0 1, \"Specular\" .2 .4 .2 "
    "1,"
    " \"SpecularLevel\" 1 )\n"
    "shader \"glowing\" \"max_base_PhongIllumination\" ( \"Diffuse\" 0 0 0 1, "
    "\"UseSelfIllumColor\" on, \"SelfIllumColor\" 1 .5 .25 1 )\n"
    "shader \"map\" \"max_RGBMultiplier\" ( \"Color1\" .6 .2 .1, \"Color2\" 1 1 1 )\n"
    "shader \"quarter\" \"max_RGBMultiplier\" ( \"Color1\" .25 .25 .25, \"Color2\" 1 1 1 )\n";
const Rgb kMap(.6f, .2f, .1f), kGlow(1, .5f, .25f), kBelow(.2f);

Stage standard(std::function<void(SceneText&)> lit) {
  return square_in(std::move(lit), {.samples = 4096}, kParts);
}
/// A list of ten maps, empty but at that place.
std::string at_place(int place, const std::string& map) {
  std::string list = "[";
  for (int i = 0; i < 10; ++i)
    list += fmt::format("{} \"{}\"", i == 0 ? "" : ",", i == place ? map : "");
  return list + " ]";
}

void add_opacity(Cases& all) {
  const std::string name = "max_StandardMaterial.";
  const Stage skies = standard(two_skies);
  const std::string glowing = "Shader \"glowing\"";
  const Rgb quarter = kGlow * .25f + kBelow * .75f;
  all.push_back(gives(name + "Opacity", skies, glowing,
                      {{"1", kGlow},
                       {".25", quarter},
                       {"25", quarter},
                       {"0", kBelow},
                       {"= \"tint\"", kGlow * .3f + kBelow * .7f}}));
  // As much light passes the surface as a blocker.
  const Stage shadow = composed(
      [](SceneText& scene, const std::string& call) {
        add_material(scene, call, kParts);
        scene.square("m", Vec3(0, 0, 1), 5, Vec3(0, 0, 1)).lambert("white", 1);
        scene.square("white", Vec3(0), 5, Vec3(0, 0, 1));
        sun_above(scene);
      },
      {.indirect = false});
  all.back() = both(all.back(), gives(name + "Opacity", shadow, "Shader \"lit\"",
                                      {{"1", Rgb(0)}, {".25", Rgb(.75f)}, {"0", Rgb(1)}}));
  all.push_back(gives(name + "FilterColor", skies, glowing + ", Opacity .5",
                      {{"1 1 1 1", (kGlow + kBelow) * .5f},
                       {"1 0 .5 1", kGlow * .5f + kBelow * Rgb(.5f, 0, .25f)}}));
  all.push_back(
      gives(name + "OpacityType", skies, glowing + ", Opacity .5, FilterColor 1 0 .5 1",
            {{"0", kGlow * .5f + kBelow * Rgb(.5f, 0, .25f)}, {"1", (kGlow + kBelow) * .5f}}));
}

void add_standard(Cases& all) {
  const std::string name = "max_StandardMaterial.";
  const Stage sun = standard(sun_above), skies = standard(two_skies);
  all.push_back(gives(name + "Shader", sun, "",
                      {{"\"lit\"", Rgb(.8f, .4f, 0)},
                       {"\"shiny\"", Rgb(.2f, .4f, .2f)},
                       {"\"tinted\"", kTinted},
                       {"\"glowing\"", kGlow}}));
  add_opacity(all);
  // Slots of the maps of colour, highlight, self-illumination, opacity and reflection.
  const std::string maps = name + "Maps", none = at_place(0, "");
  Case each =
      gives(maps, sun, "Shader \"lit\"", {{none, Rgb(.8f, .4f, 0)}, {at_place(1, "map"), kMap}});
  each = both(each, gives(maps, sun, "Shader \"shiny\"",
                          {{none, Rgb(.2f, .4f, .2f)}, {at_place(2, "map"), kMap}}));
  each = both(each, gives(maps, standard(no_light), "Shader \"shiny\"",
                          {{none, Rgb(0)}, {at_place(5, "map"), kMap}}));
  each = both(each, gives(maps, skies, "Shader \"glowing\"",
                          {{none, kGlow},
                           {at_place(6, "quarter"), kGlow * .25f + kBelow * .75f},
                           {at_place(9, "map"), Rgb(1)}}));
  all.push_back(each);
  const std::string mapped = "Shader \"lit\", Maps [ \"\", \"map\" ]";
  const Rgb mixed = Rgb(.8f, .4f, 0) * .75f + kMap * .25f;
  all.push_back(gives(name + "MapEnables", sun, mapped,
                      {{"[ on, on ]", kMap}, {"[ on, off ]", Rgb(.8f, .4f, 0)}}));
  all.push_back(gives(name + "MapAmounts", sun, mapped,
                      {{"[ 1, 1 ]", kMap},
                       {"[ 1, .25 ]", mixed},
                       {"[ 1, 25 ]", mixed},
                       {"[ 1, 0 ]", Rgb(.8f, .4f, 0)}}));
  // Of a reflection the share that mirrors, over the rest.
  all.back() =
      both(all.back(),
           gives(name + "MapAmounts", skies, "Shader \"glowing\", Maps " + at_place(9, "map"),
                 {{"[ 1, 1, 1, 1, 1, 1, 1, 1, 1, .25 ]", kGlow * .75f + Rgb(.25f)},
                  {"[ 1, 1, 1, 1, 1, 1, 1, 1, 1, 0 ]", kGlow}}));
}

Cases cases() {
  Cases all;
  add_default(all);
  for (const char* kind : {"Blinn", "Phong", "Metal", "OrenNayarBlinn", "Ward", "MultiLayer",
                           "Strauss", "Translucent"})
    add_illumination(all, fmt::format("max_base_{}Illumination", kind));
  add_standard(all);
  for (const char* shader : {"max_mrStoreElement", "max_mrStoreElements"})
    all.push_back(gives(std::string(shader) + ".Material", square_in(sun_above, {}, kParts), "",
                        {{"= \"lit\"", Rgb(.8f, .4f, 0)}, {"= \"glowing\"", kGlow}}));
  return all;
}

}  // namespace
}  // namespace other_max_materials

Cases other_max_material_cases() { return other_max_materials::cases(); }

}  // namespace oriel::effects
