// SPDX-License-Identifier: Apache-2.0
// Nodes of glTF files: instances, cycles, chains, cameras.
#include "models/gltf/plain_nodes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/testing/gltf_file.h"

namespace oriel::models {
namespace plain_nodes_test {

using testing::GltfFile;
using testing::json;
using testing::Made;
using testing::world_points;

TEST(GltfNodes, InstancesHaveTheTransformsOfTheirAttributes) {
  GltfFile file;
  file.add_triangle();
  const float half = std::sqrt(.5f);
  json& attributes = file.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes["TRANSLATION"] = file.add<float>({1, 2, 3, 4, 5, 6}, testing::kFloat, "VEC3", 3);
  // A quarter turn about z: x to y.
  const auto s = static_cast<std::int16_t>(std::lround(half * 32767));
  attributes["ROTATION"] =
      file.add<std::int16_t>({0, 0, 0, 32767, 0, 0, s, s}, testing::kShort, "VEC4", 4, true);
  attributes["SCALE"] = file.add<float>({1, 1, 1, 2, 3, 1}, testing::kFloat, "VEC3", 3);
  file.node()["translation"] = {100, 0, 0};
  file.root["extensionsUsed"] = file.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  Made made;
  made.import(file.text());
  ASSERT_TRUE(made.scene);
  EXPECT_TRUE(made.diagnostics.all().empty());
  EXPECT_TRUE(made.scene->get<scene::Instance>("thing_1_inst"));
  const std::vector<Vec3> points = world_points(*made.scene);
  const std::vector<Vec3> wanted{{101, 2, 3}, {102, 2, 3}, {101, 3, 3},
                                 {104, 5, 6}, {104, 7, 6}, {101, 5, 6}};
  ASSERT_EQ(points.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_LT(length(points[i] - wanted[i]), 2e-4f) << i;
}

TEST(GltfNodes, InvalidInstancesAreSkippedAndTheMeshRemains) {
  for (const char* type : {"SCALAR", "VEC3"}) {
    GltfFile file;
    file.add_triangle();
    file.root["accessors"].push_back({{"componentType", testing::kFloat},
                                      {"count", type[0] == 'S' ? 2 : 300000},
                                      {"type", type}});
    file.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 1;
    Made made;
    made.import(file.text());
    ASSERT_TRUE(made.scene);
    EXPECT_TRUE(made.said("instances are skipped")) << type;
    EXPECT_EQ(world_points(*made.scene).size(), 3u);
  }
}

TEST(GltfNodes, CyclesAndSharedNodesAreVisitedOnce) {
  GltfFile file;
  file.add_triangle();
  file.node()["children"] = {0, 1, 1, 99, -1};
  file.root["nodes"].push_back({{"mesh", 0}, {"children", {0, 1}}});
  file.root["scenes"][0]["nodes"] = {0, 0, 1};
  Made made;
  made.import(file.text());
  ASSERT_TRUE(made.scene);
  EXPECT_EQ(world_points(*made.scene).size(), 6u);
}

TEST(GltfNodes, NodeDepthIsLimited) {
  GltfFile file;
  file.add_triangle();
  file.root["nodes"] = json::array();
  constexpr int kChain = 100'000;
  for (int i = 0; i < kChain; ++i)
    file.root["nodes"].push_back({{"children", json::array({i + 1})}, {"mesh", 0}});
  Made made;
  made.import(file.text());
  ASSERT_TRUE(made.scene);
  EXPECT_TRUE(made.said("nodes nested deeper than 500"));
}

TEST(GltfNodes, FilesWithoutASceneImportAllRoots) {
  GltfFile file;
  file.add_triangle();
  file.root["nodes"] =
      json::array({{{"mesh", 0}}, {{"children", {0}}, {"translation", {0, 0, 1}}}});
  file.root.erase("scene");
  file.root.erase("scenes");
  Made made;
  made.import(file.text());
  ASSERT_TRUE(made.scene);
  EXPECT_EQ(world_points(*made.scene), (std::vector<Vec3>{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}));
}

TEST(GltfNodes, ParallelCamerasSeeTwiceTheirMagnification) {
  GltfFile file;
  file.add_triangle();
  file.node()["camera"] = 0;
  file.root["cameras"] =
      json::array({{{"type", "orthographic"},
                    {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", .1}, {"zfar", 10}}}}});
  Made made;
  made.import(file.text());
  ASSERT_TRUE(made.scene);
  const scene::Camera* camera = nullptr;
  for (const scene::Element& e : made.scene->elements())
    if (const auto* found = std::get_if<scene::Camera>(&e)) camera = found;
  ASSERT_TRUE(camera);
  EXPECT_TRUE(camera->orthographic);
  EXPECT_FALSE(camera->focal);
  // xmag is half of the width: specification, 3.10.3.4 (orthographic projection).
  EXPECT_FLOAT_EQ(*camera->aperture, 6);
  EXPECT_FLOAT_EQ(*camera->aspect, 1.5f);
}

}  // namespace plain_nodes_test
}  // namespace oriel::models
