// SPDX-License-Identifier: Apache-2.0
// Final gathering on moving objects: gather points move with them.
#include "motion_scenes.h"

namespace oriel::testing {
namespace motion_gather_test {

/// A court whose floor gets dark toward its walls, under a sky; and the camera above it. All goes
/// the same way.
Image court(const char* shutter, const std::string& way) {
  SceneText s(std::string("trace depth 4 4 8 finalgather on ") + shutter);
  s.lambert("floor", .5f)
      .lambert("wall", .2f)
      .polygon("floor", {Vec3(-1, -1, -2), Vec3(1, -1, -2), Vec3(1, 1, -2), Vec3(-1, 1, -2)})
      .polygon("wall", {Vec3(-1, -1, -2), Vec3(-1, 1, -2), Vec3(-1, 1, -1), Vec3(-1, -1, -1)})
      .polygon("wall", {Vec3(1, -1, -2), Vec3(1, -1, -1), Vec3(1, 1, -1), Vec3(1, 1, -2)})
      .group("car", way)
      .uniform_sky(1)
      .camera("focal 1 aperture 1 aspect 1 resolution 24 24", shift(0) + " " + way);
  std::string text = s.str();
  const std::string path = "\"indirect\" \"path\"";
  return rendered(text.replace(text.find(path), path.size(), "\"indirect\" \"scene\""), 16);
}

TEST(MovingGather, SceneMovingWithTheCameraEqualsAStaticOne) {
  const Image still = court("", "");
  const Image moving = court("shutter 1", moves_by(1.2f, .3f));
  double sum = 0, difference = 0;
  for (std::size_t i = 0; i < still.pixels.size(); ++i) {
    sum += static_cast<double>(still.pixels[i]);
    difference += std::abs(static_cast<double>(still.pixels[i] - moving.pixels[i]));
  }
  EXPECT_GT(sum, .1 * static_cast<double>(still.pixels.size()));
  EXPECT_LT(difference, .01 * sum);
}

}  // namespace motion_gather_test
}  // namespace oriel::testing
