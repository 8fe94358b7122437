// SPDX-License-Identifier: Apache-2.0
// Cameras and lights of 3DS files.
#include "models/views_3ds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "models/testing/fbx_file.h"
#include "models/testing/model_file.h"
#include "support/expect_near.h"

namespace oriel::models {
namespace views_3ds_test {

using oriel::testing::expect_near;
using testing::imported;

template <class T>
std::string bytes(T value) {
  std::string text(sizeof value, '\0');
  std::memcpy(text.data(), &value, sizeof value);
  return text;
}
std::string reals(const std::vector<float>& values) {
  std::string text;
  for (const float v : values) text += bytes(v);
  return text;
}
std::string word(const char* text) { return std::string(text) + '\0'; }

std::string chunk(std::uint16_t kind, const std::string& content) {
  return bytes(kind) + bytes(static_cast<std::uint32_t>(content.size() + 6)) + content;
}

/// A track with keys at frames 0, 1, ...
std::string track(std::uint16_t kind, const std::vector<std::string>& keys) {
  std::string content = bytes(std::uint16_t{0}) + bytes(std::uint32_t{0}) +
                        bytes(std::uint32_t{0}) + bytes(static_cast<std::uint32_t>(keys.size()));
  for (std::size_t i = 0; i < keys.size(); ++i)
    content += bytes(static_cast<std::uint32_t>(i)) + bytes(std::uint16_t{0}) + keys[i];
  return chunk(kind, content);
}

/// A triangle at the origin, a camera at (0, -50, 20) with a lens of 60 that looks at (0, 0, 20),
/// and a spot light at (30, 0, 40) that points down. z is up in the file.
std::string file(float roll, const std::string& tracks) {
  std::string triangle =
      chunk(0x4110, bytes(std::uint16_t{3}) + reals({0, 0, 0, 9, 0, 0, 0, 0, 9}));
  std::string face = bytes(std::uint16_t{1});
  for (const std::uint16_t i : {0, 1, 2, 0}) face += bytes(i);
  triangle += chunk(0x4120, face);
  const std::string camera = reals({0, -50, 20, 0, 0, 20, roll, 60});
  const std::string spot = reals({30, 0, 40}) + chunk(0x4610, reals({30, 0, 0, 30, 40}));
  return chunk(0x4d4d, chunk(0x3d3d, chunk(0x4000, word("chair") + chunk(0x4100, triangle)) +
                                         chunk(0x4000, word("eye") + chunk(0x4700, camera)) +
                                         chunk(0x4000, word("lamp") + chunk(0x4600, spot))) +
                           (tracks.empty() ? "" : chunk(0xb000, tracks)));
}

std::string node(std::uint16_t kind, const char* name, const std::string& keys) {
  return chunk(kind, chunk(0xb010, word(name) + bytes(std::uint16_t{0}) + bytes(std::uint16_t{0}) +
                                       bytes(std::uint16_t{0xffff})) +
                         keys);
}

/// y of the file points away from the viewer: (0, -50, 20) becomes (0, 20, 50), and y becomes -z.
void expect_views(const scene::Scene& scene) {
  expect_near(testing::to_world(scene, "eye_inst").translation(), Vec3(0, 20, 50), 1e-3f);
  expect_near(testing::view_of(scene, "eye_inst"), Vec3(0, 0, -1));
  const auto* lamp = scene.get<scene::Light>("lamp");
  ASSERT_TRUE(lamp && lamp->origin && lamp->direction);
  const Mat4 m = testing::to_world(scene, "lamp_inst");
  expect_near(transform_point(*lamp->origin, m), Vec3(30, 40, 0), 1e-3f);
  expect_near(normalize(transform_vector(*lamp->direction, m)), Vec3(0, -1, 0));
  ASSERT_TRUE(lamp->spread);
  EXPECT_NEAR(*lamp->spread, std::cos(20 * kPi / 180), 1e-5f) << "40 degrees across";
}

TEST(Model3ds, ViewsHaveTheTransformsOfTheFile) {
  const scene::Scene scene = imported("m.3ds", file(0, ""));
  expect_views(scene);
  expect_near(transform_vector(Vec3(0, 1, 0), testing::to_world(scene, "eye_inst")), Vec3(0, 1, 0));
  // 2400 / 60 = 40 degrees, horizontally.
  // acceptance: M2
  const auto* camera = scene.get<scene::Camera>("eye");
  ASSERT_TRUE(camera);
  EXPECT_NEAR(*camera->aperture / 2 / *camera->focal, std::tan(20 * kPi / 180), 1e-4f);
}

TEST(Model3ds, AnimatedNodesDoNotMoveViews) {
  const std::string still = reals({0, -50, 20}), later = reals({5, -50, 20});
  const scene::Scene scene = imported(
      "m.3ds",
      file(0, node(0xb002, "chair", track(0xb020, {reals({0, 0, 0})})) +
                  node(0xb003, "eye",
                       track(0xb020, {still, later}) + track(0xb024, {reals({0}), reals({9})})) +
                  node(0xb007, "lamp", track(0xb020, {reals({30, 0, 40}), reals({0, 0, 40})}))));
  expect_views(scene);
}

TEST(Model3ds, RollTurnsAboutTheView) {
  const scene::Scene scene = imported("m.3ds", file(90, ""));
  const Mat4 m = testing::to_world(scene, "eye_inst");
  expect_near(testing::view_of(scene, "eye_inst"), Vec3(0, 0, -1));
  EXPECT_NEAR(std::fabs(transform_vector(Vec3(0, 1, 0), m).x), 1, 1e-5f);
}

TEST(Model3ds, TruncatedFilesDoNotCrash) {
  const std::string whole = file(0, "");
  const scene::Scene scene = imported("m.3ds", whole);
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    const testing::Folder folder;
    Diagnostics diagnostics;
    import_model(folder.write("m.3ds", whole.substr(0, size)), {folder.path(), folder.path()},
                 diagnostics);
  }
  EXPECT_TRUE(scene.get<scene::Camera>("eye"));
}

}  // namespace views_3ds_test
}  // namespace oriel::models
