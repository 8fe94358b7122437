// SPDX-License-Identifier: Apache-2.0
// Lights, shadows and light maps: shaders/base/mib_light.cpp, mib_light_photometric.cpp,
// mib_shadow.cpp, mib_lightmap.cpp.
#include <fmt/format.h>

#include <fstream>

#include "base/temporary_folder.h"
#include "base_stages.h"
#include "cases.h"

namespace oriel::effects {
namespace base_light {

const Vec3 kFront(0, 0, 1);

/// Radiance of a white Lambert floor in the shadow of an opaque card.
Stage below_card(const std::string& element) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.lambert("white", 1).square("white", Vec3(0), 5, kFront);
    scene.lambert("black", 0).square("black", kFront, .5f, kFront).light("l", call + " " + element);
    Probe probe(scene.str(), known_shaders());
    return probe.direct_only().onto(Vec3(0), kFront, 0, 64);
  };
}

/// The parameters that all lights have. `share`: radiance of the floor for color 1.
void add_common(Cases& all, const std::string& shader, const std::string& element, float share) {
  const std::string white = "color 1 1 1 1";
  all.push_back(gives(
      shader + ".color", light(element), "",
      {{"0 0 0 1", Rgb(0)}, {"1 1 1 1", Rgb(share)}, {"2 .5 .25 0", Rgb(2, .5f, .25f) * share}}));
  all.push_back(
      gives(shader + ".shadow", below_card(element), white, {{"off", Rgb(share)}, {"on", Rgb(0)}}));
  all.push_back(gives(shader + ".factor", below_card(element), white + ", shadow on",
                      {{"0", Rgb(0)}, {".25", Rgb(.25f * share)}, {"1", Rgb(share)}}));
}

/// The linear fade from `start` to `stop`, measured at a distance of 2.
void add_range(Cases& all, const std::string& shader, const std::string& element,
               const std::string& others, float share) {
  all.push_back(gives(shader + ".start", light(element), others + ", stop 3",
                      {{"0", Rgb(share / 3)}, {"1", Rgb(share / 2)}, {"2.5", Rgb(share)}}));
  all.push_back(gives(shader + ".stop", light(element), others + ", start 1",
                      {{"1.5", Rgb(0)}, {"3", Rgb(share / 2)}, {"5", Rgb(.75f * share)}}));
}

void add_simple(Cases& all) {
  const std::string spot = "origin 0 0 2 direction 0 0 -1 spread .8";
  add_common(all, "mib_light_infinite", "direction 0 0 -1", 1);
  for (const auto& [shader, element] :
       {std::pair<std::string, std::string>("mib_light_point", "origin 0 0 2"),
        {"mib_light_spot", spot}}) {
    add_common(all, shader, element, 1);
    add_range(all, shader, element, "color 1 1 1 1, atten on", 1);
    all.push_back(gives(shader + ".atten", light(element), "color 1 1 1 1, start 1, stop 3",
                        {{"off", Rgb(1)}, {"on", Rgb(.5f)}}));
  }
  // One unit from the axis, the cosine of incidence and that of the spot are both 2 / sqrt(5).
  const float cosine = 2 / std::sqrt(5.0f);
  const Stage aside = light(spot, Vec3(1, 0, 0));
  all.push_back(
      both(gives("mib_light_spot.cone", aside, "color 1 1 1 1",
                 {{".82", Rgb(cosine)}, {".89", Rgb(cosine)}}),
           falls("mib_light_spot.cone", aside, "color 1 1 1 1", {".88", ".92", ".97", "1"})));
  all.back() = both(all.back(), gives("mib_light_spot.cone", light(spot), "color 1 1 1 1",
                                      {{".82", Rgb(1)}, {".999", Rgb(1)}}));
}

/// The light above a white floor; the isotropic profiles "500" and "1000" are in candela.
Measured with_profiles(const std::string& call) {
  const TemporaryFolder folder;
  SceneText scene;
  for (const int candela : {500, 1000}) {
    const std::string file = folder.file(fmt::format("{}.ies", candela));
    std::ofstream(file) << "IESNA91\nTILT=NONE\n1 -1 10 2 1 1 2 0 0 0 1 1 40\n0 180\n0\n"
                        << fmt::format("{0} {0}", candela / 10);
    scene.statement(
        fmt::format("lightprofile \"{}\" format ies file \"{}\" end lightprofile", candela, file));
  }
  scene.lambert("white", 1).square("white", Vec3(0), 5, kFront);
  scene.light("l", call + " origin 0 0 2");
  return Probe(scene.str(), known_shaders()).onto(Vec3(0), kFront, 0, 64);
}

void add_photometric(Cases& all) {
  // Radiance of a white Lambert surface at distance d from 1 cd: 1 / (d^2 pi).
  const std::string shader = "mib_light_photometric";
  const float share = 1 / (4 * kPi);
  add_common(all, shader, "origin 0 0 2", share);
  add_range(all, shader, "origin 0 0 2", "color 1 1 1 1", share);
  all.push_back(gives(shader + ".profile", with_profiles, "color 1 1 1 1",
                      {{"\"500\"", Rgb(500 * share)}, {"\"1000\"", Rgb(1000 * share)}}));
}

/// A directional light on a dark glossy floor, seen along the normal.
Measured highlight_on_floor(const std::string& call) {
  SceneText scene;
  scene.statement(
      "material \"shiny\" \"oriel_plastic\" ( \"diffuse\" 0 0 0, \"roughness\" .5 ) end material");
  scene.square("shiny", Vec3(0), 5, kFront).light("l", call + " direction 0 0 -1");
  return Probe(scene.str(), known_shaders()).onto(Vec3(0), kFront, 0, 64);
}

void add_by_lobe(Cases& all) {
  const std::string shader = "oriel_light", above = "origin 0 0 2", white = "color 1 1 1 1";
  // Intensity 1 / (4 pi) at a distance of 2; a colour of radiance shows 1 / pi of the irradiance.
  const float share = 1 / (16 * kPi);
  all.push_back(gives(shader + ".color", light(above), "",
                      {{"1 1 1 1", Rgb(share)}, {"20 5 0 1", Rgb(20, 5, 0) * share}}));
  all.push_back(gives(shader + ".shadow", below_card(above), "color 9 9 9 1",
                      {{"off", Rgb(9 * share)}, {"on", Rgb(0)}}));
  all.push_back(gives(shader + ".profile", with_profiles, white,
                      {{"\"500\"", Rgb(500 / (4 * kPi))}, {"\"1000\"", Rgb(1000 / (4 * kPi))}}));
  // At 1 of 2 units from the axis the cosine is .8944, between the spread .8 and the cone.
  const std::string spot = "origin 0 0 2 direction 0 0 -1 spread .8";
  const float lit = 1 / (4 * kPi) / 5 * .8944272f * 100;
  all.push_back(gives(shader + ".cone", light(spot, Vec3(1, 0, 0)), "color 100 100 100 1",
                      {{".85", Rgb(lit)}, {"1", Rgb(lit * .4721360f)}}));
  const std::string sun = "direction 0 0 -1";
  all.push_back(both(
      gives(shader + ".diffuse", light(sun), white,
            {{"1", Rgb(1)}, {".25", Rgb(.25f)}, {"0", Rgb(0)}}),
      gives(shader + ".diffuse", highlight_on_floor, white, {{"1", Rgb(.16f)}, {"0", Rgb(.16f)}})));
  all.push_back(both(gives(shader + ".glossy", highlight_on_floor, white,
                           {{"1", Rgb(.16f)}, {".5", Rgb(.08f)}, {"0", Rgb(0)}}),
                     gives(shader + ".glossy", light(sun), white, {{"1", Rgb(1)}, {"0", Rgb(1)}})));
}

/// Adds an infinite light of that colour and its instance "name_i".
void add_sun(SceneText& scene, const std::string& name, const Vec3& color, const Vec3& direction) {
  scene.light(name,
              fmt::format("\"mib_light_infinite\" ( \"color\" {}, \"shadow\" on ) direction {}",
                          text_of(color), text_of(direction)));
}

/// Radiance of a white floor in two lights from above, "red" and "cyan", behind a card with that
/// shadow shader.
Measured filtered(const std::string& call) {
  SceneText scene;
  add_sun(scene, "red", Vec3(1, 0, 0), -kFront);
  add_sun(scene, "cyan", Vec3(0, 1, 1), -kFront);
  scene.lambert("white", 1).square("white", Vec3(0), 5, kFront);
  scene.statement("material \"card\" \"mib_illum_lambert\" ( ) shadow " + call + " end material")
      .square("card", kFront, 2, kFront);
  Probe probe(scene.str(), known_shaders());
  return probe.direct_only().onto(Vec3(0), kFront, 0, 64);
}

void add_shadow(Cases& all) {
  const std::string name = "mib_shadow_transparency.";
  all.push_back(both(gives(name + "color", filtered, "transp 1 1 1",
                           {{"1 .5 .25 1", Rgb(1, .5f, .25f)}, {".5 1 0 1", Rgb(.5f, 1, 0)}}),
                     gives(name + "color", filtered, "",
                           {{".5 1 .25 0", Rgb(.5f, 1, .25f)}, {".5 1 .25 1", Rgb(0)}})));
  all.push_back(gives(name + "transp", filtered, "color 1 .5 1 1",
                      {{"0 0 0 0", Rgb(0)}, {".25 .5 1 0", Rgb(.25f, .25f, 1)}}));
  const std::string half = "color 1 1 1 1, transp .5 .5 .5";
  const Rgb red(.5f, 1, 1), others(1, .5f, .5f);
  all.push_back(gives(name + "mode", filtered, half + ", lights [ \"red_i\" ]",
                      {{"0", red}, {"1", red}, {"2", others}, {"4", Rgb(.5f)}}));
  all.push_back(gives(name + "lights", filtered, half,
                      {{"[ \"red_i\" ]", red},
                       {"[ \"cyan_i\" ]", others},
                       {"[ \"red_i\", \"cyan_i\" ]", Rgb(.5f)},
                       {"[ ]", Rgb(.5f)}}));
}

/// The result on a surface with a red and a green sun in front and a blue sun behind, in a sky of
/// radiance .5.
Measured lit_from_both_sides(const std::string& call) {
  SceneText scene;
  add_sun(scene, "red", Vec3(1, 0, 0), -kFront);
  add_sun(scene, "green", Vec3(0, 2, 0), Vec3(0, .6f, -.8f));
  add_sun(scene, "blue", Vec3(0, 0, 1), kFront);
  scene.statement(shown_as_light(call)).square("m", Vec3(0), 5, kFront).uniform_sky(.5f);
  return Probe(scene.str(), known_shaders()).onto(Vec3(0), kFront, 20, 4096);
}

void add_lightmap(Cases& all) {
  const std::string name = "mib_lightmap_sample.";
  const Rgb front(1, 1.6f, 0), back(0, 0, 1);
  all.push_back(gives(name + "indirect", lit_from_both_sides, "",
                      {{"off", front}, {"on", front + Rgb(.5f)}}));
  all.push_back(gives(name + "flip", lit_from_both_sides, "",
                      {{"0", front}, {"1", back}, {"2", front + back}}));
  all.back() = both(all.back(), gives(name + "flip", lit_from_both_sides, "indirect on",
                                      {{"1", back + Rgb(.5f)}, {"2", front + back + Rgb(1)}}));
  all.push_back(gives(name + "lights", lit_from_both_sides, "flip 2",
                      {{"[ \"red_i\" ]", Rgb(1, 0, 0)},
                       {"[ \"green_i\", \"blue_i\" ]", Rgb(0, 1.6f, 1)},
                       {"[ ]", front + back}}));
}

Cases cases() {
  Cases all;
  add_simple(all);
  add_photometric(all);
  add_by_lobe(all);
  add_shadow(all);
  add_lightmap(all);
  return all;
}

}  // namespace base_light

Cases base_light_cases() { return base_light::cases(); }

}  // namespace oriel::effects
