// SPDX-License-Identifier: Apache-2.0
#include "interactive/view_settings.h"

#include <gtest/gtest.h>

namespace oriel::interactive {
namespace {

Camera camera_with(const Look& look) {
  Camera camera;
  camera.to_camera = *camera_matrix(look);
  camera.to_world = camera.to_camera.inverse();
  return camera;
}

void expect_same_camera(const Look& a, const Look& b) {
  EXPECT_TRUE(camera_matrix(a)->equalWithAbsError(*camera_matrix(b), 1e-4f));
}

// Navigation rotates about `up`: with the camera's own, the horizon would tilt.
TEST(ViewSettings, UpIsTheVerticalOfAnUprightCamera) {
  for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0, 1, 0)}) {
    const Look looks_down{Vec3(5, 4, 6), Vec3(1, 0.5f, 0.2f), up};
    const Look found = look_of(camera_with(looks_down), 3);
    EXPECT_EQ(found.up, up);
    expect_same_camera(found, looks_down);
  }
}

TEST(ViewSettings, UpOfARolledCameraIsItsOwn) {
  const Look rolled{Vec3(5, 4, 6), Vec3(1, 0.5f, 0.2f), Vec3(0.2f, 0.1f, 1)};
  const Look found = look_of(camera_with(rolled), 3);
  EXPECT_NE(found.up, Vec3(0, 0, 1));
  expect_same_camera(found, rolled);
}

}  // namespace
}  // namespace oriel::interactive
