// SPDX-License-Identifier: Apache-2.0
// Effects of the final gathering options, compared with expected values.
#include "base/parallel.h"
#include "support/picture.h"

namespace oriel::testing {
namespace gather_options_test {

/// A grey floor at z = -2 between two white walls under a sky of radiance 1. All that is seen is
/// gathered.
std::string court(const std::string& options, const std::string& method) {
  SceneText s("trace depth 4 4 8 finalgather on " + options);
  s.uniform_sky(1)
      .lambert("floor", .5f)
      .lambert("wall", .8f)
      .polygon("floor", {Vec3(-1, -1, -2), Vec3(1, -1, -2), Vec3(1, 1, -2), Vec3(-1, 1, -2)})
      .polygon("wall", {Vec3(-1, -1, -2), Vec3(-1, 1, -2), Vec3(-1, 1, -1), Vec3(-1, -1, -1)})
      .polygon("wall", {Vec3(1, -1, -2), Vec3(1, -1, -1), Vec3(1, 1, -1), Vec3(1, 1, -2)})
      .camera("focal 1 aperture 1 aspect 1 resolution 24 24");
  return s.method(method).str();
}

struct Gathered {
  Rgb mean;
  std::size_t points;
  RayCounts rays;
};

Gathered gathered(const std::string& options, const std::string& method = "scene") {
  RenderedScene scene(court(options, method), {.budget = {.samples = 4}, .outputs = true});
  return {scene.mean(), scene.session().integrator().gather_points(), scene.session().rays()};
}

// acceptance: H2
TEST(GatherOptions, EachFurtherBounceComesNearerToThePaths) {
  const float paths = gathered("", "path").mean.x;
  float before = 0, gap_before = paths;
  for (const int d : {0, 1, 2, 6}) {
    const float m = gathered(fmt::format("finalgather trace depth 2 2 {} 8", d)).mean.x;
    EXPECT_GT(m, before) << d;
    EXPECT_LT(paths - m, .7f * gap_before) << d;
    before = m, gap_before = paths - m;
  }
  EXPECT_NEAR(before / paths, 1, .02);
  EXPECT_NEAR(gathered("", "fg").mean.x / paths, 1, .02) << "by name: bounces without limit";
  EXPECT_EQ(gathered("").mean, gathered("finalgather trace depth 1 1 0 2").mean) << "the default";
}

// acceptance: H2
TEST(GatherOptions, ScaleActsOnAllAndSecondaryScaleOnFurtherBounces) {
  const std::string one = "finalgather trace depth 2 2 1 4 ";
  const Rgb plain = gathered(one).mean;
  const Rgb scaled = gathered(one + "finalgather scale 1 .5 0 ").mean;
  EXPECT_NEAR(scaled.x, plain.x, 1e-5f);
  EXPECT_NEAR(scaled.y, .5f * plain.y, 1e-3f * plain.y);
  EXPECT_NEAR(scaled.z, 0, 1e-6f);
  const Rgb none = gathered("finalgather trace depth 2 2 0 4 ").mean;
  const Rgb half = gathered(one + "finalgather secondary scale 1 .5 0 ").mean;
  EXPECT_NEAR(half.x, plain.x, .01f * plain.x);
  EXPECT_NEAR(half.y, .5f * (plain.y + none.y), .01f * plain.y);
  EXPECT_NEAR(half.z, none.z, .01f * plain.z);
}

// acceptance: H2
TEST(GatherOptions, RaysBeyondTheFalloffSeeTheSky) {
  // Behind .01 there is nothing but the sky: the floor shows albedo times its radiance.
  EXPECT_NEAR(gathered("finalgather falloff .001 .01").mean.x, .5f, .01f);
  const float all = gathered("").mean.x, near = gathered("finalgather falloff 1 2").mean.x,
              nearer = gathered("finalgather falloff .3 .6").mean.x;
  EXPECT_LT(all, near);
  EXPECT_LT(near, nearer);
  EXPECT_NEAR(gathered("finalgather falloff 50 60").mean.x, all, 1e-3f);
}

// acceptance: H2
TEST(GatherOptions, RaysDensityAndRadiiSetThePointCount) {
  const auto usual = gathered("finalgather accuracy 100");
  EXPECT_GT(gathered("finalgather accuracy 400").rays.gather, 2 * usual.rays.gather);
  EXPECT_EQ(gathered("\"finalgather rays\" 400").rays.gather,
            gathered("finalgather accuracy 400").rays.gather);
  EXPECT_GT(gathered("finalgather accuracy 100 finalgather presample density 4").points,
            usual.points);
  EXPECT_LT(gathered("finalgather accuracy 100 finalgather presample density .1").points,
            usual.points);
  const auto points = [](const char* radii) {
    return gathered(std::string("finalgather accuracy ") + radii).points;
  };
  EXPECT_GT(points("100 .1 .01"), points("100 1 .01"));
  EXPECT_GT(points("100 1 .01"), points("100 1 1"));
  EXPECT_GT(points("view 100 3 .3"), points("view 100 24 3")) << "in pixels";
  EXPECT_LT(points("view 100 24 3"), 2 * points("100 2 .25")) << "a pixel is a twelfth wide";
  EXPECT_GT(2 * points("view 100 24 3"), points("100 2 .25"));
}

// acceptance: H2
TEST(GatherOptions, EveryModeBringsTheLightAndStrictnessShows) {
  const float usual = gathered("").mean.x;
  for (const char* mode : {"automatic", "3.4", "strict 3.4"})
    EXPECT_NEAR(gathered(fmt::format("\"finalgather mode\" \"{}\"", mode)).mean.x / usual, 1, .02)
        << mode;
  // Beyond the radius of the nearest point multiframe fades to black.
  const std::string multiframe = "\"finalgather mode\" \"multiframe\" finalgather accuracy 100 ";
  EXPECT_NEAR(gathered(multiframe + "4 .1").mean.x / usual, 1, .05);
  EXPECT_LT(gathered(multiframe + ".06 .05 finalgather presample density .02").mean.x, .8f * usual);
  for (const int points : {1, 10, 50})
    EXPECT_NEAR(gathered(fmt::format("\"finalgather points\" {}", points)).mean.x / usual, 1, .02)
        << points;
}

// acceptance: H2
TEST(GatherOptions, FilterRemovesSpecklesAndTheirEnergy) {
  // A small glowing thing is a lone bright ray to most points.
  const auto mean = [](int filter) {
    SceneText s(
        fmt::format("finalgather on finalgather accuracy 60 finalgather filter {}", filter));
    s.uniform_sky(.1f)
        .lambert("floor", .5f)
        .emitter("lamp", 40)
        .square("floor", Vec3(0, 0, -2), 1, Vec3(0, 0, 1))
        .square("lamp", Vec3(0, 0, -.5f), .08f, Vec3(0, 0, -1))
        .camera("focal 1 aperture 1 aspect 1 resolution 24 24", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 -1 1");
    return RenderedScene(s.method("scene"), {.budget = {.samples = 4}}).at(12, 4).r;
  };
  const float plain = mean(0), one = mean(1), four = mean(4);
  EXPECT_LT(one, .9f * plain);
  EXPECT_LE(four, 1.01f * one);
  EXPECT_NEAR(four, .05f, .01f) << "what is left is the sky";
}

// acceptance: H2
TEST(GatherOptions, PassesAreTheSameForAnyNumberOfThreads) {
  const auto with = [](int threads) {
    const ThreadLimit limit(threads);
    return gathered("finalgather trace depth 2 2 3 8 finalgather accuracy 50").mean;
  };
  EXPECT_EQ(with(1), with(2));
}

}  // namespace gather_options_test
}  // namespace oriel::testing
