// SPDX-License-Identifier: Apache-2.0
// The physics library's materials and light: shaders/physics/dgs_material.cpp, physical_light of
// shaders/base/mib_light.cpp.
#include "cases.h"
#include "other_stages.h"

namespace oriel::effects {
namespace other_physics {
namespace {

using namespace other_stages;

/// "test_sky" ( above 1, below .2 ).
void two_skies(SceneText& scene) {
  scene.environment("\"test_sky\" ( \"above\" 1 1 1, \"below\" .2 .2 .2 )");
}
void white_sky(SceneText& scene) { scene.uniform_sky(1); }

/// Lights of one colour each, straight above.
void three_suns(SceneText& scene) {
  const char* sun = "\"mib_light_infinite\" ( \"color\" {} ) direction 0 0 -1";
  const std::pair<const char*, const char*> suns[] = {
      {"red", "1 0 0"}, {"green", "0 1 0"}, {"blue", "0 0 1"}};
  for (const auto& [name, color] : suns) scene.light(name, fmt::format(fmt::runtime(sun), color));
}

/// `lights` and `mode` of a material that shows a sun of 1 as that level. Modes: 0 the list where
/// there is one, 1 the list, 2 all but it, 4 all.
void add_lights(Cases& all, const std::string& shader, const std::string& others, float level) {
  const Stage suns = square_in(three_suns);
  const Rgb red(level, 0, 0), rest(0, level, level), every(level);
  all.push_back(
      both(gives(shader + ".lights", suns, others + ", mode 1",
                 {{"[ ]", Rgb(0)}, {"[ \"red_i\" ]", red}, {"[ \"green_i\", \"blue_i\" ]", rest}}),
           gives(shader + ".lights", suns, others + ", mode 0",
                 {{"[ ]", every}, {"[ \"red_i\" ]", red}})));
  all.push_back(gives(shader + ".mode", suns, others + ", lights [ \"red_i\" ]",
                      {{"0", red}, {"1", red}, {"2", rest}, {"4", every}}));
}

/// A square of coordinates u along x and v along y, that mirrors a lamp aside at 25 degrees; along
/// that axis.
Stage lamp_aside(const Vec3& axis) {
  return composed(
      [=](SceneText& scene, const std::string& call) {
        add_material(scene, call);
        scene.statement(
            "object \"plate\" visible trace shadow tagged group "
            "-5 -5 0  5 -5 0  5 5 0  -5 5 0  0 0 0  1 0 0  1 1 0  0 1 0 "
            "v 0 t 4 v 1 t 5 v 2 t 6 v 3 t 7 p 0 0 1 2 3 end group end object\n"
            "instance \"plate_i\" \"plate\" material [ \"m\" ] end instance");
        const Vec3 away = axis * std::sin(25 * kPi / 180) + kUp * std::cos(25 * kPi / 180);
        scene.member("plate_i").emitter("glow", 1).square("glow", away * 2.f, .3f, -away);
      },
      {.samples = 16384});
}

/// Colour of the floor one unit below: how far aside a ray at 45 degrees meets it.
Stage deflected() {
  return composed(
      [](SceneText& scene, const std::string& call) {
        add_material(scene, call);
        scene.statement("shader \"place\" \"test_place\" ( \"scale\" -1 0 0 )");
        scene.material("floor",
                       "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = "
                       "\"place\"");
        scene.plate("m").square("floor", Vec3(0, 0, -1), 5, kUp);
      },
      {.degrees = 45});
}
Rgb aside(float ior) { return Rgb(std::tan(std::asin(std::sqrt(.5f) / ior)), 0, 0); }

void add_dgs(Cases& all, const std::string& shader) {
  const std::string name = shader + ".";
  const Rgb color(.2f, .4f, .6f);
  const std::string written = ".2 .4 .6 1";
  all.push_back(gives(name + "diffuse", square_in(sun_above), "",
                      {{written, color}, {"1 0 0 1", Rgb(1, 0, 0)}, {"= \"tint\"", kTinted}}));
  // In a white room each part contributes its colour; a sun has no mirror image.
  all.push_back(both(
      gives(name + "glossy", square_in(white_sky, {.samples = 16384}), "shiny 20",
            {{written, color}, {"1 0 0 1", Rgb(1, 0, 0)}}),
      // Tables of albedos are within a thousandth; each lobe has a ray of its own here, so that
      // more samples would resolve that.
      gives(name + "glossy", square_in(white_sky, {.samples = 2048}),
            "diffuse .2 .2 .2 1, shiny 20", {{"0 0 0 1", Rgb(.2f)}, {written, Rgb(.2f) + color}})));
  all.push_back(
      both(gives(name + "specular", square_in(two_skies), "",
                 {{written, color}, {"1 0 0 1", Rgb(1, 0, 0)}}),
           gives(name + "specular", square_in(sun_above), "diffuse .5 .5 .5 1",
                 {{"0 0 0 1", Rgb(.5f)}, {written, Rgb(.5f)}, {"= \"tint\"", Rgb(.5f)}})));
  const std::string glossy = "glossy 1 1 1 1";
  const Stage along = lamp_aside(Vec3(1, 0, 0)), across = lamp_aside(Vec3(0, 1, 0));
  all.push_back(
      both(falls(name + "shiny", along, glossy, {"5", "20", "100"}),
           falls(name + "shiny", across, glossy + ", shiny_u 5, shiny_v 5", {"0", "20", "100"})));
  // A narrower lobe across the axis is brighter along it.
  const struct {
    const char *own, *other;
    Stage own_axis, other_axis;
  } axes[] = {{"shiny_u", "shiny_v 20", along, across}, {"shiny_v", "shiny_u 20", across, along}};
  for (const auto& a : axes)
    all.push_back(
        both(falls(name + a.own, a.own_axis, glossy + ", " + a.other, {"5", "20", "80"}),
             rises(name + a.own, a.other_axis, glossy + ", " + a.other, {"5", "20", "80"})));
  // All three parts transmit this fraction of the light behind.
  all.push_back(both(gives(name + "transp", square_in(two_skies, {.samples = 16384}),
                           "diffuse .2 .2 .2, glossy .3 .3 .3, specular .5 .5 .5, shiny 50",
                           {{"0", Rgb(1)}, {".25", Rgb(.8f)}, {"1", Rgb(.2f)}}),
                     gives(name + "transp", square_in(two_skies), "specular 1 .5 0 1",
                           {{"0", Rgb(1, .5f, 0)},
                            {"1", Rgb(.2f, .1f, 0)},
                            {"= \"tint\"", Rgb(1, .5f, 0) * (.7f + .3f * .2f)}})));
  all.push_back(gives(name + "ior", deflected(), "specular 1 1 1, transp 1",
                      {{"0", aside(1)}, {"1", aside(1)}, {"1.5", aside(1.5f)}, {"2", aside(2)}}));
  add_lights(all, shader, "diffuse .5 .5 .5", .5f);
}

/// Reflectance of a boundary of that ratio of indices, straight on.
float mirrored(float ratio) { return sqr((ratio - 1) / (ratio + 1)); }

/// A slab seen straight on, before white.
Stage slab(float thickness) {
  return composed([=](SceneText& scene, const std::string& call) {
    add_material(scene, call);
    scene.box("m", Vec3(-20, -20, -thickness), Vec3(20, 20, 0)).uniform_sky(1);
  });
}

void add_dielectric(Cases& all) {
  const std::string name = "dielectric_material.";
  const Stage half_lit =
      square_in([](SceneText& scene) { scene.half_sky(1, kUp); }, {.samples = 32768});
  // Transmittance over a unit of length, by Beer's law.
  const Rgb color(.5f, .25f, 1);
  all.push_back(both(
      gives(name + "col", slab(1), "ior 1",
            {{".5 .25 1 1", color}, {"1 1 1 1", Rgb(1)}, {"= \"tint\"", kTinted}}),
      gives(name + "col", slab(2), "ior 1", {{".5 .25 1 1", color * color}, {"1 1 1 1", Rgb(1)}})));
  const std::string clear = "col 1 1 1 1, ";
  all.push_back(both(
      gives(name + "ior", half_lit, clear,
            {{"0", Rgb(0)}, {"1", Rgb(0)}, {"1.5", Rgb(mirrored(1.5f))}, {"3", Rgb(mirrored(3))}}),
      gives(name + "ior", half_lit, clear + "ior_out 2",
            {{"2", Rgb(0)}, {"3", Rgb(mirrored(1.5f))}})));
  all.push_back(gives(name + "ior_out", half_lit, clear + "ior 3",
                      {{"0", Rgb(mirrored(3))},
                       {"1", Rgb(mirrored(3))},
                       {"2", Rgb(mirrored(1.5f))},
                       {"3", Rgb(0)}}));
  // A highlight as strong as the reflection; at 30 degrees Fresnel gives .041523 for 1.5.
  const auto phong = [](float exponent) {
    return Rgb(.041523f * std::pow(std::sqrt(.75f), exponent));
  };
  all.push_back(gives(name + "phong_coef", square_in(sun_above, {.degrees = 30}), clear + "ior 1.5",
                      {{"0", Rgb(0)}, {"2", phong(2)}, {"8", phong(8)}}));
  add_lights(all, "dielectric_material", clear + "ior 3, phong_coef 20", mirrored(3));
}

/// Energy for a colour of 1 at a distance of 1: it is distributed over the sphere.
std::string energy(float distance) {
  return fmt::format("color {0} {0} {0} 1", 4 * kPi * sqr(distance));
}

void add_light(Cases& all) {
  const std::string name = "physical_light.";
  const float unit = 4 * kPi * 4;
  all.push_back(
      both(gives(name + "color", light("origin 0 0 2"), "",
                 {{fmt::format("{} {} 0 1", unit, unit / 2), Rgb(1, .5f, 0)}, {"0 0 0 1", Rgb(0)}}),
           gives(name + "color", light("direction 0 0 -1"), "",
                 {{"1 .5 0 1", Rgb(1, .5f, 0)}, {"3 3 3 1", Rgb(3)}})));
  // Off the axis by 45 degrees, at a distance of the root of 8, on a floor that leans as much.
  const float cosine = std::sqrt(.5f);
  const Rgb full(cosine);
  const std::string strong = energy(std::sqrt(8.f));
  const Vec3 beside(2, 0, 0);
  const Stage spot = light("origin 0 0 2 direction 0 0 -1 spread .5", beside);
  all.push_back(both(gives(name + "cone", spot, strong, {{".6", full}, {".7", full}}),
                     falls(name + "cone", spot, strong, {".7", ".75", ".85", ".95"})));
  all.push_back(gives(name + "threshold", light("origin 0 0 2"), energy(2),
                      {{"0", Rgb(1)}, {".9", Rgb(1)}, {"1.1", Rgb(0)}}));
  // Small shapes that look down: the power of their own cosine.
  const auto of_shape = [&](const char* shape) {
    return gives(name + "cos_exp", light(std::string("origin 0 0 2 ") + shape, beside, 1024),
                 strong,
                 {{"0", full * cosine}, {"1", full * cosine}, {"3", full * std::pow(cosine, 3.f)}});
  };
  all.push_back(both(of_shape("disc 0 0 -1 .01 3 3"),
                     of_shape("direction 0 0 -1 rectangle .02 0 0 0 .02 0 3 3")));
}

Cases cases() {
  Cases all;
  add_dgs(all, "dgs_material");
  add_dgs(all, "path_material");
  add_dielectric(all);
  add_light(all);
  return all;
}

}  // namespace
}  // namespace other_physics

Cases other_physics_cases() { return other_physics::cases(); }

}  // namespace oriel::effects
