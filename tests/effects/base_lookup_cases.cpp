// SPDX-License-Identifier: Apache-2.0
// Environment images: shaders/base/mib_lookup.cpp, mib_lookup_cube.cpp.
#include <fmt/format.h>

#include "base_stages.h"
#include "cases.h"

namespace oriel::effects {
namespace base_lookup {

const Vec3 kAhead(.3f, .1f, -1);
const std::string kRamp = kPlainTextures + kRampTexture;

/// The shader evaluated on a cube around the origin: it depends on the eye ray's direction alone.
Stage around(const Vec3& direction, const std::string& textures = kRamp) {
  return inside_cube(direction, textures);
}

/// The shader as environment, seen from the origin.
Stage far_around(const Vec3& direction) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.statement(kRamp).environment(call);
    return Probe(scene.str(), known_shaders()).ray(Vec3(0), direction, 64);
  };
}

void add_tex(Cases& all, const std::string& parameter, const Vec3& direction) {
  all.push_back(
      gives(parameter, far_around(direction), "", {{"\"a\"", kColorA}, {"\"b\"", kColorB}}));
}

void add_spherical(Cases& all) {
  const std::string name = "mib_lookup_spherical.";
  const std::string quarter = fmt::format("{}", kPi / 2), back = fmt::format("-{}", kPi / 2);
  add_tex(all, name + "tex", kAhead);
  // The centre of the picture is in direction -z, its right half toward x, its top toward y.
  all.push_back(gives(name + "dir", around(Vec3(0, 0, -1)), "tex \"t\"",
                      {{"0 0 0", ramp_color(.5f, .5f)},
                       {"3 0 0", ramp_color(.75f, .5f)},
                       {"-1 0 0", ramp_color(.25f, .5f)},
                       {"0 2 -2", ramp_color(.5f, .75f)}}));
  all.push_back(gives(name + "rotate", around(Vec3(0, 0, -1)), "tex \"t\"",
                      {{"0", ramp_color(.5f, .5f)},
                       {quarter, ramp_color(.75f, .5f)},
                       {back, ramp_color(.25f, .5f)}}));
}

void add_background(Cases& all) {
  const std::string name = "mib_lookup_background.";
  // Focal length and aperture are equal, so this direction is at (.625, .25) of the picture.
  const Stage here = around(Vec3(.125f, -.25f, -1));
  add_tex(all, name + "tex", kAhead);
  all.push_back(gives(name + "zoom", here, "tex \"t\"",
                      {{"0 0 0", ramp_color(.625f, .25f)},
                       {"2 1 0", ramp_color(.5625f, .25f)},
                       {"1 2 0", ramp_color(.625f, .375f)}}));
  all.push_back(gives(name + "pan", here, "tex \"t\"",
                      {{"0 0 0", ramp_color(.625f, .25f)},
                       {".125 0 0", ramp_color(.75f, .25f)},
                       {"0 .25 0", ramp_color(.625f, .5f)}}));
  all.push_back(gives(name + "torus_u", around(Vec3(.75f, 0, -1)), "tex \"t\", torus_v on",
                      {{"off", Rgb(0)}, {"on", ramp_color(.25f, .5f)}}));
  all.push_back(gives(name + "torus_v", around(Vec3(0, -.75f, -1)), "tex \"t\", torus_u on",
                      {{"off", Rgb(0)}, {"on", ramp_color(.5f, .75f)}}));
}

/// Colours of the faces -x, x, -y, y, -z, z.
Rgb color_of_face(int face) { return Rgb(.2f * float(face), 1 - .2f * float(face), face % 2); }
/// The six faces in one picture, from the top down.
const std::string kFaces = texels("six", 1, 6, [](int, int y) {
  const int face = 5 - y;
  return fmt::format("{:02x}{:02x}{}", 51 * face, 255 - 51 * face, face % 2 ? "ff" : "00");
});

/// `point` and `size` of a shader whose call shows colour `wall` at -z and `side` at x.
void add_box(Cases& all, const std::string& shader, const std::string& call,
             const std::string& textures, const Rgb& wall, const Rgb& side) {
  const Stage stage = around(Vec3(.4f, 0, -1), textures);
  all.push_back(gives(shader + ".point", stage, call + ", size 4 4 4",
                      {{"0 0 0", wall}, {"-1.5 0 0", side}, {"-1.5 0 1.5", wall}}));
  all.push_back(gives(shader + ".size", stage, call + ", point -1.5 0 0",
                      {{"0 0 0", wall}, {"4 4 4", side}, {"4 4 1", wall}, {"8 8 8", wall}}));
}

void add_cubes(Cases& all) {
  const std::string name = "mib_lookup_cube1.";
  add_tex(all, name + "tex", kAhead);
  std::vector<Given> faces = {{"0 0 0", color_of_face(4)}};
  const Vec3 ways[] = {Vec3(-1, .5f, 0), Vec3(1, 0, .5f),  Vec3(.5f, -1, 0),
                       Vec3(0, 1, -.5f), Vec3(.5f, 0, -1), Vec3(0, .5f, 1)};
  for (int i = 0; i < 6; ++i) faces.push_back({text_of(ways[i]), color_of_face(i)});
  all.push_back(gives(name + "dir", around(Vec3(.4f, 0, -1), kFaces), "tex \"six\"", faces));
  add_box(all, "mib_lookup_cube1", "tex \"six\"", kFaces, color_of_face(4), color_of_face(1));

  const std::string six = "mib_lookup_cube6";
  const char* names[] = {"mx", "px", "my", "py", "mz", "pz"};
  for (int i = 0; i < 6; ++i)
    all.push_back(gives(fmt::format("{}.tex_{}", six, names[i]), around(ways[i]), "",
                        {{"\"a\"", kColorA}, {"\"b\"", kColorB}}));
  // The direction selects the face and the place on it.
  all.push_back(gives(six + ".dir", around(Vec3(0, 0, -1)), "tex_px \"t\", tex_mz \"a\"",
                      {{"0 0 0", kColorA},
                       {"1 0 .5", ramp_color(.75f, .5f)},
                       {"2 .5 0", ramp_color(.5f, .625f)},
                       {"0 1 0", Rgb(0)}}));
  add_box(all, six, "tex_mz \"a\", tex_px \"b\"", kRamp, kColorA, kColorB);
}

void add_cylinder(Cases& all) {
  const std::string name = "mib_lookup_cylindrical.";
  // The ray meets the cylinder at azimuth atan(4 / 3) and z = .5.
  const Vec3 way(3, 4, 2.5f);
  const Stage stage = around(way);
  const auto at = [](float azimuth, float v) { return ramp_color(azimuth / kTwoPi, v); };
  const float azimuth = std::atan2(4.0f, 3.0f);
  const Rgb here = at(azimuth, .75f);
  add_tex(all, name + "tex", way);
  all.push_back(gives(name + "xform", stage, "tex \"t\"",
                      {{"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", here},
                       {"1 0 0 0 0 1 0 0 0 0 .5 0 0 0 0 1", at(azimuth, .625f)},
                       {"0 1 0 0 -1 0 0 0 0 0 1 0 0 0 0 1", at(azimuth + kPi / 2, .75f)},
                       {"1 0 0 0 0 1 0 0 0 0 3 0 0 0 0 1", Rgb(0)}}));
  all.push_back(
      gives(name + "begin", stage, "tex \"t\", end 3", {{"0", here}, {".9", here}, {"1", Rgb(0)}}));
  all.push_back(gives(name + "end", stage, "tex \"t\", begin .5",
                      {{"1", here}, {"3", here}, {".9", Rgb(0)}}));
}

Cases cases() {
  Cases all;
  add_spherical(all);
  add_background(all);
  add_cubes(all);
  add_cylinder(all);
  return all;
}

}  // namespace base_lookup

Cases base_lookup_cases() { return base_lookup::cases(); }

}  // namespace oriel::effects
