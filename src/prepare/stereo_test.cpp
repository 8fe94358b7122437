// SPDX-License-Identifier: Apache-2.0
#include "prepare/stereo.h"

#include <gtest/gtest.h>

#include "prepare/testing/prepared_scene.h"

namespace oriel {
namespace stereo_test {

using testing::PreparedScene;

/// The camera of that eye, at (10, 0, 0) and turned to look along +x.
Camera camera_of(const std::string& statements, Eye eye) {
  PrepareOptions options;
  options.eye = eye;
  const PreparedScene s(
      "options \"opt\" object space end options\n"
      "camera \"cam\" focal 2 aperture 1 aspect 2 resolution 200 100 " +
          statements +
          " end camera\n"
          "instance \"cam_i\" \"cam\" transform 0 0 -1 0  0 1 0 0  1 0 0 0  0 0 10 1 end instance\n"
          "instgroup \"root\" \"cam_i\" end instgroup render \"root\" \"cam_i\" \"opt\"\n",
      builtin_shaders(), options);
  EXPECT_EQ(s.messages(), "");
  return s.world->camera;
}

/// Where a point of the world falls, pixels.
Vec2 pixel_of(const Camera& camera, const Vec3& point) {
  const Vec3 p = transform_point(point, camera.to_camera);
  const float x = p.x / -p.z * camera.focal, y = p.y / -p.z * camera.focal;
  return Vec2((x / camera.aperture + .5f) * static_cast<float>(camera.width),
              (y * camera.aspect / camera.aperture + .5f) * static_cast<float>(camera.height)) -
         camera.offset;
}

constexpr Vec3 kAhead(14, 0, 0);  // 4 before the camera, whose right is +z
const std::string kEyes = "eye separation .5 parallax distance 4 ";

TEST(Stereo, EyesAreOffsetByHalfTheSeparation) {
  for (const char* method : {"offset ", "offaxis ", "toein "}) {
    const Camera left = camera_of("stereo " + std::string(method) + kEyes, Eye::Left);
    const Camera right = camera_of("stereo " + std::string(method) + kEyes, Eye::Right);
    const Vec3 l = transform_point(Vec3(0), left.to_world);
    const Vec3 r = transform_point(Vec3(0), right.to_world);
    EXPECT_LT(length(l - Vec3(10, 0, -.25f)), 1e-5f) << method << l.z;
    EXPECT_LT(length(r - Vec3(10, 0, .25f)), 1e-5f) << method << r.z;
    EXPECT_LT(
        length(transform_point(transform_point(Vec3(1, 2, 3), left.to_world), left.to_camera) -
               Vec3(1, 2, 3)),
        1e-4f)
        << method;
  }
}

TEST(Stereo, PointAheadAtTheParallaxDistanceIsCentredInBoth) {
  for (const char* method : {"offaxis ", "toein ", "on "})
    for (const Eye eye : {Eye::Left, Eye::Right}) {
      const Vec2 at = pixel_of(camera_of("stereo " + std::string(method) + kEyes, eye), kAhead);
      EXPECT_NEAR(at.x, 100, 1e-3f) << method;
      EXPECT_NEAR(at.y, 50, 1e-3f) << method;
    }
  // Looking ahead, it lies aside by separation / 2 x focal / distance, 200 pixels to 1 of film.
  const Vec2 left = pixel_of(camera_of("stereo offset " + kEyes, Eye::Left), kAhead);
  EXPECT_NEAR(left.x, 100 + .25f * 2 / 4 * 200, 1e-3f);
}

TEST(Stereo, OffAxisEyesHaveTheSameFilmPlane) {
  // Heights on both pictures are the same, as they are not where eyes turn.
  const Vec3 corner(14, 1, .8f);
  const auto height = [&](const std::string& method, Eye eye) {
    return pixel_of(camera_of("stereo " + method + kEyes, eye), corner).y;
  };
  EXPECT_NEAR(height("offaxis ", Eye::Left), height("offaxis ", Eye::Right), 1e-3f);
  EXPECT_GT(std::abs(height("toein ", Eye::Left) - height("toein ", Eye::Right)), .5f);
}

TEST(Stereo, EyesOfAMovingCameraMoveWithIt) {
  PrepareOptions options;
  for (const Eye eye : {Eye::Left, Eye::Right}) {
    options.eye = eye;
    // Over the shutter it goes from the origin to (0, 3, 0).
    const PreparedScene s(
        "options \"opt\" object space shutter 1 end options\n"
        "camera \"cam\" focal 2 aperture 1 aspect 2 resolution 200 100 stereo offset eye "
        "separation "
        ".5 end camera\n"
        "instance \"cam_i\" \"cam\" transform 1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n"
        "motion transform 1 0 0 0  0 1 0 0  0 0 1 0  0 -3 0 1 end instance\n"
        "instgroup \"root\" \"cam_i\" end instgroup render \"root\" \"cam_i\" \"opt\"\n",
        builtin_shaders(), options);
    const float x = eye == Eye::Left ? -.25f : .25f;
    for (const float time : {0.0f, .5f, 1.0f}) {
      const Vec3 origin = s.world->camera.ray(Vec2(100, 50), time).origin;
      EXPECT_LT(length(origin - Vec3(x, 3 * time, 0)), 1e-5f) << origin.x << ' ' << origin.y;
    }
  }
}

TEST(Stereo, CamerasWithoutItHaveOneEye) {
  const auto eyes = [](const std::string& statements) {
    const PreparedScene s("camera \"cam\" " + statements + " end camera\n");
    EXPECT_EQ(s.messages(), "");
    return eyes_of(*s.scene.get<scene::Camera>("cam"));
  };
  EXPECT_EQ(eyes(""), std::vector{Eye::Middle});
  EXPECT_EQ(eyes("stereo off eye separation 1"), std::vector{Eye::Middle});
  EXPECT_EQ(eyes("stereo toein"), std::vector{Eye::Middle});
  EXPECT_EQ(eyes("stereo toein eye separation 1"), (std::vector{Eye::Left, Eye::Right}));
  EXPECT_EQ(eye_path("a/room.exr", Eye::Right), "a/room_right.exr");
  EXPECT_EQ(eye_path("room.exr", Eye::Middle), "room.exr");
}

}  // namespace stereo_test
}  // namespace oriel
