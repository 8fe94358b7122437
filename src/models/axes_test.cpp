// SPDX-License-Identifier: Apache-2.0
// Orientation and scale of FBX files.
#include "models/axes.h"

#include <gtest/gtest.h>

#include "models/testing/fbx_file.h"
#include "models/testing/model_file.h"
#include "support/expect_near.h"

namespace oriel::models {
namespace axes_test {

using oriel::testing::expect_near;
using testing::FbxFile;
using testing::property;

/// Image of the triangle corner on the x (or y) axis of its node.
struct Corners {
  Vec3 origin{0}, x{0}, y{0};
};

Corners corners(const FbxFile& file, std::optional<char> up = {}) {
  const testing::Folder folder;
  Diagnostics diagnostics;
  const auto scene = import_model(folder.write("m.fbx", file.text()),
                                  {folder.path() / "t", folder.path(), up}, diagnostics);
  EXPECT_TRUE(scene);
  if (!scene) return {};
  const Mat4 m = testing::to_world(*scene, "chair_inst");
  const auto* seat = scene->get<scene::Object>("seat");
  EXPECT_TRUE(seat);
  Corners found;
  if (!seat) return found;
  for (const Vec3& v : seat->groups[0].vectors) {
    const Vec3 p = transform_point(v, m);
    if (v.x == 0 && v.y == 0 && v.z == 0) found.origin = p;
    if (v.x > 0) found.x = p;
    if (v.y > 0) found.y = p;
  }
  return found;
}

TEST(ModelAxes, FileUnitsAreConvertedToMetres) {
  FbxFile file;  // centimetres
  file.triangle = property("Lcl Translation", {0, 0, 500});
  expect_near(corners(file).x, Vec3(1, 0, 5));
  file.unit = 2.54;
  expect_near(corners(file).y, Vec3(0, 2.54f, 12.7f));
}

TEST(ModelAxes, FbxUpAxisIsApplied) {
  FbxFile file;
  file.triangle = property("Lcl Translation", {100, 200, 300});
  expect_near(corners(file).origin, Vec3(1, 2, 3));
  file.axes = {2, 1, 1, -1, 0, 1};  // 3ds Max: z up, -y to the viewer
  expect_near(corners(file).origin, Vec3(1, 3, -2));
  expect_near(corners(file).y, Vec3(1, 3, -3));
  file.axes = {0, 1, 2, 1, 1, -1};  // x up, -y to the right
  expect_near(corners(file).origin, Vec3(-2, 1, 3));
}

TEST(ModelAxes, UserUpAxisOverridesTheFile) {
  FbxFile file;
  file.axes = {2, 1, 1, -1, 0, 1};
  file.triangle = property("Lcl Translation", {100, 200, 300});
  expect_near(corners(file, 'y').origin, Vec3(1, 2, 3));
  file.axes = {1, 1, 2, 1, 0, 1};
  expect_near(corners(file, 'z').origin, Vec3(1, 3, -2));
}

TEST(ModelAxes, InvalidAxesAreIgnored) {
  FbxFile file;
  file.triangle = property("Lcl Translation", {100, 200, 300});
  for (const auto& axes : {std::array{2, 1, 2, 1, 0, 1}, std::array{7, 1, 1, 1, 0, 1},
                           std::array{2, 0, 1, -1, 0, 1}, std::array{-1, 1, 1, -1, 0, 1}}) {
    file.axes = axes;
    expect_near(corners(file).origin, Vec3(1, 2, 3));
  }
}

}  // namespace axes_test
}  // namespace oriel::models
