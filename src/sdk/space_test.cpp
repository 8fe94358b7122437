// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "oriel/sdk/shader/space.h"
#include "sdk/testing/bare_state.h"
#include "support/expect_near.h"

namespace oriel::sdk {
namespace space_test {

using testing::BareState;
using testing::expect_near;

using Move = void (*)(const miState*, miVector*, const miVector*);
struct Space {
  const char* name;
  Move point_to, point_from, vector_to, vector_from, normal_to, normal_from;
};
#define SPACE(s)                                                                  \
  {                                                                               \
#s, mi_point_to_##s, mi_point_from_##s, mi_vector_to_##s, mi_vector_from_##s, \
        mi_normal_to_##s, mi_normal_from_##s                                      \
  }
const Space kSpaces[] = {SPACE(world), SPACE(camera), SPACE(object), SPACE(light)};
#undef SPACE

TEST(Spaces, TransformsAreInverses) {
  BareState bare;
  for (const Space& s : kSpaces) {
    SCOPED_TRACE(s.name);
    const miVector p = {3, -1, 2};
    for (const auto& [to, from] :
         {std::pair(s.point_to, s.point_from), std::pair(s.vector_to, s.vector_from),
          std::pair(s.normal_to, s.normal_from)}) {
      miVector r;
      to(&bare.state(), &r, &p);
      from(&bare.state(), &r, &r);
      expect_near(r, p);
    }
  }
}

TEST(Spaces, KeepNormalsSquareToSurfaces) {
  BareState bare;
  const miVector tangent = {1, 2, -1}, normal = {1, 0, 1};
  for (const Space& s : kSpaces) {
    miVector t, n;
    s.vector_to(&bare.state(), &t, &tangent);
    s.normal_to(&bare.state(), &n, &normal);
    EXPECT_NEAR(mi_vector_dot(&t, &n), 0, 1e-5f) << s.name;
  }
}

TEST(Spaces, AreThoseOfTheScenesTransforms) {
  // Transforms of a scene map from the world to the instance: the last row is the image of the
  // origin.
  BareState bare;
  const miVector origin = {0, 0, 0};
  miVector r;
  mi_point_to_object(&bare.state(), &r, &origin);
  expect_near(r, {1, 2, 3});
  mi_point_to_light(&bare.state(), &r, &origin);
  expect_near(r, {-3, 2, 1});
  mi_point_to_camera(&bare.state(), &r, &origin);
  expect_near(r, {-1, -2, -5});
  mi_point_to_world(&bare.state(), &r, &origin);
  expect_near(r, origin);
  mi_vector_to_object(&bare.state(), &r, &origin);
  expect_near(r, origin);
}

TEST(Spaces, RasterIsThePixelOfTheEyeRay) {
  BareState bare;
  for (const Vec2& raster : {Vec2(.5f, .5f), Vec2(8, 6), Vec2(15.25f, 2.5f)}) {
    const Camera::Ray ray = bare.world().camera.ray(raster);
    const miVector p = as_c(ray.origin + ray.direction * 7);
    miVector r;
    mi_point_to_raster(&bare.state(), &r, &p);
    EXPECT_NEAR(r.x, raster.x, 1e-4f);
    EXPECT_NEAR(r.y, raster.y, 1e-4f);
  }
}

TEST(Spaces, RasterUnitIsOnePixelOnTheScreen) {
  BareState bare;
  const Camera::Ray ray = bare.world().camera.ray(Vec2(4, 9));
  bare.state().point = as_c(ray.origin + ray.direction * 7);
  miVector x, y, at;
  ASSERT_TRUE(mi_raster_unit(&bare.state(), &x, &y));
  for (const bool along_y : {false, true}) {
    mi_vector_from_object(&bare.state(), &at, along_y ? &y : &x);
    mi_vector_add(&at, &at, &bare.state().point);
    mi_point_to_raster(&bare.state(), &at, &at);
    EXPECT_NEAR(at.x, along_y ? 4 : 5, 1e-3f);
    EXPECT_NEAR(at.y, along_y ? 10 : 9, 1e-3f);
  }
  bare.state().point = as_c(ray.origin - ray.direction);
  EXPECT_FALSE(mi_raster_unit(&bare.state(), &x, &y)) << "behind the camera";
}

}  // namespace space_test
}  // namespace oriel::sdk
