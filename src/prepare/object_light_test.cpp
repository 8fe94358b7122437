// SPDX-License-Identifier: Apache-2.0
// Area lights of kind `object`, against lights of the shapes that the objects have.
#include "prepare/object_light.h"
#include "lights/sample_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "prepare/testing/prepared_scene.h"

namespace oriel {
namespace object_light_test {

using testing::PreparedScene;
using testing::scene_text;

/// A light with that area statement beside an object "panel" that lies elsewhere.
PreparedScene scene_of(
    const std::string& area, const std::string& polygons,
    const std::string& transform = "transform 1 0 0 0 0 1 0 0 0 0 1 0 -3 -1 0 1") {
  return PreparedScene(
      scene_text("object \"panel_o\" visible on shadow on trace on group " + polygons +
                     " end group end object\n"
                     "instance \"panel\" \"panel_o\" " +
                     transform +
                     " end instance\n"
                     "light \"l\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 0 " +
                     area + " end light instance \"l_i\" \"l\" end instance\n",
                 "\"panel\" \"l_i\""));
}
/// Two units wide and one high in z = 0, front to +z, in two triangles and as one polygon.
const std::string kTriangles = "-1 0 0 1 0 0 1 1 0 -1 1 0 v 0 v 1 v 2 v 3 p 0 1 2 p 0 2 3";
const std::string kPolygon = "-1 0 0 1 0 0 1 1 0 -1 1 0 v 0 v 1 v 2 v 3 p 0 1 2 3";

Rgb mean_at(const Light& light, const World& world, const Vec3& at) {
  constexpr int kSide = 32;
  Rgb sum(0);
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      ShadingPoint point;
      point.world = &world;
      point.position = at;
      const Vec2 u((static_cast<float>(i) + .5f) / kSide, (static_cast<float>(j) + .5f) / kSide);
      if (const auto s = sample_light(light, point, u)) sum += s->irradiance;
    }
  return sum / (kSide * kSide);
}

TEST(ObjectLights, AParallelogramShinesAsARectangleThere) {
  // What the manual's own kind of that size gives at the same place.
  const PreparedScene rectangle(
      scene_text("light \"l\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 3 1.5 0 rectangle 2 0 "
                 "0 0 1 0 end "
                 "light instance \"l_i\" \"l\" end instance\n",
                 "\"l_i\""));
  const Light& same = rectangle.world->lights.at(0);
  for (const std::string& polygons : {kTriangles, kPolygon}) {
    const PreparedScene s = scene_of("object \"panel\" 4 4", polygons);
    EXPECT_EQ(s.only("OR-RN-021"), nullptr) << s.messages();
    const Light& light = s.world->lights.at(0);
    ASSERT_EQ(light.shape, LightShape::Rectangle);
    EXPECT_FLOAT_EQ(light.area, 2);
    for (const Vec3& at : {Vec3(3, 1.5f, 2), Vec3(5, 0, 1)}) {
      EXPECT_NEAR(mean_at(light, *s.world, at).x, mean_at(same, *rectangle.world, at).x, 2e-3f);
      EXPECT_GT(mean_at(light, *s.world, at).x, .1f);
    }
    EXPECT_EQ(mean_at(light, *s.world, Vec3(3, 1.5f, -2)), Rgb(0)) << "its back is dark";
  }
}

TEST(ObjectLights, OtherFlatObjectsKeepTheirAreaAndCentroid) {
  const PreparedScene s = scene_of("object \"panel\"", "0 0 0 3 0 0 0 3 0 v 0 v 1 v 2 p 0 1 2");
  const Light& light = s.world->lights.at(0);
  ASSERT_EQ(light.shape, LightShape::Disc);
  EXPECT_FLOAT_EQ(light.area, 4.5f);
  EXPECT_LT(length(light.position - Vec3(4, 2, 0)), 1e-5f) << "a third of the corners' sum";
}

TEST(ObjectLights, SolidsShineFromTheSphereAroundThem) {
  // A cube of side 2 about the origin, placed at (3, 1, 0) and scaled by 2: world to local halves.
  std::string cube;
  for (int i = 0; i < 8; ++i)
    cube += std::to_string(i & 1 ? 1 : -1) + " " + std::to_string(i & 2 ? 1 : -1) + " " +
            std::to_string(i & 4 ? 1 : -1) + " ";
  cube +=
      "v 0 v 1 v 2 v 3 v 4 v 5 v 6 v 7 p 0 2 3 1 p 4 5 7 6 p 0 1 5 4 p 2 6 7 3 p 0 4 6 2 p 1 3 7 5";
  const PreparedScene s =
      scene_of("object \"panel\" 2 2", cube, "transform .5 0 0 0 0 .5 0 0 0 0 .5 0 -1.5 -.5 0 1");
  const Light& light = s.world->lights.at(0);
  ASSERT_EQ(light.shape, LightShape::Sphere);
  EXPECT_NEAR(light.radius, 2 * std::sqrt(3.0f), 1e-4f);
  EXPECT_LT(length(light.position - Vec3(3, 1, 0)), 1e-4f);
}

TEST(ObjectLights, PolygonsOfMissingVerticesAreIgnored) {
  // Of four polygons the first is whole; the others name no vertex, no vector, no corners.
  scene::Object object;
  scene::PolygonGroup group;
  group.vectors = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(0, 1, 0)};
  group.vertices.point = {0, 1, 2, 3, 99};
  group.polygons.indices = {0, 1, 2, 3, 0, 1, 77, 0, 1, 4};
  group.polygons.first = {0, 4, 7, 10, 5000};
  object.groups.push_back(group);
  Light light;
  ASSERT_TRUE(place_on_object(object, Mat4(), light));
  EXPECT_EQ(light.shape, LightShape::Rectangle);
  EXPECT_FLOAT_EQ(light.area, 2);
}

TEST(ObjectLights, WithoutAnObjectTheLightIsAPointWithAWarning) {
  for (const char* area : {"object \"nowhere\" 2 2", "object \"l_i\" 2 2", "user 4"}) {
    const PreparedScene s = scene_of(area, kPolygon);
    EXPECT_EQ(s.world->lights.at(0).shape, LightShape::Point) << area;
    EXPECT_NE(s.only("OR-RN-021"), nullptr) << area << s.messages();
  }
}

}  // namespace object_light_test
}  // namespace oriel
