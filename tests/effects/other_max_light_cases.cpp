// SPDX-License-Identifier: Apache-2.0
// Approximations of 3ds Max lights: shaders/max/max_lights.cpp.
#include "cases.h"
#include "other_stages.h"

namespace oriel::effects {
namespace other_max_lights {
namespace {

using namespace other_stages;

const Rgb kDark(0), kFull(1);

/// Two units above the square, at a place of its own, so that distances count. A cone as wide as
/// half a space takes nothing from what is below.
constexpr const char* kPlace = "origin 0 0 2 direction 0 0 -1 spread 0";
constexpr const char* kDown = "direction 0 0 -1";

Stage over_floor(const std::string& floor, const std::string& place) {
  return composed([=](SceneText& scene, const std::string& call) {
    add_material(scene, floor);
    scene.plate("m").light("l", call + " " + place);
  });
}
/// On a white square.
Stage shining(const std::string& place) {
  return over_floor("\"mib_illum_lambert\" ( \"diffuse\" 1 1 1 )", place);
}
/// A black square between the light and a white one that is seen from below it.
Stage over_blocker(const std::string& place) {
  return composed([=](SceneText& scene, const std::string& call) {
    scene.lambert("white", 1).lambert("black", 0).square("white", Vec3(0), 5, Vec3(0, 0, 1));
    scene.square("black", Vec3(0, 0, 1), 5, Vec3(0, 0, 1)).light("l", call + " " + place);
  });
}

void add_strength(Cases& all, const std::string& name, const std::string& place) {
  all.push_back(
      gives(name + ".Color", shining(place), "Multiplier 2",
            {{"1 1 1 1", Rgb(2)}, {".5 .25 0 1", Rgb(1, .5f, 0)}, {"= \"tint\"", kTinted * 2.f}}));
  all.push_back(gives(name + ".Multiplier", light(place), "Color 1 .5 .25 1",
                      {{"0", kDark}, {"1", Rgb(1, .5f, .25f)}, {"3", Rgb(3, 1.5f, .75f)}}));
}

void add_switches(Cases& all, const std::string& name, const std::string& place) {
  all.push_back(gives(name + ".On", light(place), "", {{"on", kFull}, {"off", kDark}}));
  all.push_back(gives(name + ".AffectDiffuse", light(place), "", {{"on", kFull}, {"off", kDark}}));
  // Phong's highlight in the mirrored view is its colour.
  const Stage shiny =
      over_floor("\"mib_illum_phong\" ( \"specular\" .5 .5 .5, \"exponent\" 20 )", place);
  all.push_back(gives(name + ".AffectSpecular", shiny, "", {{"on", Rgb(.5f)}, {"off", kDark}}));
  all.back() = both(all.back(), gives(name + ".AffectSpecular", shiny, "AffectDiffuse off",
                                      {{"on", Rgb(.5f)}, {"off", kDark}}));
  all.push_back(
      gives(name + ".CastShadows", over_blocker(place), "", {{"on", kDark}, {"off", kFull}}));
  all.push_back(gives(name + ".ShadowDensity", over_blocker(place), "",
                      {{"1", kDark}, {".25", Rgb(.75f)}, {"0", kFull}}));
}

/// At a distance of 2: half way of a range that surrounds it evenly, half of the light.
void add_ranges(Cases& all, const std::string& name, const std::string& place) {
  const Stage stage = light(place);
  const Rgb half(.5f);
  const std::string near = "UseNearAttenuation on, ", far = "UseFarAttenuation on, ";
  all.push_back(gives(name + ".UseNearAttenuation", stage, "NearStart 2, NearEnd 4",
                      {{"off", kFull}, {"on", kDark}}));
  all.push_back(gives(name + ".NearStart", stage, near + "NearEnd 4",
                      {{"0", half}, {"2", kDark}, {"3", kDark}}));
  all.push_back(gives(name + ".NearEnd", stage, near + "NearStart 1",
                      {{"1.5", kFull}, {"2", kFull}, {"3", half}}));
  all.push_back(gives(name + ".UseFarAttenuation", stage, "FarStart 1, FarEnd 2",
                      {{"off", kFull}, {"on", kDark}}));
  all.push_back(gives(name + ".FarStart", stage, far + "FarEnd 4",
                      {{"0", half}, {"2", kFull}, {"3", kFull}}));
  all.push_back(gives(name + ".FarEnd", stage, far + "FarStart 1",
                      {{"1.5", kDark}, {"2", kDark}, {"3", half}}));
  all.push_back(gives(name + ".Decay", stage, "DecayRadius .5",
                      {{"0", kFull}, {"1", Rgb(.25f)}, {"2", Rgb(.0625f)}}));
  all.push_back(gives(name + ".DecayRadius", stage, "Decay 2",
                      {{".5", Rgb(.0625f)}, {"1", Rgb(.25f)}, {"2", kFull}, {"4", kFull}}));
}

/// Seen where the way from the light is 45 degrees from its axis. Widths are whole angles.
void add_cone(Cases& all) {
  const float cosine = std::sqrt(.5f);
  const Rgb lit(cosine), half(cosine / 2);
  const Stage aside = light("origin 0 0 2 direction 0 0 -1 spread 0", Vec3(2, 0, 0));
  all.push_back(
      both(gives("max_SpotLight.HotSpot", aside, "Falloff 100",
                 {{"80", half}, {"1.3962634", half}, {"92", lit}}),
           rises("max_SpotLight.HotSpot", aside, "Falloff 100", {"10", "60", "80", "89"})));
  all.push_back(gives("max_SpotLight.Falloff", aside, "HotSpot 60",
                      {{"80", kDark}, {"89", kDark}, {"120", half}, {"2.0943951", half}}));
  all.back() =
      both(all.back(), rises("max_SpotLight.Falloff", aside, "HotSpot 60", {"100", "120", "150"}));
}

Cases cases() {
  Cases all;
  for (const char* name : {"max_DefaultLight", "adsk_Light_Default"})
    add_strength(all, name, kDown);
  const struct {
    const char *name, *strength_from;
  } lights[] = {{"max_OmniLight", "origin 0 0 2"},
                {"max_SpotLight", kPlace},
                {"max_DirectionalLight", kDown}};
  for (const auto& l : lights) {
    add_strength(all, l.name, l.strength_from);
    add_switches(all, l.name, l.strength_from);
    add_ranges(all, l.name, kPlace);
  }
  add_cone(all);
  return all;
}

}  // namespace
}  // namespace other_max_lights

Cases other_max_light_cases() { return other_max_lights::cases(); }

}  // namespace oriel::effects
