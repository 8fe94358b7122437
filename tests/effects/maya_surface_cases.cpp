// SPDX-License-Identifier: Apache-2.0
// Maya's surfaces: shaders/maya/maya_surface.cpp.
#include <cmath>

#include "cases.h"
#include "maya_stages.h"

namespace oriel::effects {
namespace maya_surface {
namespace {

constexpr float kDegree = kPi / 180;

/// How the plate at z = 0 is seen: `degrees` from its normal, in the direction x turned by `turn`
/// degrees to y. u of the plate is along x. It is lit by a sun straight above or below it, which
/// makes white 1, or by a sky of 1 all around.
struct View {
  float degrees = 0, turn = 0;
  enum { Above, Below, Sky } light = Above;
};

const std::string kSources =
    kMayaSources + "shader \"tilted\" \"maya_xyz_to_vector\" ( \"x\" .6, \"y\" 0, \"z\" .8 )\n";

/// The plate's object under an instance of that name and transform.
std::string plate_of(const std::string& name, const std::string& transform) {
  return fmt::format(
      "object \"{0}\" visible on shadow on trace on group\n"
      "-5 -5 0 5 -5 0 5 5 0 -5 5 0 0 0 0 1 0 0 1 1 0 0 1 0\n"
      "v 0 t 4 v 1 t 5 v 2 t 6 v 3 t 7 c 0 1 2 3 end group end object\n"
      "instance \"{0}_i\" \"{0}\" material \"m\" {1} end instance",
      name, transform);
}
SceneText& add_plate(SceneText& scene, const std::string& call) {
  return scene.statement(kSources)
      .statement(
          fmt::format("shader \"s\" {}\nmaterial \"m\" = \"s\" shadow = \"s\" end material", call))
      .statement(plate_of("plate", ""))
      .member("plate_i");
}
Measured seen_from(const SceneText& scene, const View& view, int samples) {
  const float a = view.degrees * kDegree, b = view.turn * kDegree;
  const Vec3 away(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
  return Probe(scene.str()).ray(away * .5f, -away, samples);
}

Stage plate(const View& view = {}) {
  return [=](const std::string& call) {
    SceneText scene;
    add_plate(scene, call);
    if (view.light == View::Sky)
      scene.uniform_sky(1);
    else
      scene.light("sun", fmt::format("\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) "
                                     "direction 0 0 {}",
                                     view.light == View::Above ? -1 : 1));
    return seen_from(scene, view, view.light == View::Sky ? 1024 : 64);
  };
}

/// x of the point on a floor 1 below the plate that a view at 45 degrees through x = 0 sees.
/// `solid`: the plate has a back side halfway down.
Stage floor_below(bool solid) {
  return [=](const std::string& call) {
    SceneText scene;
    add_plate(scene, call);
    if (solid)
      scene.statement(plate_of("back", "transform 1 0 0 0 0 -1 0 0 0 0 -1 0 0 0 -.5 1"))
          .member("back_i");
    scene.statement("shader \"place\" \"test_place\" ( \"scale\" -1 0 0 )")
        .material("floor",
                  "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"place\"")
        .square("floor", Vec3(0, 0, -1), 5, Vec3(0, 0, 1));
    return seen_from(scene, {.degrees = 45}, 64);
  };
}
/// That x by Snell's law; below the back side of a solid the view has its first direction again.
float bent_to(float index, bool solid) {
  const float sine = std::sqrt(.5f) / index, tangent = sine / std::sqrt(1 - sine * sine);
  return solid ? (tangent + 1) / 2 : tangent;
}
/// Values of the parameter, and the index by which the view is bent with each.
Case bends(const std::string& parameter, const std::string& others,
           const std::vector<std::pair<std::string, float>>& values) {
  return shows(parameter, [=] {
    const std::size_t dot = parameter.find('.');
    for (const bool solid : {false, true})
      for (const auto& [text, index] : values) {
        const std::string call =
            call_of(parameter.substr(0, dot), others + parameter.substr(dot + 1) + " " + text);
        // Rays start a little off the surfaces.
        EXPECT_NEAR(floor_below(solid)(call).mean.x, bent_to(index, solid), 2e-4f)
            << parameter << ' ' << text << (solid ? ", solid" : "");
      }
  });
}

/// Rows of all surfaces. `call`: parameters that switch highlight and mirror off.
void add_body(Cases& all, const std::string& shader, const std::string& call) {
  const std::string name = shader + ".";
  const Rgb color(.5f, .25f, 1), white(1);
  const std::string colored = call + "color .5 .25 1, ";
  const Stage sun = plate(), below = plate({.light = View::Below});
  const Stage sky = plate({.light = View::Sky});
  const Stage shown = member("outColor", kMayaSources);
  for (const Stage& stage : {sun, shown}) {
    add_or_join(
        all,
        gives(name + "color", stage, call + "diffuse .5",
              {{"0 0 0", Rgb(0)}, {".5 .25 1", color * .5f}, {"= \"tint\"", kMayaTint * .5f}}));
  }
  // The rest is the surface's own colour.
  add_or_join(all, gives(name + "transparency", sky, colored + "diffuse 1",
                         {{"0 0 0", color},
                          {".2 .5 1", Rgb(.2f + .8f * .5f, .5f + .5f * .25f, 1)},
                          {"= \"tint\"", kMayaTint + (white - kMayaTint) * color}}));
  add_or_join(all,
              gives(name + "transparency", member("outTransparency", kMayaSources), call,
                    {{"0 0 0", Rgb(0)}, {".2 .5 1", Rgb(.2f, .5f, 1)}, {"= \"tint\"", kMayaTint}}));
  // A multiple of the colour, without any light.
  add_or_join(all, gives(name + "ambientColor", sun, colored + "diffuse 0, transparency .2 .2 .2",
                         {{"0 0 0", Rgb(0)},
                          {"1 .5 2", Rgb(.5f, .125f, 2) * .8f},
                          {"= \"tint\"", kMayaTint * color * .8f}}));
  for (const Stage& stage : {sun, shown})
    add_or_join(all, gives(name + "incandescence", stage, colored + "diffuse .5",
                           {{"0 0 0", color * .5f},
                            {"1 .5 2", color * .5f + Rgb(1, .5f, 2)},
                            {"= \"tint\"", color * .5f + kMayaTint}}));
  for (const Stage& stage : {sun, shown})
    add_or_join(
        all,
        gives(name + "diffuse", stage, colored,
              {{"0", Rgb(0)}, {".3", color * .3f}, {"1", color}, {"= \"half\"", color * .5f}}));
  add_or_join(
      all,
      gives(name + "translucence", sun, colored + "diffuse 1",
            {{"0", color}, {".25", color * .75f}, {"1", Rgb(0)}, {"= \"half\"", color * .5f}}));
  add_or_join(
      all,
      gives(name + "translucence", below, colored + "diffuse 1",
            {{"0", Rgb(0)}, {".25", color * .25f}, {"1", color}, {"= \"half\"", color * .5f}}));
  // The normal (.6, 0, .8) has the cosine .8 to the light; an unconnected value is ignored.
  add_or_join(all, gives(name + "normalCamera", sun, colored + "diffuse 1",
                         {{".6 0 .8", color}, {"1 1 1", color}, {"= \"tilted\"", color * .8f}}));
  const std::string clear = call + "color 0 0 0, transparency 1 1 1, ";
  add_or_join(all, bends(name + "refractions", clear + "refractiveIndex 1.5, ",
                         {{"off", 1}, {"on", 1.5f}}));
  add_or_join(all, bends(name + "refractiveIndex", clear + "refractions on, ",
                         {{"1", 1}, {"1.3", 1.3f}, {"2", 2}}));
}

/// Rows of surfaces with a mirror and a highlight. `peak`: brightest value of the highlight with
/// those further parameters and a white `specularColor`.
void add_mirror(Cases& all, const std::string& shader, const std::string& others, float peak) {
  const std::string name = shader + ".", black = others + ", color 0 0 0";
  const Stage sky = plate({.light = View::Sky});
  add_or_join(all, gives(name + "specularColor", plate(), black,
                         {{"0 0 0", Rgb(0)},
                          {".5 .25 1", Rgb(.5f, .25f, 1) * peak},
                          {"= \"tint\"", kMayaTint * peak}}));
  // Maya's help: transparency does not affect highlights.
  add_or_join(all, gives(name + "specularColor", plate(), black + ", transparency 1 1 1",
                         {{"0 0 0", Rgb(0)}, {".5 .25 1", Rgb(.5f, .25f, 1) * peak}}));
  add_or_join(all, gives(name + "specularColor", sky, black + ", reflectivity .5",
                         {{"0 0 0", Rgb(0)},
                          {".5 .25 1", Rgb(.25f, .125f, .5f)},
                          {"= \"tint\"", kMayaTint * .5f}}));
  // The body, of .5, reflects what the mirror leaves.
  const auto over = [](float reflectivity) {
    const Rgb mirror = Rgb(.4f, .8f, 0) * reflectivity;
    return mirror + (Rgb(1) - mirror) * .5f;
  };
  add_or_join(
      all, gives(name + "reflectivity", sky,
                 others + ", color .5 .5 .5, diffuse 1, specularColor .4 .8 0",
                 {{"0", over(0)}, {".25", over(.25f)}, {"1", over(1)}, {"= \"half\"", over(.5f)}}));
}

/// Highlights of white: the cosine to the mirrored view to a power.
Rgb cosine_power(float degrees, float exponent) {
  return Rgb(std::pow(std::cos(degrees * kDegree), exponent));
}

void add_phong(Cases& all) {
  const std::string white = "color 0 0 0, specularColor 1 1 1, ";
  add_mirror(all, "maya_phong", "cosinePower 20", 1);
  for (const float degrees : {0.0f, 20.0f, 40.0f})
    add_or_join(all, gives("maya_phong.cosinePower", plate({.degrees = degrees}), white,
                           {{"2", cosine_power(degrees, 2)},
                            {"20", cosine_power(degrees, 20)},
                            {"50", cosine_power(degrees, 50)}}));
  add_mirror(all, "maya_phongE", "roughness .7, highlightSize .5", 1);
  for (const float degrees : {0.0f, 20.0f}) {
    const auto wide = [&](float width) { return cosine_power(degrees, 1 / (width * width)); };
    const Stage stage = plate({.degrees = degrees});
    for (const auto& [row, other] :
         {std::pair("roughness", "highlightSize .5"), std::pair("highlightSize", "roughness .5")})
      all.push_back(gives(std::string("maya_phongE.") + row, stage, white + other,
                          {{".3", wide(.15f)}, {".7", wide(.35f)}, {"1", wide(.5f)}}));
  }
  // Both angles of a row are one case.
  const std::size_t n = all.size();
  all[n - 4] = both(all[n - 4], all[n - 2]);
  all[n - 3] = both(all[n - 3], all[n - 1]);
  all.resize(n - 2);
}

/// Reflectance of a dielectric for unpolarised light.
float fresnel(float cosine, float index) {
  const float inside = std::sqrt(1 - (1 - cosine * cosine) / (index * index));
  const float across = (cosine - index * inside) / (cosine + index * inside);
  const float along = (inside - index * cosine) / (inside + index * cosine);
  return (across * across + along * along) / 2;
}

/// Cook and Torrance's facets of Beckmann's slopes, lit along the normal and seen from `degrees`.
Rgb facets(float degrees, float slope, float index) {
  const float half = std::cos(degrees / 2 * kDegree), view = std::cos(degrees * kDegree);
  const float tangent2 = 1 / (half * half) - 1;
  const float density =
      std::exp(-tangent2 / (slope * slope)) / (slope * slope * half * half * half * half);
  return Rgb(fresnel(half, index) * density / (4 * view));
}

void add_blinn(Cases& all) {
  const std::string name = "maya_blinn.", white = "color 0 0 0, specularColor 1 1 1, ";
  // A roll-off of .7 is the index 1.49 of plastic.
  constexpr float kPlastic = 1.49f;
  add_mirror(all, "maya_blinn", "eccentricity .3, specularRollOff .7", facets(0, .3f, kPlastic).x);
  for (const float degrees : {0.0f, 30.0f})
    add_or_join(
        all, gives(name + "eccentricity", plate({.degrees = degrees}), white + "specularRollOff .7",
                   {{".1", facets(degrees, .1f, kPlastic)},
                    {".3", facets(degrees, .3f, kPlastic)},
                    {".6", facets(degrees, .6f, kPlastic)}}));
  add_or_join(all, rises(name + "specularRollOff", plate(), white + "eccentricity .3",
                         {"0", ".3", ".7", "1"}));
  add_or_join(all, gives(name + "specularRollOff", plate(), white + "eccentricity .3",
                         {{"0", Rgb(0)}, {".7", facets(0, .3f, kPlastic)}}));
}

/// Ward's highlight, lit along the normal and seen from `degrees`, `turn` off the first axis.
Rgb ward(float degrees, float turn, float along_x, float along_y) {
  const float slope = std::tan(degrees / 2 * kDegree);
  const float x = slope * std::cos(turn * kDegree) / along_x;
  const float y = slope * std::sin(turn * kDegree) / along_y;
  return Rgb(std::exp(-x * x - y * y) /
             (4 * along_x * along_y * std::sqrt(std::cos(degrees * kDegree))));
}

void add_anisotropic(Cases& all) {
  const std::string name = "maya_anisotropic.", white = "color 0 0 0, specularColor 1 1 1, ";
  add_mirror(all, "maya_anisotropic", "roughness .6, spreadX 6, spreadY 2", 1 / (4 * .1f * .3f));
  // Seen from the side of u, of v and between; slopes are roughness / spread.
  for (const char* row : {"angle", "spreadX", "spreadY", "roughness"})
    for (const float turn : {0.0f, 30.0f, 90.0f}) {
      const auto with = [&](float angle, float spread_x, float spread_y, float roughness) {
        return ward(15, turn - angle, roughness / spread_x, roughness / spread_y);
      };
      std::vector<Given> values;
      std::string others = white;
      const std::string which = row;
      if (which == "angle") {
        // The first axis is u turned counter-clockwise.
        others += "roughness .6, spreadX 4, spreadY 2";
        values = {{"0", with(0, 4, 2, .6f)},
                  {".5235988", with(30, 4, 2, .6f)},
                  {"1.5707963", with(90, 4, 2, .6f)},
                  {"45", with(45, 4, 2, .6f)}};
      } else if (which == "roughness") {
        others += "spreadX 4, spreadY 2";
        values = {
            {".3", with(0, 4, 2, .3f)}, {".6", with(0, 4, 2, .6f)}, {".9", with(0, 4, 2, .9f)}};
      } else {
        const bool x = which == "spreadX";
        others += x ? "roughness .6, spreadY 3" : "roughness .6, spreadX 3";
        for (const float spread : {2.0f, 4.0f, 6.0f})
          values.push_back(
              {fmt::format("{}", spread), x ? with(0, spread, 3, .6f) : with(0, 3, spread, .6f)});
      }
      add_or_join(all, gives(name + row, plate({.degrees = 15, .turn = turn}), others, values));
    }
}

void add_surfaceshader(Cases& all) {
  const std::string name = "maya_surfaceshader.";
  const Rgb color(.5f, .25f, 1);
  for (const Stage& stage : {plate(), plate({.light = View::Below}), member("outColor", kSources)})
    add_or_join(
        all, gives(name + "outColor", stage, "",
                   {{"0 0 0", Rgb(0)}, {"2 .25 1", Rgb(2, .25f, 1)}, {"= \"tint\"", kMayaTint}}));
  add_or_join(all, gives(name + "outTransparency", plate({.light = View::Sky}), "outColor .5 .25 1",
                         {{"0 0 0", color},
                          {".25 .5 1", color + Rgb(.25f, .5f, 1)},
                          {"= \"tint\"", color + kMayaTint}}));
  add_or_join(all, gives(name + "outTransparency", member("outTransparency", kSources), "",
                         {{".25 .5 1", Rgb(.25f, .5f, 1)}, {"= \"tint\"", kMayaTint}}));
}

}  // namespace
}  // namespace maya_surface

Cases maya_surface_cases() {
  using namespace maya_surface;
  Cases all;
  add_body(all, "maya_lambert", "");
  for (const char* shader : {"maya_phong", "maya_phongE", "maya_blinn", "maya_anisotropic"})
    add_body(all, shader, "specularColor 0 0 0, reflectivity 0, ");
  add_phong(all);
  add_blinn(all);
  add_anisotropic(all);
  add_surfaceshader(all);
  return all;
}

}  // namespace oriel::effects
