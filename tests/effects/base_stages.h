// SPDX-License-Identifier: Apache-2.0
// Stages and scene elements that the cases of several files of base shaders share.
#pragma once

#include <fmt/format.h>

#include "effects.h"

namespace oriel::effects {

/// Result of the call as light on the inside of a cube of 4 units around the origin, seen from the
/// origin in that direction. `elements` as in value().
inline Stage inside_cube(const Vec3& direction, const std::string& elements = {}) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.statement(shown_as_light(call, elements)).box("m", Vec3(-2), Vec3(2), true);
    return Probe(scene.str(), known_shaders()).ray(Vec3(0), direction, 64);
  };
}

/// The material on a square at z = 0, hit at the origin by a ray at 45 degrees. Red is x of the
/// place where the ray meets a ground at z = -2.
inline Stage refracted_place() {
  return [](const std::string& call) {
    SceneText scene;
    scene.statement("material \"m\" " + call + " end material")
        .plate("m")
        .statement("material \"ground\" \"test_place\" ( \"scale\" 1 0 0 ) end material")
        .square("ground", Vec3(0, 0, -2), 9, Vec3(0, 0, 1));
    return Probe(scene.str(), known_shaders()).ray(Vec3(-1, 0, 1), Vec3(1, 0, -1), 64);
  };
}
/// The same by Snell's law.
inline Rgb snell(float index) {
  const float sine = std::sqrt(.5f) / index;
  return Rgb(2 * sine / std::sqrt(1 - sine * sine), 0, 0);
}

/// A colour texture named `name` of hexadecimal texels, row by row from below.
inline std::string texels(const std::string& name, int width, int height,
                          const std::function<std::string(int x, int y)>& texel) {
  std::string rows;
  for (int y = 0; y < height; ++y) {
    rows += " '";
    for (int x = 0; x < width; ++x) rows += texel(x, y);
    rows += "'";
  }
  const std::size_t components = texel(0, 0).size() / 2;
  return fmt::format("color texture \"{}\" [{} {} {}]{}\n", name, width, height, components, rows);
}

/// Textures "a" and "b" of one colour, kColorA and kColorB.
inline const Rgb kColorA(.2f, .4f, .6f), kColorB(1, .2f, 0);
inline const std::string kPlainTextures =
    "color texture \"a\" [1 1 3] '336699'\ncolor texture \"b\" [1 1 3] 'ff3300'\n";

/// Texture "t" of 4 x 4 texels: red rises by .2 per texel to the right, green by .2 upward.
inline const std::string kRampTexture =
    texels("t", 4, 4, [](int x, int y) { return fmt::format("{:02x}{:02x}00", 51 * x, 51 * y); });
/// Colour of that texture between the centres of its outer texels.
inline Rgb ramp_color(float u, float v) { return Rgb((u - .125f) * .8f, (v - .125f) * .8f, 0); }

inline constexpr char kAxes[] = {'x', 'y', 'z'};
/// The vector with another value in one axis.
inline Vec3 with_axis(Vec3 v, int axis, float value) {
  v[axis] = value;
  return v;
}

}  // namespace oriel::effects
