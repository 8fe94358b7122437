// SPDX-License-Identifier: Apache-2.0
#include "scene/hierarchy.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace oriel::scene {
namespace hierarchy_test {

Statement flag(std::string keyword) {
  Statement s;
  s.keyword = std::move(keyword);
  return s;
}

/// A scene built from short names.
struct Builder {
  Scene scene;
  Object& object(const std::string& name) {
    Object o;
    o.name = name;
    o.flags = {flag("visible"), flag("shadow"), flag("trace")};
    scene.add(std::move(o));
    return *scene.get<Object>(name);
  }
  Instance& instance(const std::string& name, const std::string& element) {
    Instance i;
    i.name = name;
    i.element = element;
    scene.add(std::move(i));
    return *scene.get<Instance>(name);
  }
  void group(const std::string& name, std::vector<std::string> members) {
    InstanceGroup g;
    g.name = name;
    g.members = std::move(members);
    scene.add(std::move(g));
  }
  template <class T>
  void element(const std::string& name) {
    T e;
    e.name = name;
    scene.add(std::move(e));
  }
};

Mat4 moved(float x, float y, float z) {
  Mat4 m;
  m[3][0] = x;
  m[3][1] = y;
  m[3][2] = z;
  return m;
}

Mat4 scaled(float s) {
  Mat4 m;
  m[0][0] = m[1][1] = m[2][2] = s;
  return m;
}

TEST(Hierarchy, LeavesAreInGroupOrder) {
  Builder b;
  b.object("o");
  b.element<Camera>("c");
  b.element<Light>("l");
  b.instance("i1", "c");
  b.instance("i2", "inner");
  b.instance("i3", "o");
  b.instance("i4", "l");
  b.group("inner", {"i3", "i4"});
  b.group("root", {"i2", "i1", "i3"});
  Diagnostics d;
  const auto leaves = flatten(b.scene, "root", d);
  ASSERT_EQ(leaves.size(), 4u);
  EXPECT_EQ(leaves[0].object(), b.scene.get<Object>("o"));
  EXPECT_EQ(leaves[0].chain.size(), 2u);
  EXPECT_EQ(leaves[0].chain[0]->name, "i2");
  EXPECT_EQ(leaves[0].instance().name, "i3");
  EXPECT_EQ(leaves[1].kind, LeafKind::Light);
  EXPECT_EQ(leaves[2].kind, LeafKind::Camera);
  EXPECT_EQ(leaves[3].chain.size(), 1u);
  EXPECT_TRUE(d.all().empty());
}

// acceptance: H1
TEST(Hierarchy, OuterMatrixAppliesFirst) {
  Builder b;
  b.object("o");
  b.instance("outer", "g").transform = moved(-10, 0, 0);
  b.instance("inner", "o").transform = scaled(0.5f);
  b.group("g", {"inner"});
  b.group("root", {"outer"});
  Diagnostics d;
  const auto leaves = flatten(b.scene, "root", d);
  ASSERT_EQ(leaves.size(), 1u);
  // The outer instance is at x = 10; two units from there are one unit of the object, scaled by
  // half.
  EXPECT_EQ(transform_point(Vec3(12, 0, 0), leaves[0].world_to_local), Vec3(1, 0, 0));
  EXPECT_EQ(transform_point(Vec3(1, 0, 0), leaves[0].local_to_world), Vec3(12, 0, 0));
  EXPECT_FALSE(leaves[0].motion_world_to_local.has_value());
}

TEST(Hierarchy, DoublesKeepInversesExactFarFromTheOrigin) {
  Builder b;
  b.object("o");
  b.instance("outer", "g").transform = moved(-1e6f, 0, 0);
  b.instance("inner", "o").transform = moved(1e6f, 0.25f, 0);
  b.group("g", {"inner"});
  b.group("root", {"outer"});
  Diagnostics d;
  const auto leaves = flatten(b.scene, "root", d);
  EXPECT_EQ(leaves[0].world_to_local, moved(0, 0.25f, 0));
  EXPECT_EQ(leaves[0].local_to_world, moved(0, -0.25f, 0));
}

TEST(Hierarchy, MotionTransformsComposeAndCanBeSwitchedOff) {
  Builder b;
  b.object("o");
  Instance& outer = b.instance("outer", "g");
  outer.transform = moved(1, 0, 0);
  outer.motion_transform = moved(3, 0, 0);
  b.instance("moving", "o").transform = moved(0, 1, 0);
  Statement motion = flag("motion");
  motion.values.emplace_back();
  motion.values[0].kind = Value::Kind::Boolean;
  b.instance("still", "o").flags = {motion};
  b.group("g", {"moving", "still"});
  b.group("root", {"outer"});
  Diagnostics d;
  const auto leaves = flatten(b.scene, "root", d);
  ASSERT_TRUE(leaves[0].motion_world_to_local.has_value());
  EXPECT_EQ(*leaves[0].motion_world_to_local, moved(3, 1, 0));
  EXPECT_EQ(leaves[0].world_to_local, moved(1, 1, 0));
  EXPECT_FALSE(leaves[1].motion_world_to_local.has_value());
}

TEST(Hierarchy, NearestMaterialAppliesUnlessOverridden) {
  Builder b;
  b.object("o");
  b.instance("outer", "g").materials = {"a"};
  b.instance("plain", "o");
  b.instance("own", "o").materials = {"b"};
  b.group("g", {"plain", "own"});
  b.group("root", {"outer"});
  Diagnostics d;
  auto leaves = flatten(b.scene, "root", d);
  EXPECT_EQ(leaves[0].material_source->name, "outer");
  EXPECT_EQ(leaves[1].material_source->name, "own");
  EXPECT_FALSE(leaves[1].material_override);
  b.scene.get<Instance>("outer")->flags = {flag("override")};
  leaves = flatten(b.scene, "root", d);
  EXPECT_EQ(leaves[1].material_source->name, "outer");
  EXPECT_TRUE(leaves[1].material_override);
}

TEST(Hierarchy, LightLinksComeFromTheNearestInstanceThatHasThem) {
  Builder b;
  b.object("o");
  b.instance("outer", "g").light_links = LightLinks{true, {"l1"}};
  b.instance("plain", "o");
  b.instance("own", "o").light_links = LightLinks{false, {}};
  b.group("g", {"plain", "own"});
  b.group("root", {"outer"});
  Diagnostics d;
  const auto leaves = flatten(b.scene, "root", d);
  ASSERT_NE(leaves[0].light_links, nullptr);
  EXPECT_TRUE(leaves[0].light_links->exclusive);
  EXPECT_FALSE(leaves[1].light_links->exclusive);
  EXPECT_EQ(leaves[1].shadow_links, nullptr);
}

TEST(Hierarchy, FlagsAreInheritedAndMissingFlagsNotedOnce) {
  Builder b;
  b.object("o").flags.clear();
  b.instance("i1", "o");
  b.instance("i2", "o");
  Instance& hidden = b.instance("outer", "g");
  hidden.flags = {flag("hide")};
  b.group("g", {"i1"});
  b.group("root", {"outer", "i2"});
  Diagnostics d;
  const auto leaves = flatten(b.scene, "root", d);
  EXPECT_TRUE(leaves[0].flags.hidden && leaves[0].flags.visible);
  EXPECT_FALSE(leaves[1].flags.hidden);
  ASSERT_EQ(d.all().size(), 1u);
  EXPECT_EQ(d.all()[0].code, "OR-SC-307");
  EXPECT_EQ(d.all()[0].message.substr(0, 2), "2 ");
}

TEST(Hierarchy, SingularTransformBecomesIdentityAndIsReportedOnce) {
  Builder b;
  b.object("o");
  Mat4 flat;
  flat[1][1] = 0;
  b.instance("i", "o").transform = flat;
  b.instance("twice", "g");
  b.group("g", {"i"});
  b.group("root", {"i", "twice"});
  Diagnostics d;
  const auto leaves = flatten(b.scene, "root", d);
  EXPECT_EQ(leaves[0].world_to_local, Mat4());
  EXPECT_EQ(leaves[1].local_to_world, Mat4());
  EXPECT_EQ(d.all().size(), 1u);
  EXPECT_TRUE(d.has("OR-SC-306"));
}

TEST(Hierarchy, ThinScaleIsNotSingular) {
  Builder b;
  b.object("o");
  Mat4 thin = scaled(1e-4f);
  thin[1][1] = 1e4f;
  b.instance("i", "o").transform = thin;
  b.group("root", {"i"});
  Diagnostics d;
  const auto leaves = flatten(b.scene, "root", d);
  EXPECT_FLOAT_EQ(leaves[0].local_to_world[1][1], 1e-4f);
  EXPECT_TRUE(d.all().empty());
}

TEST(Hierarchy, CyclicGroupIsReportedOnceAndTheRestRemains) {
  Builder b;
  b.object("o");
  b.instance("i", "o");
  b.instance("loop", "root");
  b.group("root", {"loop", "i", "loop"});
  Diagnostics d;
  EXPECT_EQ(flatten(b.scene, "root", d).size(), 1u);
  ASSERT_EQ(d.all().size(), 1u);
  EXPECT_EQ(d.all()[0].code, "OR-SC-304");
}

TEST(Hierarchy, MissingNamesAreReportedWithTheNearest) {
  Builder b;
  b.object("chair");
  b.instance("chair_inst", "chairr");
  b.instance("m", "mat");
  b.element<Material>("mat");
  b.group("root", {"chair_inst", "chair_ints", "chair", "m"});
  Diagnostics d;
  EXPECT_TRUE(flatten(b.scene, "root", d).empty());
  ASSERT_EQ(d.all().size(), 4u);
  EXPECT_EQ(d.all()[0].code, "OR-SC-302");
  EXPECT_EQ(d.all()[0].hint, "did you mean 'chair_inst'?");
  EXPECT_EQ(d.all()[1].code, "OR-SC-303");
  EXPECT_EQ(d.all()[2].hint, "did you mean 'chair'?");
  EXPECT_EQ(d.all()[3].code, "OR-SC-303");
  EXPECT_TRUE(flatten(b.scene, "rot", d).empty());
  EXPECT_TRUE(d.has("OR-SC-301"));
}

TEST(Hierarchy, FanOutIsBounded) {
  Builder b;
  b.object("o");
  b.instance("leaf", "o");
  b.group("g0", {"leaf"});
  b.group("empty0", {});
  for (int level = 1; level <= 40; ++level) {
    const auto build = [&](const std::string& kind) {
      const std::string below = fmt::format("{}{}", kind, level - 1),
                        name = fmt::format("{}{}", kind, level);
      b.instance(name + "a", below);
      b.instance(name + "b", below);
      b.group(name, {name + "a", name + "b"});
    };
    build("g");
    build("empty");
  }
  Diagnostics d;
  EXPECT_EQ(flatten(b.scene, "g40", d, {.leaves = 1000}).size(), 1000u);
  EXPECT_TRUE(d.has("OR-SC-305"));
  Diagnostics of_empty;
  EXPECT_TRUE(flatten(b.scene, "empty40", of_empty, {.visits = 10'000}).empty());
  EXPECT_EQ(of_empty.all().size(), 1u);
  Diagnostics of_deep;
  EXPECT_TRUE(flatten(b.scene, "g40", of_deep, {.depth = 20}).empty());
  EXPECT_TRUE(of_deep.has("OR-SC-305"));
}

TEST(Hierarchy, AHundredThousandInstancesAreFlattenedWithoutQuadraticWork) {
  Builder b;
  b.object("o");
  std::vector<std::string> names;
  for (int i = 0; i < 100'000; ++i) {
    names.push_back(fmt::format("i{}", i));
    b.instance(names.back(), "o").transform = moved(static_cast<float>(i), 0, 0);
  }
  b.group("root", names);
  Diagnostics d;
  const auto leaves = flatten(b.scene, "root", d);
  ASSERT_EQ(leaves.size(), 100'000u);
  EXPECT_EQ(leaves[99'999].world_to_local[3][0], 99'999);
}

}  // namespace hierarchy_test
}  // namespace oriel::scene
