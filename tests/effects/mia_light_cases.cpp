// SPDX-License-Identifier: Apache-2.0
// Photometric and portal lights, and visible light surfaces: mia_photometric_light.cpp,
// mia_portal_light.cpp and mia_light_surface.cpp in shaders/architectural.
#include <fmt/format.h>

#include <fstream>

#include "base/math.h"
#include "cases.h"
#include "mia_stages.h"
#include "support/files.h"
#include "support/portal_scenes.h"
#include "transport/photon/photon_trace.h"

namespace oriel::effects {
namespace mia_light {

/// What a white Lambert surface shows under a lux.
constexpr float kPerLux = kInvPi;

/// The shader of a light at (0, 0, 2) above a white Lambert square, seen at a place. Two profiles
/// are there: "even", 100 cd in all directions, and "down", 300 cd to the lower half space.
Stage lamp(const Vec3& at = Vec3(0), const std::string& element = "origin 0 0 2") {
  return [=](const std::string& call) {
    const TestFolder folder;
    SceneText scene;
    for (const auto& [name, figures] :
         {std::pair("even", "2 1 1 2 0 0 0 1 1 40\n0 180\n0\n100 100\n"),
          {"down", "3 1 1 2 0 0 0 1 1 40\n0 90 90.01\n0\n300 300 0\n"}}) {
      const std::string path = folder.file(std::string(name) + ".ies");
      std::ofstream(path) << "IESNA91\nTILT=NONE\n1 -1 1 " << figures;
      scene.statement(
          fmt::format("lightprofile \"{}\" format ies file \"{}\" end lightprofile", name, path));
    }
    scene.statement("shader \"warm\" \"test_show\" ( \"color\" 1 .5 0 )");
    scene.lambert("white", 1).square("white", Vec3(0), 5, kUp).light("l", call + " " + element);
    return Probe(scene.str(), known_shaders()).direct_only().onto(at, kUp, 0, 64);
  };
}
/// Candela at the zenith of the square, straight below the light.
Rgb below(float candela) { return Rgb(candela / 4 * kPerLux); }

/// A light straight down, in a cone of 60 degrees to each side.
const std::string kSpot = "origin 0 0 2 direction 0 0 -1 spread .5";

void add_photometric(Cases& all) {
  const std::string name = "mia_photometric_light.";
  const std::string candela = "manual_peak_intensity_cd 100";
  all.push_back(gives(name + "on", lamp(), candela, {{"on", below(100)}, {"off", Rgb(0)}}));
  for (const char* factor : {"multiplier", "cm2_factor"})
    all.push_back(gives(name + factor, lamp(), candela,
                        {{"0", Rgb(0)}, {"1", below(100)}, {"3", below(300)}}));
  all.push_back(gives(name + "color", lamp(), candela,
                      {{"1 1 1", below(100)},
                       {"1 .5 0", Rgb(1, .5f, 0) * below(100)},
                       {"= \"warm\"", Rgb(1, .5f, 0) * below(100)}}));
  // Two units are two metres, one, or four: half the way, four times the light.
  all.push_back(gives(name + "units_to_meter_scale", lamp(), candela,
                      {{"1", below(100)}, {".5", below(400)}, {"2", below(25)}}));
  all.push_back(gives(name + "manual_peak_intensity_cd", lamp(), "manual_flux_lm 9",
                      {{"0", Rgb(0)}, {"100", below(100)}, {"700", below(700)}}));
  all.push_back(
      gives(name + "manual_flux_lm", lamp(), candela + ", intensity_mode 1",
            {{"0", Rgb(0)}, {"1000", below(1000 / (4 * kPi))}, {"7000", below(7000 / (4 * kPi))}}));
  // The flux of "even" is 100 cd all around.
  const std::string lumen = candela + ", manual_flux_lm 1000, profile \"even\"";
  all.push_back(gives(name + "intensity_mode", lamp(), "multiplier 2, " + lumen,
                      {{"0", below(200)}, {"1", below(2000 / (4 * kPi))}, {"2", below(200)}}));
  all.back() = both(
      all.back(), gives_about(name + "intensity_mode", lamp(),
                              lumen + ", profile \"down\", distribution_mode 2",
                              {{"0", below(100)}, {"1", below(1000 / kTwoPi)}, {"2", below(300)}}));
  // 1000 lm evenly, within a cone of 2 pi (1 - cos 60) sr, and to the lower half space.
  all.push_back(gives_about(
      name + "distribution_mode", lamp(Vec3(0), kSpot),
      "intensity_mode 1, manual_flux_lm 1000, profile \"down\"",
      {{"0", below(1000 / (4 * kPi))}, {"1", below(1000 / kPi)}, {"2", below(1000 / kTwoPi)}}));
  // At 45 degrees from the axis: cos^bias of the peak, at twice the squared distance and aslant.
  const float slant = math::pow(.5f, .5f);
  const auto aside = [&](float bias) {
    return Rgb(100 * math::pow(slant, bias) / 8 * slant * kPerLux);
  };
  all.push_back(both(
      gives(name + "spotlight_cosine_bias", lamp(Vec3(2, 0, 0), kSpot),
            candela + ", distribution_mode 1", {{"0", aside(0)}, {"1", aside(1)}, {"5", aside(5)}}),
      gives(name + "spotlight_cosine_bias", lamp(Vec3(0), kSpot), candela + ", distribution_mode 1",
            {{"0", below(100)}, {"5", below(100)}})));
  const std::string measured = "distribution_mode 2, intensity_mode 2";
  all.push_back(gives(name + "profile", lamp(), measured,
                      {{"\"even\"", below(100)}, {"\"down\"", below(300)}}));
  // It counts before that of the light's own element.
  all.back() =
      both(all.back(), gives(name + "profile", lamp(Vec3(0), "origin 0 0 2 lightprofile \"down\""),
                             measured, {{"\"even\"", below(100)}, {"\"\"", below(300)}}));
}

/// A white card at a distance of 1 from a window of one square unit that
/// shines toward it, in an even environment of radiance 1.
SceneText window(const std::string& call, const std::string& custom = {}) {
  SceneText scene;
  scene.statement(custom).uniform_sky(1);
  scene.lambert("card", 1).square("card", Vec3(1, 0, 0), .01f, Vec3(-1, 0, 0));
  // x/y of the light are y/z of the world; the square is about the origin.
  return scene.light("window", call + " origin 0 0 0 rectangle 1 0 0 0 1 0 3 3",
                     "visible on transform 0 0 1 0  1 0 0 0  0 1 0 0  0 0 0 1");
}
/// Form factor of the unit square at 1.
constexpr float kForm = .2394565f;
const Vec3 kIn(1, 0, 0);

Measured card_of(const SceneText& scene) {
  return Probe(scene.str(), known_shaders())
      .direct_only()
      .onto(Vec3(1, 0, 0), -kIn, 0, 1 << 11, .05f);
}
/// What the card shows of the window's direct light. `board` is a place on x for a black board.
Stage card(const std::string& custom = {}, float board = 0) {
  return [=](const std::string& call) {
    SceneText scene = window(call, custom);
    if (board != 0) scene.lambert("black", 0).square("black", Vec3(board, 0, 0), 4, kIn);
    return card_of(scene);
  };
}
/// What the eye sees of it from inside, and a mirror.
Stage view(const std::string& custom = {}) {
  return [=](const std::string& call) {
    return Probe(window(call, custom).str(), known_shaders()).ray(Vec3(.5f, .1f, .1f), -kIn, 64);
  };
}
Stage mirrored(const std::string& custom = {}) {
  return [=](const std::string& call) {
    SceneText scene = window(call, custom);
    scene
        .material("mirror",
                  "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
                  "\"brdf_90_degree_refl\" 1")
        .square("mirror", Vec3(.9f, 0, 0), .4f, -kIn);
    return Probe(scene.str(), known_shaders()).ray(Vec3(.5f, .1f, .1f), kIn, 64);
  };
}
/// Power of the photons that are left on the dark walls of a room behind the window.
float power_of_photons(const std::string& call) {
  SceneText scene = window(call);
  scene.lambert("dark", .001f).box("dark", Vec3(-.01f, -2, -2), Vec3(4, 2, 2), true);
  const Probe probe(scene.str(), known_shaders());
  PhotonSettings settings;
  settings.each.global.emit = 1 << 13;
  RayCounts counts;
  double power = 0;  // double: many terms
  const PhotonMaps maps = trace_photons(probe.world(), settings, counts);
  for (const Photon& p : maps.global.photons()) power += double(p.power.y);
  return float(power);
}

void add_portal(Cases& all) {
  const std::string name = "mia_portal_light.";
  const Rgb lit(kForm), dark(0);
  const Stage light = card();
  all.push_back(gives(name + "on", light, "", {{"on", lit}, {"off", dark}}));
  all.push_back(
      gives(name + "multiplier", light, "", {{"0", dark}, {"1", lit}, {"3", lit * 3.0f}}));
  all.push_back(gives(name + "tint_color", light, "",
                      {{"1 1 1", lit}, {".5 1 .25", lit * Rgb(.5f, 1, .25f)}}));
  all.push_back(gives(name + "reverse", light, "", {{"off", lit}, {"on", dark}}));
  // Seen from the card, the middle of the window is 1 / pi bright and its corners (2 / 3)^2 of
  // that.
  all.push_back(
      both(gives(name + "cutoff_threshold", light, "", {{"0", lit}, {".1", lit}, {".32", dark}}),
           shows(name + "cutoff_threshold", [=] {
             const auto shadow_rays = [&](const char* level) {
               return measured_with(name + "cutoff_threshold", light, "", level).counts.shadow;
             };
             EXPECT_GT(shadow_rays(".1"), 0u);
             EXPECT_EQ(shadow_rays(".32"), 0u);
           })));
  all.push_back(both(gives(name + "shadows", card({}, .5f), "", {{"on", dark}, {"off", lit}}),
                     gives(name + "shadows", light, "", {{"on", lit}, {"off", lit}})));
  const std::string own =
      "shader \"red\" \"test_show\" ( \"color\" 2 0 0 )\n"
      "shader \"blue\" \"test_show\" ( \"color\" 0 0 3 )\n"
      "shader \"kinds\" \"mia_light_surface\" ( \"intensity\" 1, \"fg_contrib\" .25 )";
  const std::string custom = "use_custom_environment on";
  // On without a shader it is a white card.
  all.push_back(both(gives(name + "use_custom_environment", card(own), "custom_environment \"red\"",
                           {{"off", lit}, {"on", lit * Rgb(2, 0, 0)}}),
                     gives(name + "use_custom_environment", light, "multiplier 2",
                           {{"off", lit * 2}, {"on", lit * 2}})));
  all.push_back(gives(name + "custom_environment", card(own), custom,
                      {{"\"red\"", lit * Rgb(2, 0, 0)}, {"\"blue\"", lit * Rgb(0, 0, 3)}}));
  // The eye and mirrors see the sky of 1, or the window of 6.
  for (const Stage& stage : {view(own), mirrored(own)}) {
    const Case c =
        gives(name + "visible", stage, custom + ", custom_environment \"blue\", multiplier 2",
              {{"off", Rgb(1)}, {"on", Rgb(0, 0, 6)}});
    if (all.back().parameter == c.parameter)
      all.back() = both(all.back(), c);
    else
      all.push_back(c);
  }
  // A quarter to gather rays, all of it to others.
  all.push_back(gives(name + "lookup_using_fg_rays", card(own),
                      custom + ", custom_environment \"kinds\"",
                      {{"on", lit * .25f}, {"off", lit}}));
  // A board outside is reached by shadow rays that begin farther outside, one inside left behind.
  all.push_back(both(gives(name + "shadow_ray_extension", card({}, -.3f), "",
                           {{"0", lit}, {".2", lit}, {".8", dark}}),
                     gives(name + "shadow_ray_extension", card({}, .2f), "",
                           {{"0", dark}, {"-.1", dark}, {"-.5", lit}})));
  // No direct light: photons contribute it at their first hit, pi of flux per unit of area.
  all.push_back(both(gives(name + "emit_direct_photons", light, "", {{"off", lit}, {"on", dark}}),
                     shows(name + "emit_direct_photons", [] {
                       const auto power = [](const char* on) {
                         return power_of_photons(
                             call_of("mia_portal_light", std::string("emit_direct_photons ") + on));
                       };
                       EXPECT_LT(power("off"), .01f * kPi);
                       EXPECT_NEAR(power("on"), kPi, .02f * kPi);
                     })));
  // Tint of the view, and a factor for the visible brightness of the window; its light is
  // unchanged.
  const Rgb gel(.5f, .25f, 1);
  all.push_back(gives(name + "transparency", light, "visible on",
                      {{"1 1 1", lit}, {".5 .25 1", lit}, {"0 0 0", lit}}));
  for (const Stage& stage : {view(), mirrored()})
    for (const char* visible : {"off", "on"}) {
      const float seen = visible == std::string("on") ? 2 : 1;
      all.back() =
          both(all.back(),
               gives(name + "transparency", stage, std::string("multiplier 2, visible ") + visible,
                     {{"1 1 1", Rgb(seen)}, {".5 .25 1", gel * seen}, {"0 0 0", dark}}));
    }
}

/// Result of the shader at the origin for rays of a kind. Two lights are there: "red", whose light
/// is 1 up to a unit from it and falls to 0 at 3, at (0, 0, 2), and "green", .5 everywhere.
Stage shown_to(RayKind kind) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.statement("shader \"warm\" \"test_show\" ( \"color\" 1 .5 0 )")
        .statement("shader \"s\" " + call)
        .statement("material \"m\" \"test_show\" ( \"color\" = \"s\" ) end material")
        .square("m", Vec3(0), 1, kUp)
        .lambert("black", 0)
        .square("black", Vec3(0, 0, 1.5f), 1, kUp)  // shadows are off
        .light("red",
               "\"mib_light_point\" ( \"color\" 1 0 0, \"shadow\" on, \"atten\" on, \"start\" 1, "
               "\"stop\" 3 ) origin 0 0 0",
               "transform 1 0 0 0  0 1 0 0  0 0 1 0  0 0 -2 1")
        .light("green", "\"mib_light_point\" ( \"color\" 0 .5 0 ) origin 5 5 5");
    const Probe probe(scene.str(), known_shaders());
    for (const Material& m : probe.world().materials) {
      if (m.name != "m") continue;
      ShadingPoint point;
      point.ray_kind = kind;
      point.world = &probe.world();
      Closure closure;
      shade(m, point, closure);
      return exactly(closure.emission);
    }
    throw std::runtime_error("no material m");
  };
}

void add_surface(Cases& all) {
  const std::string name = "mia_light_surface.";
  const Stage eye = shown_to(RayKind::Eye), gather = shown_to(RayKind::FinalGather),
              reflect = shown_to(RayKind::Reflect);
  const std::string both_lights = "use_lights on, lights [\"red_i\", \"green_i\"]";
  // Two units from the red light half of it is left.
  const Rgb lights(.5f, .5f, 0);
  all.push_back(
      both(gives(name + "color", eye, "intensity 2",
                 {{"1 1 1", Rgb(2)}, {"1 .5 0", Rgb(2, 1, 0)}, {"= \"warm\"", Rgb(2, 1, 0)}}),
           gives(name + "color", eye, "intensity 0, " + both_lights,
                 {{"1 1 1", lights}, {"3 .5 0", lights * Rgb(3, .5f, 0)}})));
  all.push_back(gives(name + "intensity", eye, both_lights,
                      {{"0", lights}, {"1", lights + Rgb(1)}, {"4", lights + Rgb(4)}}));
  all.push_back(
      both(gives(name + "fg_contrib", gather, "intensity 2, refl_contrib .7",
                 {{"0", Rgb(0)}, {".25", Rgb(.5f)}, {"1", Rgb(2)}}),
           gives(name + "fg_contrib", eye, "intensity 2", {{"0", Rgb(2)}, {".25", Rgb(2)}})));
  all.push_back(
      both(gives(name + "refl_contrib", reflect, "intensity 2, fg_contrib .7",
                 {{"0", Rgb(0)}, {".25", Rgb(.5f)}, {"1", Rgb(2)}}),
           gives(name + "refl_contrib", eye, "intensity 2", {{"0", Rgb(2)}, {".25", Rgb(2)}})));
  for (const char* share : {"fg_contrib", "refl_contrib"})
    for (Case& c : all)
      if (c.parameter == name + share)
        c = both(c,
                 gives(c.parameter, c.parameter.find("fg") == c.parameter.npos ? reflect : gather,
                       "intensity 0, " + both_lights, {{".5", lights * .5f}, {"1", lights}}));
  all.push_back(
      gives(name + "use_lights", eye, both_lights, {{"off", Rgb(1)}, {"on", lights + Rgb(1)}}));
  all.push_back(gives(name + "lights_multiplier", eye, "intensity 0, " + both_lights,
                      {{"0", Rgb(0)}, {"1", lights}, {".5", lights * .5f}, {"3", lights * 3.0f}}));
  all.push_back(gives(name + "lights", eye, "intensity 0, use_lights on",
                      {{"[]", Rgb(0)},
                       {"[\"red_i\"]", Rgb(.5f, 0, 0)},
                       {"[\"green_i\"]", Rgb(0, .5f, 0)},
                       {"[\"red_i\", \"green_i\"]", lights}}));
  // In the light's own space; 0 0 0 is the place seen.
  all.push_back(gives(name + "lights_eval_point", eye,
                      "intensity 0, use_lights on, lights [\"red_i\"]",
                      {{"0 0 0", Rgb(.5f, 0, 0)},
                       {"0 0 -2", Rgb(.5f, 0, 0)},
                       {"0 0 -1", Rgb(1, 0, 0)},
                       {"0 2.5 0", Rgb(.25f, 0, 0)},
                       {"4 0 0", Rgb(0)}}));
}

}  // namespace mia_light

Cases mia_light_cases() {
  Cases all;
  mia_light::add_photometric(all);
  mia_light::add_portal(all);
  mia_light::add_surface(all);
  return all;
}

}  // namespace oriel::effects
