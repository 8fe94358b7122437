// SPDX-License-Identifier: Apache-2.0
#include "prepare/tessellation_plan.h"

#include <gtest/gtest.h>

namespace oriel {
namespace tessellation_plan_test {

scene::Statement approximate(const char* technique, double number) {
  scene::Value kind, word, row;
  kind.kind = word.kind = scene::Value::Kind::Text;
  kind.bare = word.bare = true;
  kind.text = "surface";
  word.text = technique;
  row.kind = scene::Value::Kind::Numbers;
  row.numbers = {number};
  return {"approximate", false, {kind, word, row}, {}};
}

struct Placed {
  scene::Element element;
  std::vector<scene::Instance> instances;
  std::vector<scene::Leaf> leaves;
  Camera camera;

  explicit Placed(std::size_t count) : instances(count), leaves(count) {
    scene::Object object;
    scene::PolygonGroup& group = object.groups.emplace_back();
    for (const float x : {-1.0f, 1.0f}) group.vectors.emplace_back(x, 0.0f, 0.0f);
    group.vertices.point = {0, 1};
    element = std::move(object);
    for (std::size_t i = 0; i < count; ++i) {
      leaves[i].element = &element;
      leaves[i].chain = {&instances[i]};
    }
    camera.width = 100;
  }
  void put(std::size_t leaf, float distance) {
    leaves[leaf].local_to_world.setTranslation(Imath::V3f(0, 0, -distance));
  }
};

TEST(TessellationPlan, PlacementsShareAMeshUnlessInstancesHaveApproximations) {
  Placed placed(4);
  placed.instances[2].flags = {approximate("parametric", 4)};
  placed.leaves[3].flags.hidden = true;
  const TessellationPlan plan = plan_tessellation(placed.leaves, nullptr, placed.camera);
  EXPECT_EQ(plan.job_of_leaf, (std::vector<std::uint32_t>{0, 0, 1, scene::kNone}));
  ASSERT_EQ(plan.jobs.size(), 2u);
  EXPECT_TRUE(plan.jobs[0].context.chain.empty());
  EXPECT_EQ(plan.jobs[1].context.chain.size(), 1u);
}

// Width 100 pixels at distance 1 over a film as wide as it is far: a length of 2 in distance 5 is
// 40 pixels.
TEST(TessellationPlan, PixelsAreMeasuredAtTheNearestPlacement) {
  Placed placed(3);
  std::get<scene::Object>(placed.element).groups[0].settings = {approximate("length", 1)};
  placed.put(0, 50);
  placed.put(1, 5);
  placed.put(2, 20);
  const TessellationPlan plan = plan_tessellation(placed.leaves, nullptr, placed.camera);
  ASSERT_EQ(plan.jobs.size(), 1u);
  EXPECT_NEAR(plan.jobs[0].context.view.pixels({-1, 0, 0}, {1, 0, 0}), 40 / std::sqrt(2.0f), 1e-3f);
}

}  // namespace tessellation_plan_test
}  // namespace oriel
