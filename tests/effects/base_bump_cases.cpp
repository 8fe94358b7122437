// SPDX-License-Identifier: Apache-2.0
// Bump maps: shaders/base/mib_bump.cpp.
#include <fmt/format.h>

#include "base_stages.h"
#include "cases.h"
#include "prepare/testing/prepared_scene.h"

namespace oriel::effects {
namespace base_bump {

/// Texture "t" of 4 x 4 texels: the mean of its channels rises by .2 / 3 per texel to the right and
/// by .4 / 3 per texel upward, its alpha by .2 to the right. Texture "flat" is constant.
const std::string kTextures =
    texels("t", 4, 4,
           [](int x, int y) {
             return fmt::format("{:02x}{:02x}{:02x}{:02x}", 51 * x, 51 * y, 51 * y, 51 * x);
           }) +
    "color texture \"flat\" [1 1 4] '80808080'\n";
constexpr float kRight = .2f / 3, kUp = .4f / 3;

/// The normal (0, 0, 1) after adding x and y.
Vec3 tilted(float x, float y) { return normalize(Vec3(x, y, 1)); }

/// The normal that a shader later in the material's list sees.
Measured normal_after(const std::string& call) {
  return Probe(testing::scene_text(kTextures +
                                   "shader \"uv\" \"mib_texture_vector\" ( )\n"
                                   "shader \"n\" \"mib_texture_vector\" ( \"select\" -2 )\n"
                                   "material \"m\" " +
                                   call + " \"test_show\" ( \"vector\" = \"n\" ) end material"),
               known_shaders())
      .ray(Vec3(0), Vec3(-1.25f, -1.25f, -5), 64);
}

/// mib_bump_map and mib_passthrough_bump_map, which have the same parameters.
void add_map(Cases& all, const std::string& shader, const Stage& normal) {
  const std::string name = shader + ".";
  const std::string basis = "u 1 0 0, v 0 1 0, tex \"t\"";
  const std::string call = basis + ", step .25 .25 0, coord .375 .375 0";
  const Vec3 turned = tilted(kRight, kUp), straight(0, 0, 1);
  all.push_back(gives(
      name + "u", normal, call,
      {{"1 0 0", turned}, {"3 0 0", tilted(3 * kRight, kUp)}, {"0 1 0", tilted(0, kRight + kUp)}}));
  all.push_back(gives(
      name + "v", normal, call,
      {{"0 1 0", turned}, {"0 2 0", tilted(kRight, 2 * kUp)}, {"1 0 0", tilted(kRight + kUp, 0)}}));
  all.push_back(gives(name + "coord", normal, call,
                      {{".375 .375 0", turned},
                       {".875 .375 0", tilted(0, kUp)},
                       {".375 .875 0", tilted(kRight, 0)},
                       {"= \"uv\"", turned}}));
  all.push_back(gives(name + "step", normal, call,
                      {{".25 .25 0", turned},
                       {".125 .25 0", tilted(kRight / 2, kUp)},
                       {".25 .125 0", tilted(kRight, kUp / 2)},
                       {"0 0 0", tilted(kRight * .04f, kUp * .04f)}}));
  all.push_back(gives(name + "factor", normal, call,
                      {{"0", turned}, {"1", turned}, {"3", tilted(3 * kRight, 3 * kUp)}}));
  // Outside of the picture its border texel continues, unless a torus flag repeats the picture.
  const std::string beyond = basis + ", step .25 .25 0, coord 1.375 1.375 0";
  all.push_back(
      gives(name + "torus_u", normal, beyond, {{"off", straight}, {"on", tilted(kRight, 0)}}));
  all.push_back(
      gives(name + "torus_v", normal, beyond, {{"off", straight}, {"on", tilted(0, kUp)}}));
  all.push_back(gives(name + "alpha", normal, call, {{"off", turned}, {"on", tilted(.2f, 0)}}));
  all.push_back(gives(name + "tex", normal, call, {{"\"t\"", turned}, {"\"flat\"", straight}}));
  all.push_back(both(gives(name + "clamp", normal, beyond + ", torus_u on, torus_v on",
                           {{"off", turned}, {"on", straight}}),
                     gives(name + "clamp", normal, call, {{"off", turned}, {"on", turned}})));
}

/// The call as a material in the light of one sun from direction `from`. The radiance of the
/// Lambert shaders "white" and "grey" is the cosine between the normal and the sun, times 1 and .5.
Stage lit_from(const Vec3& from) {
  return [=](const std::string& call) {
    // Grey rises by .2 per texel over the left half and is constant over the right half.
    const std::string slope = texels("t", 8, 1, [](int x, int) {
      return fmt::format("{0:02x}{0:02x}{0:02x}", 51 * std::min(x, 4));
    });
    return Probe(testing::scene_text(
                     fmt::format("{}color texture \"flat\" [1 1 3] '808080'\n"
                                 "shader \"white\" \"mib_illum_lambert\" ( \"diffuse\" 1 1 1 )\n"
                                 "shader \"grey\" \"mib_illum_lambert\" ( \"diffuse\" .5 .5 .5 )\n"
                                 "material \"m\" {} end material\n"
                                 "light \"sun\" \"mib_light_infinite\" ( \"color\" 1 1 1 ) "
                                 "direction {} end light\n"
                                 "instance \"sun_i\" \"sun\" end instance",
                                 slope, call, text_of(-from)),
                     "\"sun_i\""),
                 known_shaders())
        .ray(Vec3(0), Vec3(-2.5f, 0, -5), 64);  // u is .375
  };
}

void add_map2(Cases& all) {
  const std::string name = "mib_bump_map2.";
  // The normal turns away from the sun: where it turns toward the light, the terminator correction
  // darkens the surface.
  const Vec3 sun(-.6f, 0, .8f);
  const Stage stage = lit_from(sun);
  // Over a step of .01 the texture rises by .016.
  const auto shown = [&](float rise) { return Rgb(dot(tilted(rise, 0), sun)); };
  const std::string call = "tex \"t\", color = \"white\"";
  all.push_back(gives(name + "factor", stage, call,
                      {{"0", shown(.016f)}, {"1", shown(.016f)}, {"20", shown(.32f)}}));
  all.push_back(
      gives(name + "scale", stage, call + ", factor 20",
            {{"0", shown(.32f)}, {"1", shown(.32f)}, {"2", shown(0)}, {".5", shown(.32f)}}));
  all.push_back(gives(name + "tex", stage, call + ", factor 20",
                      {{"\"t\"", shown(.32f)}, {"\"flat\"", shown(0)}}));
  all.push_back(gives(name + "color", stage, "tex \"t\", factor 20",
                      {{"= \"white\"", shown(.32f)},
                       {"= \"grey\"", shown(.32f) * .5f},
                       {".2 .4 .6 1", Rgb(.2f, .4f, .6f)}}));
}

/// Result `member` on a triangle with two texture spaces: u is along x in the first and along y in
/// the second.
Stage two_spaces(const std::string& member) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.statement(shown_as_light(call, {}, member))
        .statement(
            "object \"both\" visible trace tagged group\n"
            "-9 -9 -5  9 -9 -5  0 9 -5\n0 0 0  1 0 0  .5 1 0\n1 0 0  0 1 0\n"
            "v 0 t 3 6 7 t 3 7 6\nv 1 t 4 6 7 t 4 7 6\nv 2 t 5 6 7 t 5 7 6\n"
            "p 0 0 1 2\nend group end object\n"
            "instance \"both_i\" \"both\" material [ \"m\" ] end instance")
        .member("both_i");
    return Probe(scene.str(), known_shaders()).ray(Vec3(0), Vec3(0, 0, -1), 64);
  };
}

void add_basis(Cases& all) {
  const std::string name = "mib_bump_basis.";
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const std::vector<Given> us = {{"0", y}, {"1", x}, {"2", x}, {"3", y}, {"5", y}};
  const std::vector<Given> vs = {{"0", x}, {"1", y}, {"2", z}, {"3", z}, {"5", x}};
  all.push_back(both(gives(name + "project", two_spaces("u"), "ntex 1", us),
                     gives(name + "project", two_spaces("v"), "ntex 1", vs)));
  all.push_back(both(gives(name + "ntex", two_spaces("u"), "", {{"0", x}, {"1", y}}),
                     gives(name + "ntex", two_spaces("v"), "", {{"0", y}, {"1", x}})));
}

Cases cases() {
  Cases all;
  add_basis(all);
  add_map(all, "mib_bump_map", [](const std::string& call) {
    return value(kTextures + "shader \"uv\" \"mib_texture_vector\" ( )\n",
                 Vec2(.25f, 1 / 6.f))(call);
  });
  add_map(all, "mib_passthrough_bump_map", normal_after);
  add_map2(all);
  return all;
}

}  // namespace base_bump

Cases base_bump_cases() { return base_bump::cases(); }

}  // namespace oriel::effects
