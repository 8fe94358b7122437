// SPDX-License-Identifier: Apache-2.0
#include "prepare/stereo.h"

#include <filesystem>

#include "base/math.h"
#include "scene/element_settings.h"

namespace oriel {
std::vector<Eye> eyes_of(const scene::Camera& camera) {
  const scene::CameraSettings settings = settings_of(camera);
  if (settings.stereo == scene::Stereo::None || settings.eye_separation == 0) return {Eye::Middle};
  return {Eye::Left, Eye::Right};
}

void take_eye(const scene::CameraSettings& settings, Eye eye, Camera& camera) {
  if (eye == Eye::Middle) return;
  using scene::Stereo;
  const float aside = settings.eye_separation / (eye == Eye::Left ? -2.0f : 2.0f);
  const float distance = settings.parallax_distance;
  Mat4 to_middle;
  if (settings.stereo == Stereo::ToeIn && distance > 0) {
    // Rotates -z towards the centre: (-aside, 0, -distance).
    const float hypotenuse = math::hypot(aside, distance);
    const float cosine = distance / hypotenuse, sine = aside / hypotenuse;
    to_middle[0][0] = to_middle[2][2] = cosine;
    to_middle[2][0] = sine, to_middle[0][2] = -sine;
  } else if (settings.stereo == Stereo::OffAxis && distance > 0 && !camera.orthographic) {
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
