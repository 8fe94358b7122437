// SPDX-License-Identifier: Apache-2.0
// Lens and volume shaders: shaders/base/mib_lens.cpp, mib_ray_marcher.cpp.
#include <fmt/format.h>

#include "base_stages.h"
#include "cases.h"
#include "color/luminance.h"
#include "prepare/testing/prepared_scene.h"

namespace oriel::effects {
namespace base_lens {

const Vec3 kFront(0, 0, 1);

/// The result of a lens shader for that colour at that place of the picture, 0 to 1.
Stage lens(const Rgb& color, Vec2 place = Vec2(.5f)) {
  return [=](const std::string& call) {
    // Scalar textures: "mask" is .2 on the left and .6 on the right, "bright" .8.
    const testing::PreparedScene scene(
        testing::scene_text("scalar texture \"mask\" [2 1 1] '3399'\n"
                            "scalar texture \"bright\" [1 1 1] 'cc'\n"
                            "material \"m\" \"mib_illum_lambert\" ( ) end material",
                            {}, "lens " + call),
        known_shaders());
    EXPECT_EQ(scene.messages(), "");
    ShadingPoint point;
    point.world = scene.world.get();
    point.raster = Vec2(place.x * float(point.world->camera.width),
                        place.y * float(point.world->camera.height));
    const ShaderNode* node = scene.world->lens.at(0);
    Measured measured;
    measured.mean = node->with_params(
        point, [&](const Call& c) { return node->spec().lens.map_color(c, LensCall{}, color); });
    return measured;
  };
}

void add_stencil(Cases& all) {
  const std::string name = "mib_lens_stencil.";
  const Rgb picture(1, .5f, .25f), low(0, 0, 1), high(0, 1, 0);
  const std::string colors = "floor_color 0 0 1 1, ceil_color 0 1 0 1";
  const std::string call = colors + ", stencil \"mask\"";
  const auto between = [&](float share) { return picture * share + low * (1 - share); };
  const Stage left = lens(picture, Vec2(.1f, .5f)), right = lens(picture, Vec2(.9f, .5f));
  all.push_back(gives(name + "floor", right, call + ", ceiling 1",
                      {{"0", between(.6f)}, {".5", between(.2f)}, {".7", low}}));
  all.push_back(
      gives(name + "ceiling", right, call,
            {{"1", between(.6f)}, {".75", between(.8f)}, {".6000001", between(1)}, {".5", high}}));
  all.push_back(gives(name + "floor_color", left, "stencil \"mask\", floor .3, ceiling 1",
                      {{"0 0 1 1", low}, {"2 1 .5 1", Rgb(2, 1, .5f)}}));
  all.push_back(gives(name + "ceil_color", right, "stencil \"mask\", ceiling .5",
                      {{"0 1 0 1", high}, {"2 1 .5 1", Rgb(2, 1, .5f)}}));
  all.push_back(both(gives(name + "stencil", left, colors + ", ceiling 1",
                           {{"\"mask\"", between(.2f)}, {"\"bright\"", between(.8f)}}),
                     gives(name + "stencil", right, colors + ", ceiling 1",
                           {{"\"mask\"", between(.6f)}, {"\"bright\"", between(.8f)}})));
}

void add_clamp(Cases& all) {
  const std::string name = "mib_lens_clamp.";
  const Rgb color(.2f, .6f, 1.5f), grey(.6f);
  const Rgb low(0, 0, 1), high(0, 1, 0);
  const std::string colors = "floor_color 0 0 1 1, ceil_color 0 1 0 1, ";
  all.push_back(
      both(gives(name + "floor", lens(color), "ceiling 1",
                 {{"0", Rgb(.2f, .6f, 1)}, {".5", Rgb(0, .2f, 1)}, {"-1", Rgb(.6f, .8f, 1)}}),
           gives(name + "floor", lens(grey), colors + "ceiling 1, luminance on",
                 {{"0", grey}, {".5", Rgb(.2f)}, {".7", low}})));
  all.push_back(
      both(gives(name + "ceiling", lens(color), "",
                 {{"1", Rgb(.2f, .6f, 1)}, {"2", Rgb(.1f, .3f, .75f)}, {".5", Rgb(.4f, 1, 1)}}),
           gives(name + "ceiling", lens(grey), colors + "luminance on",
                 {{"1", grey}, {"2", Rgb(.3f)}, {".5", high}})));
  // By luminance all channels are scaled by the same factor.
  const float l = luminance(color);
  all.push_back(gives(name + "luminance", lens(color), colors + "floor .1, ceiling 1.1",
                      {{"off", Rgb(.1f, .5f, 1)}, {"on", color * ((l - .1f) / l)}}));
  const std::vector<Given> values = {{"0 0 1 1", low}, {"2 1 .5 1", Rgb(2, 1, .5f)}};
  const std::string narrow = "floor .7, ceiling .9";
  all.push_back(both(gives(name + "floor_color", lens(grey), narrow + ", luminance on", values),
                     gives(name + "floor_color", lens(grey), narrow,
                           {{"0 0 1 1", Rgb(0)}, {"2 1 .5 1", Rgb(0)}})));
  all.push_back(both(gives(name + "ceil_color", lens(Rgb(1)), narrow + ", luminance on", values),
                     gives(name + "ceil_color", lens(Rgb(1)), narrow,
                           {{"0 0 1 1", Rgb(1)}, {"2 1 .5 1", Rgb(1)}})));
}

/// A surface of radiance 2, seen through 2 units of the volume.
Measured through_fog(const std::string& call) {
  SceneText scene;
  scene.camera("focal 1 aperture 1 aspect 1 resolution 32 32 volume " + call)
      .emitter("lamp", 2)
      .square("lamp", Vec3(0), 5, kFront);
  return Probe(scene.str(), known_shaders()).onto(Vec3(0), kFront, 0, 64, 2);
}
/// A white floor in a light 4 above, seen through 2 units of the volume.
Measured lit_through_fog(const std::string& call) {
  SceneText scene;
  scene.camera("focal 1 aperture 1 aspect 1 resolution 32 32 volume " + call)
      .lambert("white", 1)
      .square("white", Vec3(0), 5, kFront)
      .light("l", "\"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 4");
  Probe probe(scene.str(), known_shaders());
  return probe.direct_only().onto(Vec3(0), kFront, 0, 64, 2);
}

void add_volume(Cases& all) {
  const std::string name = "mib_volume.";
  // The fog is linear: 2 units are a quarter of max 8 and half of max 4.
  const Rgb fog(1, .5f, .25f), lamp(2);
  all.push_back(gives(name + "color", through_fog, "max 8",
                      {{"0 0 0 1", lamp * .75f}, {"1 .5 .25 1", lamp * .75f + fog * .25f}}));
  all.push_back(gives(
      name + "max", through_fog, "color 1 .5 .25 1",
      {{"8", lamp * .75f + fog * .25f}, {"4", lamp * .5f + fog * .5f}, {"2", fog}, {"1", fog}}));
  all.push_back(gives(name + "lightrays", lit_through_fog, "max 8",
                      {{"off", Rgb(.75f)}, {"on", Rgb(.75f * .5f)}}));
}

/// Shader "wave" is a quarter of a cosine wave over the 5 units to the surface; "one" and "two" are
/// constant.
const std::string kMarched =
    "shader \"p\" \"mib_texture_vector\" ( \"select\" -1 )\n"
    "shader \"q\" \"mib_texture_remap\" ( \"input\" = \"p\", "
    "\"transform\" 1 0 0 0 0 1 0 0 0 0 .05 0 0 0 0 1 )\n"
    "shader \"wave\" \"mib_texture_wave\" ( \"coord\" = \"q\", \"amplitude_z\" 1 )\n"
    "shader \"one\" \"mib_texture_wave\" ( \"offset\" 1 )\n"
    "shader \"two\" \"mib_texture_wave\" ( \"offset\" 2 )\n";

/// The integral of the wave by the trapezoid rule with that number of steps.
Rgb trapezoid(int steps) {
  float sum = 0;
  for (int i = 0; i <= steps; ++i)
    sum += std::cos(kPi / 2 * float(i) / float(steps)) * (i == 0 || i == steps ? .5f : 1);
  return Rgb(sum * 5 / float(steps));
}

void add_marcher(Cases& all) {
  const std::string name = "mib_ray_marcher.", wave = "shader \"wave\"";
  const Stage ray = value(kMarched);
  all.push_back(gives(name + "shader", ray, "", {{"\"one\"", Rgb(5)}, {"\"two\"", Rgb(10)}}));
  all.push_back(gives(name + "num", ray, wave,
                      {{"2", trapezoid(1)}, {"3", trapezoid(2)}, {"9", trapezoid(8)}}));
  all.push_back(gives(
      name + "distance", ray, wave + ", num 2",
      {{"0", trapezoid(1)}, {"6", trapezoid(1)}, {"2.6", trapezoid(2)}, {"1", trapezoid(5)}}));
  all.push_back(gives(name + "subdiv", ray, wave + ", num 2, contrast 0 0 0 0",
                      {{"0", trapezoid(1)}, {"1", trapezoid(2)}, {"3", trapezoid(8)}}));
  // The ends differ by 1, the ends of the halves by .29 and .71.
  all.push_back(
      gives(name + "contrast", ray, wave + ", num 2, subdiv 2",
            {{"2 2 2 2", trapezoid(1)}, {".8 .8 .8 1", trapezoid(2)}, {"0 0 0 0", trapezoid(4)}}));
}

Cases cases() {
  Cases all;
  add_stencil(all);
  add_clamp(all);
  add_volume(all);
  add_marcher(all);
  return all;
}

}  // namespace base_lens

Cases base_lens_cases() { return base_lens::cases(); }

}  // namespace oriel::effects
