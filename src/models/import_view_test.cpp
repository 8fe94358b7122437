// SPDX-License-Identifier: Apache-2.0
// FBX cameras and lights, and the transforms of their nodes.
#include "models/import_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/testing/fbx_file.h"
#include "models/testing/model_file.h"
#include "support/expect_near.h"

namespace oriel::models {
namespace import_view_test {

using oriel::testing::expect_near;
using testing::FbxFile;
using testing::imported;
using testing::property;

/// World direction of the light with this element and instance.
Vec3 shining(const scene::Scene& scene) {
  const auto* sun = scene.get<scene::Light>("sun");
  EXPECT_TRUE(sun && sun->direction);
  return sun && sun->direction
             ? transform_vector(*sun->direction, testing::to_world(scene, "sun_inst"))
             : Vec3(0);
}

// An FBX camera looks along its x axis, a light along its -y axis; the transform is T R Rpost^-1.
// Rpost = Ry(-90): its inverse rotates x to -z; Rx(-90): its inverse rotates -y to -z.
TEST(ModelFbx, PostRotationIsInverted) {
  FbxFile file;
  file.camera = property("PostRotation", {0, -90, 0}) + property("Lcl Translation", {0, 0, 900});
  file.sun = property("PostRotation", {-90, 0, 0});
  const scene::Scene scene = imported("m.fbx", file.text());
  expect_near(testing::view_of(scene, "eye_inst"), Vec3(0, 0, -1));
  expect_near(transform_vector(Vec3(0, 1, 0), testing::to_world(scene, "eye_inst")), Vec3(0, 1, 0));
  expect_near(testing::to_world(scene, "eye_inst").translation(), Vec3(0, 0, 9));
  expect_near(shining(scene), Vec3(0, 0, -1));
}

TEST(ModelFbx, PostRotationComesBeforeRotation) {
  FbxFile file;
  // Ry(90) rotates -z to -x; Rx(-90) rotates -z to -y, which PreRotation rotates to x.
  file.camera = property("PostRotation", {0, -90, 0}) + property("Lcl Rotation", {0, 90, 0});
  file.sun = property("PostRotation", {-90, 0, 0}) + property("Lcl Rotation", {-90, 0, 0}) +
             property("PreRotation", {0, 0, 90});
  const scene::Scene scene = imported("m.fbx", file.text());
  expect_near(testing::view_of(scene, "eye_inst"), Vec3(-1, 0, 0));
  expect_near(shining(scene), Vec3(1, 0, 0));
}

TEST(ModelFbx, NodesWithoutPostRotationUseTheirRotation) {
  FbxFile file;
  // As Blender writes cameras: the complete rotation is in Lcl Rotation.
  file.camera = property("Lcl Rotation", {0, 90, 0});
  file.sun = property("Lcl Rotation", {0, 0, 90});
  const scene::Scene scene = imported("m.fbx", file.text());
  expect_near(testing::view_of(scene, "eye_inst"), Vec3(0, 0, -1));
  expect_near(shining(scene), Vec3(1, 0, 0));
}

// T Rp R Rp^-1: a rotation by 180 degrees about z through (100, 0, 0) maps the origin to (200, 0,
// 0).
TEST(ModelFbx, PivotsAreAppliedWithoutHelperNodes) {
  FbxFile file;
  file.triangle = property("RotationPivot", {100, 0, 0}) + property("Lcl Rotation", {0, 0, 180}) +
                  property("ScalingPivot", {0, 100, 0}) + property("Lcl Scaling", {1, 3, 1});
  const scene::Scene scene = imported("m.fbx", file.text());
  const Mat4 m = testing::to_world(scene, "chair_inst");
  // Scaled about y = 1 first: (0, 0) to (0, -2).
  expect_near(transform_point(Vec3(0), m), Vec3(2, 2, 0));
  expect_near(transform_point(Vec3(1, 1, 0), m), Vec3(1, -1, 0));
  for (const scene::Element& e : scene.elements())
    EXPECT_EQ(scene::name_of(e).find("Assimp"), std::string::npos) << scene::name_of(e);
}

// A geometric transform applies to the geometry of the node, not to its children.
TEST(ModelFbx, GeometricTransformsStayWithTheirNode) {
  FbxFile file;
  file.triangle = property("GeometricTranslation", {0, 0, 700});
  file.more = "Model: 51, \"Model::child\", \"Mesh\" {\nVersion: 232\nProperties70:  {\n}\n}\n";
  file.links = "C: \"OO\",51,11\nC: \"OO\",10,51\n";
  const scene::Scene scene = imported("m.fbx", file.text());
  expect_near(testing::to_world(scene, "chair_inst").translation(), Vec3(0, 0, 7));
  expect_near(testing::to_world(scene, "child_inst").translation(), Vec3(0, 0, 0));
}

TEST(ModelFbx, SpotAnglesAreFullAngles) {
  FbxFile file;
  file.sun = property("Lcl Translation", {0, 400, 0});
  file.light =
      "P: \"LightType\", \"enum\", \"\", \"\",2\nP: \"InnerAngle\", \"Number\", \"\", \"A\",40\n"
      "P: \"OuterAngle\", \"Number\", \"\", \"A\",60\n";
  const scene::Scene scene = imported("m.fbx", file.text());
  const auto* spot = scene.get<scene::Light>("sun");
  ASSERT_TRUE(spot && spot->spread);
  EXPECT_NEAR(*spot->spread, std::cos(30 * kPi / 180), 1e-6f);
  EXPECT_NEAR(spot->shaders[0].arguments.at(1).value.numbers.at(0), std::cos(20 * kPi / 180), 1e-6);
}

TEST(ModelFbx, TargetsOrientNodes) {
  FbxFile file;
  file.camera = property("Lcl Translation", {100, 200, 500});
  file.sun = property("Lcl Translation", {0, 400, 0});
  for (const char* name : {"eye", "sun"}) {
    const int id = name[0] == 'e' ? 61 : 62;
    file.more += fmt::format(
        "Model: {}, \"Model::{}.Target\", \"Null\" {{\nVersion: 232\nProperties70:  {{\n{}}}\n}}\n",
        id, name, property("Lcl Translation", {100, 200, id == 61 ? 0.0 : 300.0}));
    file.links += fmt::format("C: \"OO\",{},0\n", id);
  }
  const scene::Scene scene = imported("m.fbx", file.text());
  expect_near(testing::view_of(scene, "eye_inst"), Vec3(0, 0, -1));
  expect_near(testing::to_world(scene, "eye_inst").translation(), Vec3(1, 2, 5));
  expect_near(shining(scene), normalize(Vec3(1, -2, 3)));
}

}  // namespace import_view_test
}  // namespace oriel::models
