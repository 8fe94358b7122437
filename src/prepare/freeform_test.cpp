// SPDX-License-Identifier: Apache-2.0
// Free-form surfaces from text to what a camera sees.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "geom/accel.h"
#include "prepare/testing/prepared_scene.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"

namespace oriel {
namespace freeform_test {

/// A sphere of rational splines about `centre`, as text; `statements` end its group.
std::string sphere(Vec3 centre, float radius, std::string_view statements) {
  constexpr float kX[8] = {1, 1, 0, -1, -1, -1, 0, 1}, kY[8] = {0, 1, 1, 1, 0, -1, -1, -1};
  std::string vectors, vertices, points;
  for (int j = 6; j <= 10; ++j)
    for (int i = 0; i <= 8; ++i) {
      const float r = radius * kX[j % 8];
      const float w = (i % 2 ? std::sqrt(.5f) : 1) * (j % 2 ? std::sqrt(.5f) : 1);
      vectors += fmt::format("{} {} {}\n", centre.x + r * kX[i % 8], centre.y + r * kY[i % 8],
                             centre.z + radius * kY[j % 8]);
      vertices += fmt::format("v {}\n", (j - 6) * 9 + i);
      points += fmt::format(" {} w {}", (j - 6) * 9 + i, w);
    }
  return fmt::format(
      "object \"o\" visible trace shadow basis \"b\" rational bspline 2 group {}{}"
      "surface \"s\" \"\" \"b\" 0. 4. 0. 0. 0. 1. 1. 2. 2. 3. 3. 4. 4. 4.\n"
      "\"b\" 0. 2. 0. 0. 0. 1. 1. 2. 2. 2.{} {} end group end object\n",
      vectors, vertices, points, statements);
}

std::string picture(const std::string& objects, int width) {
  return fmt::format(
      "options \"opt\" end options camera \"c\" focal 1 aperture 1 aspect 1 resolution {0} {0} end "
      "camera instance \"ci\" \"c\" end instance\n{1}instance \"oi\" \"o\" end instance\n"
      "instgroup \"root\" \"ci\" \"oi\" end instgroup render \"root\" \"ci\" \"opt\"\n",
      width, objects);
}

// acceptance: H1
TEST(FreeFormPicture, ASphereCoversThePixelsOfASphere) {
  constexpr int kWidth = 200;
  const Vec3 centre(.2f, -.1f, -5);
  const float radius = 1.5f;
  const testing::PreparedScene scene(
      picture(sphere(centre, radius, "approximate surface view distance .1 0 8 \"s\""), kWidth));
  ASSERT_TRUE(scene.world) << scene.messages();
  const World& world = *scene.world;
  int inside = 0, unsure = 0;
  for (int y = 0; y < kWidth; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Camera::Ray r = world.camera.ray({float(x) + .5f, float(y) + .5f});
      geom::Ray ray;
      ray.org = r.origin;
      ray.dir = r.direction;
      geom::Hit hit;
      const bool met = world.accel->intersect(ray, hit);
      const float miss = length(cross(centre - r.origin, r.direction)) / radius;
      // A tenth of a pixel's diagonal on this sphere, relative to its radius.
      const float slack = .1f * 1.42f * 5 / kWidth / radius;
      if (std::abs(miss - 1) <= slack) {
        ++unsure;
        continue;
      }
      EXPECT_EQ(met, miss < 1) << x << " " << y;
      if (!met) continue;
      ++inside;
      geom::SurfacePoint point;
      world.accel->interpolate(hit, point);
      EXPECT_NEAR(length(point.p - centre), radius, .01f);
      EXPECT_GT(dot(point.ns, normalize(point.p - centre)), .9999f);
    }
  // The cone around a sphere off the axis cuts an ellipse of about pi tan^2 from the image plane.
  EXPECT_GT(inside, 11000);
  EXPECT_LT(unsure, 200);
}

// Two patches with one border and one approximation. Rays go wherever pictures send them; those
// that aim at an edge to the last bit, as none drawn by chance does, are accel_test's matter.
TEST(FreeFormPicture, NoRayPassesBetweenTwoPatches) {
  std::string halves = sphere({0, 0, 0}, 1, "approximate surface distance .02 0 6");
  const std::size_t begin = halves.find("surface \"s\""), end = halves.find("approximate surface");
  std::string other = halves.substr(begin, end - begin);
  other.replace(other.find("\"s\""), 3, "\"t\"");
  other.replace(other.find("0. 4."), 5, "1.7 4.");
  halves.replace(halves.find("0. 4.", begin), 5, "0. 1.7");
  halves.insert(halves.find("approximate surface"), other);
  const testing::PreparedScene scene(picture(halves, 20));
  ASSERT_TRUE(scene.world) << scene.messages();
  constexpr int kRays = 100'000;
  // Of u = 1.7: the second arc of the circle, a quarter from (0, 1) to (-1, 0), at .7 of it.
  constexpr float kSeam = 2.684582f, kMeridian = 0;
  int missed = 0;
  for (int i = 0; i < kRays; ++i) {
    sampling::Sampler sampler(i, 7, 0);
    geom::Ray ray;
    ray.dir = sampling::sample_uniform_sphere(sampler.next_2d());
    if (i % 2 == 0) {  // within a pixel of a border
      const float angle = (i % 4 == 0 ? kSeam : kMeridian) + 1e-3f * (sampler.next_1d() - .5f);
      const float z = ray.dir.z, r = std::sqrt(1 - z * z);
      ray.dir = Vec3(r * std::cos(angle), r * std::sin(angle), z);
    }
    geom::Hit hit;
    missed += !scene.world->accel->intersect(ray, hit);
  }
  EXPECT_EQ(missed, 0);
}

TEST(FreeFormPicture, PixelsDecideHowFineASurfaceIs) {
  const auto triangles = [](float away, int width) {
    return testing::PreparedScene(
               picture(sphere({0, 0, -away}, 1, "approximate surface view length 4. 0 9"), width))
        .report.triangles;
  };
  EXPECT_GT(triangles(4, 200), 2 * triangles(8, 200));
  EXPECT_GT(triangles(4, 400), 2 * triangles(4, 200));
}

TEST(FreeFormPicture, InstancesMayHaveTheirOwnApproximation) {
  const std::string text = picture(sphere({0, 0, -4}, 1, ""), 20);
  std::string finer = text;
  finer.replace(finer.find("\"oi\" \"o\""), 8,
                "\"oi\" \"o\" approximate surface regular parametric 100. 50.");
  const auto plain = testing::PreparedScene(text).report.triangles;
  // Default: four pieces for each degree and span; the ends are poles of one triangle a piece.
  EXPECT_EQ(plain, 2u * 32 * 16 - 2 * 32);
  EXPECT_EQ(testing::PreparedScene(finer).report.triangles, 2u * 100 * 50 - 2 * 100);
}

}  // namespace freeform_test
}  // namespace oriel
