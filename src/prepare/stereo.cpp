// SPDX-License-Identifier: Apache-2.0
#include "prepare/stereo.h"

#include <cmath>
#include <filesystem>

#include "base/math.h"

namespace oriel {
namespace {

using scene::Value;

/// The first number of the last such statement; 0 where there is none, or one without measure.
float number_of(const scene::Camera& camera, std::string_view keyword) {
  constexpr double kLargest = 1e9;
  const scene::Statement* s = find_last(camera.other, keyword);
  if (!s || s->values.empty() || s->values[0].numbers.empty()) return 0;
  const double number = s->values[0].numbers[0];
  return std::abs(number) < kLargest ? static_cast<float>(number) : 0;
}

/// Empty: no stereo.
std::string method_of(const scene::Camera& camera) {
  const scene::Statement* s = find_last(camera.other, "stereo");
  if (!s) return {};
  if (s->values.empty()) return "offaxis";
  const Value& v = s->values[0];
  if (v.kind == Value::Kind::Boolean) return v.boolean ? "offaxis" : "";
  std::string word = v.text;
  std::erase_if(word, [](char c) { return c == ' ' || c == '_' || c == '-'; });
  return word;
}

}  // namespace

std::vector<Eye> eyes_of(const scene::Camera& camera) {
  if (method_of(camera).empty() || number_of(camera, "eye separation") == 0) return {Eye::Middle};
  return {Eye::Left, Eye::Right};
}

void take_eye(const scene::Camera& element, Eye eye, Camera& camera) {
  if (eye == Eye::Middle) return;
  const std::string method = method_of(element);
  const float aside = number_of(element, "eye separation") / (eye == Eye::Left ? -2.0f : 2.0f);
  const float distance = number_of(element, "parallax distance");
  Mat4 to_middle;
  if (method == "toein" && distance > 0) {
    // Turns -z towards the middle: (-aside, 0, -distance).
    const float hypotenuse = math::hypot(aside, distance);
    const float cosine = distance / hypotenuse, sine = aside / hypotenuse;
    to_middle[0][0] = to_middle[2][2] = cosine;
    to_middle[2][0] = sine, to_middle[0][2] = -sine;
  } else if (method == "offaxis" && distance > 0 && !camera.orthographic) {
    camera.offset.x -=
        aside / distance * camera.focal / camera.aperture * static_cast<float>(camera.width);
  }
  to_middle[3][0] = aside;
  camera.to_world = to_middle * camera.to_world;
  camera.to_camera = camera.to_camera * to_middle.inverse();
  for (Mat4& key : camera.path) key = to_middle * key;
}

std::string eye_path(const std::string& path, Eye eye) {
  if (eye == Eye::Middle) return path;
  const std::filesystem::path p(path);
  return (p.parent_path() /
          (p.stem().string() + (eye == Eye::Left ? "_left" : "_right") + p.extension().string()))
      .string();
}

}  // namespace oriel
