// SPDX-License-Identifier: Apache-2.0
#include "sdk/shader_elements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "oriel/sdk/shader.h"
#include "sdk/current.h"
#include "sdk/testing/bare_state.h"

namespace oriel::sdk {
namespace shader_elements_test {

using testing::BareState;

/// A renderer whose shaders run in this thread.
struct Running : BareState {
  Running() { set_current_host(&host()); }
};

TEST(ShaderElements, AreZeroAfterGrowth) {
  ShaderElements elements;
  const miTag tag = elements.create(miSCENE_USERDATA, 8);
  auto* bytes = static_cast<unsigned char*>(elements.bytes(tag));
  ASSERT_TRUE(bytes);
  EXPECT_EQ(std::count(bytes, bytes + 8, 0), 8);
  std::memset(bytes, 0xff, 8);
  ASSERT_TRUE(elements.resize(tag, 4000));
  bytes = static_cast<unsigned char*>(elements.bytes(tag));
  EXPECT_EQ(std::count(bytes, bytes + 8, 0xff), 8);
  EXPECT_EQ(std::count(bytes + 8, bytes + 4000, 0), 3992);
  EXPECT_EQ(elements.size(tag), 4000u);
  EXPECT_EQ(elements.sum().bytes, 4000u);
  EXPECT_TRUE(elements.erase(tag));
  EXPECT_FALSE(elements.erase(tag));
  EXPECT_EQ(elements.bytes(tag), nullptr);
  EXPECT_EQ(elements.sum().elements, 0u);
  EXPECT_NE(elements.create(miSCENE_USERDATA, 0), tag) << "tags are not given twice";
}

TEST(ShaderElements, TreesStayWhileTheyAreOpen) {
  ShaderElements elements;
  const miTag tag = elements.create(std::make_shared<geom::PointTree>(1, 0));
  geom::PointTree* tree = elements.pin(tag);
  ASSERT_TRUE(tree);
  EXPECT_EQ(elements.pin(tag), tree);
  elements.unpin(tree);
  elements.erase_tree(tag);
  EXPECT_EQ(elements.pin(tag), nullptr);
  const float place = 1;
  EXPECT_TRUE(tree->add(&place, nullptr));
  elements.unpin(tree);
  elements.unpin(tree);  // one time too many
  EXPECT_EQ(elements.bytes(tag), nullptr);
}

TEST(ShaderElements, TagsOfNothingHaveNone) {
  Running running;
  for (miTag kind = 0; kind < 64; ++kind) {
    // These exist once, whatever the index; the elements by name have a record without a name.
    const auto k = static_cast<TagKind>(kind);
    if (k >= TagKind::Camera && k <= TagKind::Root) continue;
    EXPECT_EQ(mi_db_access(make_tag(k, 12345)), nullptr) << kind;
  }
}

TEST(ShaderElements, AreOfOneFrame) {
  Running running;
  miTag tag = 0;
  ASSERT_TRUE(mi_db_create(&tag, miSCENE_USERDATA, 16));
  EXPECT_EQ(mi_db_size(tag), 16);
  running.host().end_frame();
  EXPECT_EQ(mi_db_access(tag), nullptr);
  EXPECT_EQ(mi_db_type(tag), miSCENE_NONE);
}

TEST(ShaderElements, InvalidElementsAreNull) {
  Running running;
  miTag tag = 7;
  EXPECT_EQ(mi_db_create(&tag, miSCENE_NONE, 16), nullptr);
  EXPECT_EQ(tag, miNULLTAG);
  EXPECT_EQ(mi_db_create(&tag, miSCENE_USERDATA, -1), nullptr);
  EXPECT_EQ(mi_db_realloc(miNULLTAG, 16), nullptr);
  EXPECT_EQ(mi_db_copy(miNULLTAG), miNULLTAG);
  EXPECT_EQ(mi_kdtree_create(0, 4), miNULLTAG);
  EXPECT_EQ(mi_kdtree_create(3, -4), miNULLTAG);
  EXPECT_EQ(mi_kdtree_edit(running.state().instance), nullptr);
  EXPECT_FALSE(mi_kdtree_add(nullptr, nullptr, nullptr));
  EXPECT_EQ(mi_kdtree_iterate(nullptr, nullptr, nullptr), 0);
  mi_kdtree_unpin(nullptr);
  mi_kdtree_delete(miNULLTAG);
  mi_db_delete(miNULLTAG);
}

TEST(ShaderElements, ThoseOfTheSceneCanBeCopiedButNotDeleted) {
  Running running;
  const miTag scene = running.state().instance;
  const miTag copy = mi_db_copy(scene);
  ASSERT_NE(copy, miNULLTAG);
  EXPECT_EQ(mi_db_type(copy), miSCENE_INSTANCE);
  auto* own = static_cast<miInstance*>(mi_db_access(copy));
  const auto* instance = static_cast<const miInstance*>(mi_db_access(scene));
  ASSERT_TRUE(own && instance && own != instance);
  EXPECT_EQ(std::memcmp(own, instance, sizeof(miInstance)), 0);
  mi_db_delete(copy);
  EXPECT_EQ(mi_db_access(copy), nullptr);
  const std::size_t before = running.diagnostics().all().size();
  mi_db_delete(scene);
  mi_db_delete(scene);
  EXPECT_EQ(mi_db_access(scene), instance);
  EXPECT_EQ(running.diagnostics().all().size(), before + 1) << "warns once";
}

}  // namespace shader_elements_test
}  // namespace oriel::sdk
