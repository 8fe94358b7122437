// SPDX-License-Identifier: Apache-2.0
// Skins, morph weights and animations of glTF files, compared with matrices by hand.
#include "models/gltf/pose.h"

#include <cmath>

#include "models/testing/gltf_file.h"
#include "support/expect_near.h"

namespace oriel::models {
namespace pose_test {

using oriel::testing::expect_near;
using testing::GltfFile;
using testing::json;
using testing::Made;

/// A strip along y from 0 to 2 in the plane z = 0: pairs of vertices at y = 0, 1 and 2, with the
/// weights 0, 1/2 and 1 of the upper joint. The joints are at y = 0 and y = 1.
GltfFile strip() {
  GltfFile file;
  std::vector<float> points, normals, weights;
  std::vector<std::uint8_t> joints;
  for (int y = 0; y < 3; ++y)
    for (const float x : {-.5f, .5f}) {
      points.insert(points.end(), {x, static_cast<float>(y), 0});
      normals.insert(normals.end(), {0, 0, 1});
      const float upper = static_cast<float>(y) / 2;
      weights.insert(weights.end(), {1 - upper, upper, 0, 0});
      joints.insert(joints.end(), {0, 1, 0, 0});
    }
  json& attributes = file.primitive()["attributes"];
  attributes["POSITION"] = file.add<float>(points, testing::kFloat, "VEC3", 3);
  attributes["NORMAL"] = file.add<float>(normals, testing::kFloat, "VEC3", 3);
  attributes["WEIGHTS_0"] = file.add<float>(weights, testing::kFloat, "VEC4", 4);
  attributes["JOINTS_0"] = file.add<std::uint8_t>(joints, testing::kUnsignedByte, "VEC4", 4);
  file.primitive()["indices"] = file.add<std::uint16_t>({0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5},
                                                        testing::kUnsignedShort, "SCALAR", 1);
  // The inverses of the joints' places.
  const std::vector<float> inverse = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                      1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1};
  file.root["skins"] = {
      {{"joints", {1, 2}},
       {"inverseBindMatrices", file.add<float>(inverse, testing::kFloat, "MAT4", 16)}}};
  file.node()["skin"] = 0;
  // The place of a skinned mesh is that of its joints.
  file.node()["translation"] = {100, 100, 100};
  file.root["nodes"].push_back({{"name", "lower"}, {"children", {2}}});
  file.root["nodes"].push_back({{"name", "upper"}, {"translation", {0, 1, 0}}});
  file.root["scenes"][0]["nodes"] = {0, 1};
  return file;
}

/// The turn of the upper joint about x, in radians.
void turn(json& node, float angle) {
  node["rotation"] = {std::sin(angle / 2), 0, 0, std::cos(angle / 2)};
}

std::vector<Vec3> points_of(GltfFile& file, std::optional<float> seconds = {}) {
  Made made;
  const std::string path = made.folder.write("m.gltf", file.text());
  made.scene = import_model(path,
                            {.texture_folder = made.folder.path() / "t",
                             .scene_folder = made.folder.path(),
                             .seconds = seconds},
                            made.diagnostics);
  EXPECT_TRUE(made.scene);
  for (const Diagnostic& d : made.diagnostics.all())
    if (d.code != "OR-MD-007") ADD_FAILURE() << made.diagnostics.format(d);
  return made.scene ? testing::world_points(*made.scene) : std::vector<Vec3>();
}

/// Vertices of the strip whose upper joint is turned: the middle ones are halfway between their
/// places by both joints, which agree there, because the joint lies between them.
void expect_bent(const std::vector<Vec3>& points, float angle, const Vec3& moved = Vec3(0)) {
  ASSERT_EQ(points.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const float x = i % 2 == 0 ? -.5f : .5f;
    Vec3 expected(x, static_cast<float>(i / 2), 0);
    if (i / 2 == 2) expected = {x, 1 + std::cos(angle), std::sin(angle)};
    expect_near(points[i], expected + moved, 1e-5f);
  }
}

TEST(GltfPose, SkinsFollowTheirJoints) {
  GltfFile file = strip();
  expect_bent(points_of(file), 0);
  turn(file.root["nodes"][2], .7f);
  expect_bent(points_of(file), .7f);
  file.root["nodes"][1]["translation"] = {3, 4, 5};
  expect_bent(points_of(file), .7f, {3, 4, 5});
}

// Linear blending: a vertex between joints is at the mean of its two places.
TEST(GltfPose, WeightsBlendPlaces) {
  GltfFile file = strip();
  file.root["nodes"][2]["translation"] = {0, 1, 8};
  const std::vector<Vec3> points = points_of(file);
  ASSERT_EQ(points.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(points[i].z, 4.f * static_cast<float>(i / 2), 1e-5f);
}

TEST(GltfPose, NormalsTurnWithTheirJoints) {
  GltfFile file = strip();
  turn(file.root["nodes"][1], .7f);
  Made made;
  made.import(file.text());
  ASSERT_TRUE(made.scene);
  const scene::PolygonGroup& group = made.group();
  for (const std::uint32_t corner : group.vertices.normal)
    expect_near(group.vectors.at(corner), Vec3(0, -std::sin(.7f), std::cos(.7f)), 1e-5f);
}

/// Adds an animation of the upper joint with keys at 1 and 3 s.
void animate(GltfFile& file, const char* path, const std::vector<float>& values,
             const char* interpolation, std::size_t width) {
  const std::size_t times = file.add<float>({1, 3}, testing::kFloat, "SCALAR", 1);
  const std::size_t output =
      file.add<float>(values, testing::kFloat, width == 4 ? "VEC4" : "VEC3", width);
  file.root["animations"] = {
      {{"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", path}}}}}},
       {"samplers", {{{"input", times}, {"output", output}, {"interpolation", interpolation}}}}}};
}

// Spherical interpolation has constant angular speed: at 1.5 s a quarter of the turn.
TEST(GltfPose, RotationsAreInterpolatedOnTheSphere) {
  GltfFile file = strip();
  animate(file, "rotation", {0, 0, 0, 1, std::sin(.6f), 0, 0, std::cos(.6f)}, "LINEAR", 4);
  expect_bent(points_of(file), 0);  // without a time
  for (const auto& [seconds, angle] :
       {std::pair(0.f, 0.f), {1.f, 0.f}, {1.5f, .3f}, {2.f, .6f}, {3.f, 1.2f}, {9.f, 1.2f}}) {
    SCOPED_TRACE(seconds);
    expect_bent(points_of(file, seconds), angle);
  }
}

TEST(GltfPose, TranslationsAreInterpolatedByTheirMethod) {
  const struct {
    const char* interpolation;
    std::vector<float> values;
    float at_half;  ///< z of the upper joint at 2 s
  } kCases[] = {
      {"LINEAR", {0, 1, 2, 0, 1, 6}, 4},
      {"STEP", {0, 1, 2, 0, 1, 6}, 2},
      // Hermite's cubic at the middle: (p + q) / 2 + length (out - in) / 8, for a length of 2.
      {"CUBICSPLINE",
       {0, 0, 9, 0, 1, 2, 0, 0, 3, 0, 0, 1, 0, 1, 6, 0, 0, 9},
       4 + 2 * (3 - 1) / 8.f},
  };
  for (const auto& c : kCases) {
    GltfFile file = strip();
    animate(file, "translation", c.values, c.interpolation, 3);
    const std::vector<Vec3> points = points_of(file, 2.f);
    ASSERT_EQ(points.size(), 6u);
    EXPECT_NEAR(points[5].z, c.at_half, 1e-5f);
  }
}

// The weights of a node replace those of its mesh; another node keeps them.
TEST(GltfPose, NodesMorphTheirMeshes) {
  GltfFile file;
  file.add_triangle();
  file.primitive()["targets"] = {
      {{"POSITION", file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, testing::kFloat, "VEC3", 3)}}};
  file.root["meshes"][0]["weights"] = {.25};
  file.root["nodes"].push_back({{"name", "other"}, {"mesh", 0}, {"weights", {2}}});
  file.root["scenes"][0]["nodes"] = {0, 1};
  const std::vector<Vec3> points = points_of(file);
  ASSERT_EQ(points.size(), 6u);
  float sum = 0;
  for (const Vec3& p : points) sum += p.z;
  EXPECT_NEAR(sum, 3 * .25f + 3 * 2, 1e-5f);
}

TEST(GltfPose, DamagedSkinsAreReported) {
  GltfFile file = strip();
  file.root["skins"][0]["inverseBindMatrices"] = 99;
  Made made;
  made.import(file.text());
  EXPECT_TRUE(made.scene);
  EXPECT_TRUE(made.said("OR-MD-020"));
}

}  // namespace pose_test
}  // namespace oriel::models
