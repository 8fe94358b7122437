// SPDX-License-Identifier: Apache-2.0
// Meshes that are made and displaced in parallel: the same as one after the other.
#include "prepare/mesh_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/parallel.h"
#include "prepare/testing/prepared_scene.h"

namespace oriel {
namespace mesh_table_test {

constexpr const char* kMaterials =
    "material \"m\" \"mib_illum_lambert\" ( ) end material\n"
    "material \"lifted\" \"mib_illum_lambert\" ( ) displace \"mib_texture_turbulence\" "
    "( \"coord\" .3 .4 .5 ) end material\n";

/// Polygons without area of one object, so that its tessellation takes some time.
constexpr int kWithoutArea = 400;

/// A square, and polygons without area, which are reported.
std::string object(int i, const std::string& approximation, const std::string& flags = {}) {
  std::string without_area;
  for (int k = 0; k < kWithoutArea; ++k) without_area += "p 0 0 0 ";
  return fmt::format(
      "object \"o{0}\" visible trace shadow {2} group\n"
      "0 0 0 1 0 0 1 1 0 0 1 0 v 0 v 1 v 2 v 3 p 0 1 2 3 {3}\n{1}\nend group end object\n"
      "instance \"i{0}\" \"o{0}\" material [ \"lifted\" ] "
      "transform 1 0 0 0 0 1 0 0 0 0 1 0 {0} 0 5 1 end instance\n",
      i, approximation, flags, without_area);
}

struct Objects {
  std::string text = kMaterials, members;
  int count = 0;
  void add(const std::string& approximation, const std::string& flags = {}) {
    text += object(count, approximation, flags);
    members += fmt::format("\"i{}\" ", count++);
  }
  std::string scene() const { return testing::scene_text(text, members); }
};

std::vector<const geom::Mesh*> meshes_of(const World& world) {
  std::vector<const geom::Mesh*> meshes;
  for (std::uint32_t i = 0; i < world.accel->instance_count(); ++i)
    meshes.push_back(&world.accel->mesh(world.accel->instance(i).mesh));
  return meshes;
}

TEST(MeshTable, ThreadsChangeNeitherMeshesNorTheOrderOfMessages) {
  Objects objects;
  // The first objects take the longest.
  for (int i = 0; i < 40; ++i)
    objects.add(fmt::format("approximate displace parametric {}", i < 20 ? 5 : 2),
                "max displace .01");
  const std::string text = objects.scene();
  const auto prepared = [&](int threads) {
    const ThreadLimit limit(threads);
    return std::make_unique<testing::PreparedScene>(text);
  };
  const auto one = prepared(1);
  ASSERT_NE(one->world, nullptr) << one->messages();
  for (int i = 0; i < 40; ++i)
    for (const char* what : {"of its polygons are skipped", "displacement reaches"}) {
      const std::string name = fmt::format("object \"o{}\"", i);
      const auto& all = one->diagnostics.all();
      EXPECT_EQ(std::count_if(all.begin(), all.end(),
                              [&](const Diagnostic& d) {
                                return d.message.find(name) != std::string::npos &&
                                       d.message.find(what) != std::string::npos;
                              }),
                1)
          << name << ": " << what;
    }
  const auto one_meshes = meshes_of(*one->world);
  for (const int threads : {2, 3})
    for (int run = 0; run < 4; ++run) {
      const auto more = prepared(threads);
      EXPECT_EQ(more->messages(), one->messages()) << threads;
      const auto meshes = meshes_of(*more->world);
      ASSERT_EQ(meshes.size(), one_meshes.size());
      for (std::size_t i = 0; i < meshes.size(); ++i) {
        EXPECT_EQ(meshes[i]->positions, one_meshes[i]->positions) << i;
        EXPECT_EQ(meshes[i]->normals, one_meshes[i]->normals) << i;
      }
    }
}

// A budget of 9000 triangles for four objects of 2, 2048, 8192 and 2 triangles. The share of each
// is 2250; the budget is enough for the first two and the last, and for a part of the third.
TEST(MeshTable, AnObjectMayTakeWhatTheOthersLeave) {
  Objects objects;
  for (const int halvings : {0, 5, 6, 0})
    objects.add(fmt::format("approximate displace parametric {}", halvings));
  const auto triangles = [&](std::uint64_t budget) {
    Diagnostics diagnostics;
    mi::ReadOptions read;
    read.packages = builtin_packages();
    read.knows_shader = [](std::string_view n) { return builtin_shaders().find(n) != nullptr; };
    scene::Scene scene = mi::read_text(objects.scene(), read, diagnostics, "scene.mi");
    scene.budgets.set(Budget::Triangles, budget);
    PrepareReport report;
    const auto world =
        prepare(scene, scene.renders.back(), builtin_shaders(), {}, diagnostics, report);
    std::vector<std::size_t> counts;
    for (const geom::Mesh* mesh : meshes_of(*world))
      if (mesh->triangles.size() > 2 || mesh->slots.size() == 1)
        counts.push_back(mesh->triangles.size());
    return std::pair(counts, diagnostics.has("OR-RN-081"));
  };
  const auto [all, all_limited] = triangles(1000000);
  EXPECT_FALSE(all_limited);
  const auto has = [](const std::vector<std::size_t>& counts, std::size_t n) {
    return std::find(counts.begin(), counts.end(), n) != counts.end();
  };
  EXPECT_TRUE(has(all, 2048) && has(all, 8192));
  // 8192 are more than a quarter of the budget.
  const auto [enough, enough_limited] = triangles(16000);
  EXPECT_EQ(enough, all);
  EXPECT_FALSE(enough_limited);
  const auto [some, some_limited] = triangles(9000);
  EXPECT_TRUE(some_limited);
  EXPECT_TRUE(has(some, 2048)) << "not affected by the limit of the larger object";
  EXPECT_TRUE(has(some, 2048) && !has(some, 8192));
}

}  // namespace mesh_table_test
}  // namespace oriel
