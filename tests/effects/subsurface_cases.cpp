// SPDX-License-Identifier: Apache-2.0
// The subsurface library: shaders/subsurface. Under a sun or a sky that make white 1, a layer shows
// its colour times its weight: the profile is normalised, and the light is even.
#include <algorithm>
#include <cmath>

#include "base_stages.h"
#include "cases.h"
#include "maya_stages.h"

namespace oriel::effects {
namespace subsurface {
namespace {

/// Elements that parameters name: materials that emit or reflect, and bump shaders.
const std::string kInputs =
    kRampTexture +
    "shader \"shown\" \"maya_surfaceshader\" ( \"outColor\" .2 .4 .6 )\n"
    "shader \"dull\" \"maya_lambert\" ( \"color\" .5 .5 .5, \"diffuse\" 1 )\n"
    "shader \"flat\" \"mib_passthrough_bump_map\" ( \"u\" 1 0 0, \"v\" 0 1 0, \"tex\" \"t\", "
    "\"coord\" .375 .375 0, \"step\" .25 .25 0, \"factor\" 1e-6 )\n"
    "shader \"steep\" \"mib_passthrough_bump_map\" ( \"u\" 1 0 0, \"v\" 0 1 0, \"tex\" \"t\", "
    "\"coord\" .375 .375 0, \"step\" .25 .25 0, \"factor\" 6 )\n";
/// Of the normal (.4, .4, 1): the texture rises by .2 / 3 per step, times the factor 6.
const float kSteepCosine = 1 / std::sqrt(1 + 2 * .16f);

enum class From { Above, Below, Sky };

/// The shader on a square, seen at `degrees` from its normal.
Stage lit(From from = From::Above, float degrees = 0) {
  return [=](const std::string& call) {
    SceneText scene;
    scene
        .statement(kInputs + "shader \"s\" " + call +
                   "\nmaterial \"m\" = \"s\" shadow = \"s\" end material")
        .plate("m");
    if (from == From::Sky)
      scene.uniform_sky(1);
    else
      scene.light("sun", fmt::format("\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) "
                                     "direction 0 0 {}",
                                     from == From::Above ? -1 : 1));
    return Probe(scene.str(), known_shaders())
        .onto(Vec3(0), Vec3(0, 0, 1), degrees, from == From::Sky ? 1024 : 64);
  };
}

/// What a white layer shows at that distance from the edge of a shadow, on the lit side: the
/// profile of Christensen and Burley 2015 with d = radius / 8, cut off at the radius, by
/// quadrature. Of a circle around the point, acos(distance / r) / pi lies in the shadow.
float beside_shadow(double distance, double radius) {
  constexpr int kSteps = 4000;
  const double d = radius / 8;
  double all = 0, lit = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double r = radius * (i + .5) / kSteps;
    const double share = std::exp(-r / d) + std::exp(-r / (3 * d));
    all += share;
    lit += share * (r > distance ? 1 - std::acos(distance / r) / double{kPi} : 1);
  }
  return static_cast<float>(lit / all);
}

constexpr float kBesideShadow = .1f;

/// A body with its upper side at z = 0 and that thickness, 0 = a single sheet, of which a black
/// square shades the half x < -kBesideShadow from the sun above or below; seen at the origin.
Stage half_shaded(From from, float thickness) {
  return [=](const std::string& call) {
    const float side = from == From::Below ? -1.0f : 1.0f;
    SceneText scene;
    scene
        .statement(kInputs + "shader \"s\" " + call +
                   "\nmaterial \"m\" = \"s\" shadow = \"s\" end material")
        .lambert("black", 0)
        .square("black", Vec3(-9 - kBesideShadow, 0, 2 * side), 9, Vec3(0, 0, side));
    if (thickness > 0)
      scene.box("m", Vec3(-9, -9, -thickness), Vec3(9, 9, 0));
    else
      scene.plate("m");
    scene.light("sun", fmt::format("\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) "
                                   "direction 0 0 {}",
                                   -side));
    return Probe(scene.str(), known_shaders()).onto(Vec3(0), Vec3(0, 0, 1), 0, 20000);
  };
}

const Rgb kColor(.5f, .25f, 1);

/// One layer: `color`, `weight` and its share of what `stage` shows; `others` switch the rest off.
void add_layer(Cases& all, const std::string& shader, const std::string& color,
               const std::string& weight, const std::string& others, From from) {
  const std::string name = shader + ".";
  all.push_back(gives(name + color, lit(from), others + weight + " .5",
                      {{"0 0 0", Rgb(0)}, {".5 .25 1", kColor * .5f}, {"1 1 1", Rgb(.5f)}}));
  all.push_back(gives(name + weight, lit(from), others + color + " .5 .25 1",
                      {{"0", Rgb(0)}, {".3", kColor * .3f}, {"1", kColor}}));
}

void add_layers(Cases& all, const std::string& shader, bool has_mid) {
  const std::string name = shader + ".";
  const std::string no_diffuse = "diffuse_weight 0, ", no_front = "front_sss_weight 0, ",
                    no_back = "back_sss_weight 0, ", no_mid = has_mid ? "mid_sss_weight 0, " : "";
  add_layer(all, shader, "diffuse_color", "diffuse_weight", no_front + no_mid + no_back,
            From::Above);
  add_layer(all, shader, "front_sss_color", "front_sss_weight", no_diffuse + no_mid + no_back,
            From::Above);
  if (has_mid)
    add_layer(all, shader, "mid_sss_color", "mid_sss_weight", no_diffuse + no_front + no_back,
              From::Above);
  add_layer(all, shader, "back_sss_color", "back_sss_weight", no_diffuse + no_front + no_mid,
            From::Below);
  // Two layers of .5 and .8: .9 with the screen, else 1, where 1.3 would be more than falls in.
  const std::string two = no_mid + no_back +
                          "diffuse_color 1 1 1, diffuse_weight .5, front_sss_color 1 1 1, "
                          "front_sss_weight .8";
  all.push_back(
      gives(name + "screen_composit", lit(From::Sky), two, {{"on", Rgb(.9f)}, {"off", Rgb(1)}}));
  all.push_back(
      gives(name + "output_sss_only", lit(From::Sky), two, {{"off", Rgb(.9f)}, {"on", Rgb(.8f)}}));
  all.push_back(gives(name + "bump", lit(), two,
                      {{"\"flat\"", Rgb(.9f)}, {"\"steep\"", Rgb(.9f * kSteepCosine)}}));
  all.push_back(gives(name + "specular_illum", lit(), two,
                      {{"= \"shown\"", Rgb(.9f) + kMayaTint}, {"= \"dull\"", Rgb(1.4f)}}));
  const std::string diffuse = no_front + no_mid + no_back +
                              "diffuse_color .5 .25 1, "
                              "diffuse_weight 1";
  all.push_back(gives(name + "diffuse_illum", lit(), diffuse,
                      {{"= \"shown\"", kColor * kMayaTint}, {"= \"dull\"", kColor * .5f}}));
}

/// Rows that multiply all layers.
void add_overall(Cases& all, const std::string& shader, const std::string& others) {
  const std::string name = shader + ".", white = others + "front_sss_color 1 1 1, ";
  all.push_back(gives(name + "overall_color", lit(), white + "front_sss_weight .5",
                      {{"0 0 0", Rgb(0)}, {".5 .25 1", kColor * .5f}, {"1 1 1", Rgb(.5f)}}));
  all.push_back(gives(name + "ambient", lit(), white + "front_sss_weight .5",
                      {{"0 0 0", Rgb(.5f)}, {".5 .25 1", (Rgb(1) + kColor) * .5f}}));
}

Rgb cosine_power(float degrees, float exponent) {
  return Rgb(std::pow(std::cos(degrees * kPi / 180), exponent));
}

/// Exponents at two angles, of a white highlight of weight 1.
void add_exponent(Cases& all, const std::string& parameter, const std::string& others) {
  const auto at = [&](float degrees) {
    return gives(parameter, lit(From::Above, degrees), others,
                 {{"2", cosine_power(degrees, 2)},
                  {"20", cosine_power(degrees, 20)},
                  {"50", cosine_power(degrees, 50)}});
  };
  all.push_back(both(at(0), at(20)));
}

/// Highlights and reflection of skin; `others` make the body black.
void add_skin(Cases& all, const std::string& shader, const std::string& others) {
  const std::string name = shader + ".";
  // At 60 degrees from the normal the mirrored view and the sun lie 60 degrees apart: with the
  // exponent 0 the highlight is 1 everywhere, and the edge is (1 - cos 60)^factor.
  const Stage sun = lit(), slant = lit(From::Above, 60);
  for (const std::string which : {"primary_", "secondary_"}) {
    const std::string other = which == "primary_" ? "secondary_weight 0" : "primary_weight 0";
    const std::string plain = others + other + ", " + which + "shinyness 0, ";
    all.push_back(gives(name + which + "spec_color", sun, plain + which + "weight .5",
                        {{"0 0 0", Rgb(0)}, {".5 .25 1", kColor * .5f}, {"1 1 1", Rgb(.5f)}}));
    all.push_back(gives(name + which + "weight", sun, plain,
                        {{"0", Rgb(0)}, {".5", Rgb(.5f)}, {"1", Rgb(1)}}));
    all.push_back(both(gives(name + which + "edge_weight", slant, plain + "edge_factor 2",
                             {{"0", Rgb(0)}, {"1", Rgb(.25f)}, {"2", Rgb(.5f)}}),
                       gives(name + which + "edge_weight", sun, plain + "edge_factor 2",
                             {{"0", Rgb(0)}, {"1", Rgb(0)}})));
    add_exponent(all, name + which + "shinyness", others + other + ", " + which + "weight 1");
  }
  const std::string first = others + "primary_shinyness 0, ";
  all.push_back(gives(name + "overall_weight", sun, first + "primary_weight .5",
                      {{"0", Rgb(0)}, {".5", Rgb(.25f)}, {"2", Rgb(1)}}));
  all.push_back(gives(name + "edge_factor", slant, first + "primary_edge_weight 1",
                      {{"0", Rgb(1)}, {"1", Rgb(.5f)}, {"3", Rgb(.125f)}}));
  const Stage sky = lit(From::Sky), slant_sky = lit(From::Sky, 60);
  all.push_back(gives(name + "reflect_weight", sky, others + "reflect_shinyness 0",
                      {{"0", Rgb(0)}, {".5", Rgb(.5f)}, {"1", Rgb(1)}}));
  all.push_back(gives(name + "reflect_edge_weight", slant_sky,
                      others + "reflect_shinyness 0, edge_factor 1",
                      {{"0", Rgb(0)}, {".5", Rgb(.25f)}, {"1", Rgb(.5f)}}));
  // The sun in a narrower reflection is brighter; a mirror has no light from it.
  all.push_back(
      rises(name + "reflect_shinyness", sun, others + "reflect_weight 1", {"2", "10", "50"}));
}

/// Half spaces: the reduced albedo is s (1 - g) / (s (1 - g) + a).
float reflectance(float albedo, float index) {
  const double inside = -1.44 / (index * index) + .71 / index + .668 + .0636 * index;
  const double a = (1 + inside) / (1 - inside), root = std::sqrt(3 * (1 - double{albedo}));
  return static_cast<float>(albedo / 2 * (1 + std::exp(-4 * a * root / 3)) * std::exp(-root));
}

void add_physical(Cases& all) {
  const std::string name = "misss_physical.";
  const std::string call = "ior 1.3, absorption_coeff 1 1 1, scattering_coeff 9 9 9, ";
  const Stage sun = lit();
  all.push_back(gives(name + "transmission", sun, call,
                      {{"0 0 0", Rgb(0)},
                       {".5 .25 1", kColor * reflectance(.9f, 1.3f)},
                       {"1 1 1", Rgb(reflectance(.9f, 1.3f))}}));
  all.push_back(
      gives(name + "ior", sun, call,
            {{"1.1", Rgb(reflectance(.9f, 1.1f))}, {"1.5", Rgb(reflectance(.9f, 1.5f))}}));
  all.push_back(gives(
      name + "absorption_coeff", sun, call,
      {{"0 0 0", Rgb(1)},
       {"9 1 3", Rgb(reflectance(.5f, 1.3f), reflectance(.9f, 1.3f), reflectance(.75f, 1.3f))}}));
  all.push_back(gives(
      name + "scattering_coeff", sun, call,
      {{"0 0 0", Rgb(0)},
       {"1 9 3", Rgb(reflectance(.5f, 1.3f), reflectance(.9f, 1.3f), reflectance(.75f, 1.3f))}}));
  all.push_back(gives(name + "scattering_anisotropy", sun,
                      "ior 1.3, absorption_coeff 1 1 1, scattering_coeff 6 6 6",
                      {{"0", Rgb(reflectance(6 / 7.f, 1.3f))},
                       {".5", Rgb(reflectance(.75f, 1.3f))},
                       {"-.5", Rgb(reflectance(.9f, 1.3f))}}));
  all.push_back(gives(name + "material", sun, call + "transmission 0 0 0",
                      {{"= \"shown\"", kMayaTint}, {"= \"dull\"", Rgb(.5f)}}));
}

/// Radii of the layers of one shader; `others` leave one white layer of weight 1.
void add_radius(Cases& all, const std::string& parameter, const std::string& others) {
  const Stage sheet = half_shaded(From::Above, 0), solid = half_shaded(From::Above, 2);
  const std::vector<Given> values = {{"0", Rgb(1)},
                                     {".4", Rgb(beside_shadow(kBesideShadow, .4))},
                                     {"1.6", Rgb(beside_shadow(kBesideShadow, 1.6))}};
  all.push_back(
      both(gives(parameter, sheet, others, values), gives(parameter, solid, others, values)));
}
void add_back(Cases& all, const std::string& shader, const std::string& others) {
  const std::string name = shader + ".";
  const std::string call = others + "back_sss_color 1 1 1, back_sss_weight 1, ";
  // The light of the lower side fades with the thickness of .5.
  const Stage below = half_shaded(From::Below, .5f);
  all.push_back(gives(name + "back_sss_depth", below, call,
                      {{"1", Rgb(.5f)}, {"2", Rgb(.75f)}, {"5", Rgb(.9f)}}));
  all.push_back(gives(name + "back_sss_radius", below, call + "back_sss_depth 5",
                      {{"0", Rgb(.9f)},
                       {".4", Rgb(.9f * beside_shadow(kBesideShadow, .4))},
                       {"1.6", Rgb(.9f * beside_shadow(kBesideShadow, 1.6))}}));
}
void add_radii(Cases& all, const std::string& shader, bool has_mid) {
  const std::string name = shader + ".", diffuse = "diffuse_weight 0, ",
                    front = "front_sss_weight 0, ", back = "back_sss_weight 0, ",
                    mid = has_mid ? "mid_sss_weight 0, " : "";
  const std::string white = "front_sss_color 1 1 1, front_sss_weight 1, ";
  add_radius(all, name + "front_sss_radius", diffuse + mid + back + white);
  if (has_mid)
    add_radius(all, name + "mid_sss_radius",
               diffuse + front + back + "mid_sss_color 1 1 1, mid_sss_weight 1, ");
  add_back(all, shader, diffuse + front + mid);
  all.push_back(gives(name + "scale_conversion", half_shaded(From::Above, 0),
                      diffuse + mid + back + white + "front_sss_radius .8",
                      {{".5", Rgb(beside_shadow(kBesideShadow, .4))},
                       {"2", Rgb(beside_shadow(kBesideShadow, 1.6))}}));
}

Cases cases() {
  Cases all;
  const std::string simple = "misss_fast_simple_maya", skin = "misss_fast_skin_maya";
  const std::string front = "diffuse_weight 0, back_sss_weight 0, ";
  add_layers(all, simple, false);
  add_overall(all, simple, front);
  const std::string black = front + "front_sss_weight 0, ";
  all.push_back(gives(simple + ".specular", lit(), black + "exponent 20",
                      {{"0 0 0", Rgb(0)}, {".5 .25 1", kColor}}));
  add_exponent(all, simple + ".exponent", black + "specular 1 1 1");
  add_layers(all, skin, true);
  add_overall(all, skin, front + "mid_sss_weight 0, ");
  add_skin(all, skin, black + "mid_sss_weight 0, ");
  // The reflection takes its light from the body: both together never reflect more than falls in.
  const auto reflection = std::find_if(all.begin(), all.end(), [&](const Case& c) {
    return c.parameter == skin + ".reflect_weight";
  });
  *reflection = both(*reflection,
                     gives(skin + ".reflect_weight", lit(From::Sky),
                           front + "mid_sss_weight 0, front_sss_color 1 1 1, front_sss_weight .8",
                           {{"0", Rgb(.8f)}, {".5", Rgb(.9f)}, {"1", Rgb(1)}}));
  add_skin(all, "misss_skin_specular", "");
  add_radii(all, simple, false);
  add_radii(all, skin, true);
  add_layers(all, "misss_fast_shader", false);
  add_radii(all, "misss_fast_shader", false);
  add_layers(all, "misss_fast_shader2", false);
  add_physical(all);
  const std::string lambert = "misss_lambert_gamma.";
  all.push_back(gives(lambert + "diffuse", lit(), "",
                      {{"0 0 0", Rgb(0)}, {".5 .25 1", kColor}, {"1 1 1", Rgb(1)}}));
  all.push_back(gives(lambert + "ambient", lit(), "diffuse 0 0 0, ambience 1 .5 .25",
                      {{"0 0 0", Rgb(0)}, {"1 1 1", Rgb(1, .5f, .25f)}}));
  all.push_back(gives(lambert + "ambience", lit(), "diffuse 0 0 0, ambient 1 .5 .25",
                      {{"0 0 0", Rgb(0)}, {"1 1 1", Rgb(1, .5f, .25f)}}));
  all.push_back(
      both(gives(lambert + "flip", lit(), "", {{"0", Rgb(1)}, {"1", Rgb(0)}}),
           gives(lambert + "flip", lit(From::Below), "", {{"0", Rgb(0)}, {"1", Rgb(1)}})));
  all.push_back(gives("misss_call_shader.shader", lit(), "default_shader \"dull\"",
                      {{"\"shown\"", kMayaTint}, {"\"dull\"", Rgb(.5f)}}));
  all.push_back(gives("misss_call_shader.default_shader", lit(), "",
                      {{"\"shown\"", kMayaTint}, {"\"dull\"", Rgb(.5f)}}));
  return all;
}

}  // namespace
}  // namespace subsurface

Cases subsurface_cases() { return subsurface::cases(); }

}  // namespace oriel::effects
