// SPDX-License-Identifier: Apache-2.0
#include "lights/light_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "base/frame.h"

namespace oriel {
namespace light_tree_test {

std::vector<LightBounds> random_lights(int n, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> u(0, 1);
  std::vector<LightBounds> lights;
  for (int i = 0; i < n; ++i) {
    LightBounds b;
    const Vec3 centre(10 * u(engine), 10 * u(engine), 3 * u(engine));
    const Vec3 half(i % 3 == 0 ? 0.0f : 0.2f * u(engine));
    b.box = {centre - half, centre + half};
    if (i % 2) {
      b.normals = {normalize(Vec3(u(engine) - .5f, u(engine) - .5f, u(engine) - .5f)), 1};
      b.cos_reach = i % 4 == 1 ? 0 : .7f;
    }
    b.falling = u(engine);
    b.even = i % 5 == 0 ? u(engine) : 0;
    lights.push_back(b);
  }
  return lights;
}

std::vector<int> numbered(int n) {
  std::vector<int> names(static_cast<std::size_t>(n));
  std::iota(names.begin(), names.end(), 0);
  return names;
}

const LitPoint kPoints[] = {{Vec3(5, 5, 0), Vec3(0, 0, 1)},
                            {Vec3(0, 0, 1), Vec3(0)},
                            {Vec3(20, 3, 1), Vec3(-1, 0, 0)},
                            {Vec3(5, 5, 1.5f), Vec3(0, .6f, .8f)}};

TEST(LightTree, ChancesOfLightsThatShineAllAroundSumToOne) {
  for (const int n : {1, 2, 7, 100, 1000}) {
    std::vector<LightBounds> lights = random_lights(n, 3);
    for (LightBounds& light : lights) light.normals = {};
    const LightTree tree(lights, numbered(n));
    for (const LitPoint& point : kPoints) {
      double sum = 0;
      for (int i = 0; i < n; ++i)
        sum += static_cast<double>(tree.probability({point.position, Vec3(0)}, i));
      EXPECT_NEAR(sum, 1, 1e-4) << n;
    }
  }
}

TEST(LightTree, SampleFrequenciesMatchThePmf) {
  const int n = 50, draws = 200000;
  const LightTree tree(random_lights(n, 4), numbered(n));
  for (const LitPoint& point : kPoints) {
    std::vector<int> count(n);
    for (int k = 0; k < draws; ++k) {
      float u = (static_cast<float>(k) + .5f) / draws;
      const auto choice = tree.choose(point, u);
      if (!choice) continue;  // a group of lights none of which shines there
      EXPECT_FLOAT_EQ(choice->probability, tree.probability(point, choice->light));
      EXPECT_GE(u, 0);
      EXPECT_LT(u, 1);
      ++count[static_cast<std::size_t>(choice->light)];
    }
    // Numbers at equal distances: every count is right but for the ends of its interval.
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(count[static_cast<std::size_t>(i)],
                  static_cast<float>(draws) * tree.probability(point, i), 6);
  }
}

TEST(LightTree, LightsThatReachThePointHavePositiveProbability) {
  const int n = 200;
  const std::vector<LightBounds> lights = random_lights(n, 5);
  const LightTree tree(lights, numbered(n));
  for (const LitPoint& point : kPoints)
    for (int i = 0; i < n; ++i) {
      const LightBounds& light = lights[static_cast<std::size_t>(i)];
      bool shines = false;
      for (int corner = 0; corner < 8; ++corner) {
        Vec3 place;
        for (int k = 0; k < 3; ++k)
          place[k] = corner >> k & 1 ? light.box.max[k] : light.box.min[k];
        const Vec3 way = point.position - place;
        const bool out = light.normals.all() ||
                         dot(normalize(way), light.normals.axis) > light.cos_reach + 1e-4f;
        const bool front = point.normal == Vec3(0) || dot(way, point.normal) < -1e-4f;
        shines |= out && front;
      }
      if (shines) {
        EXPECT_GT(tree.probability(point, i), 0) << i;
      }
    }
}

TEST(LightTree, NearLightsAreChosenByTheirShareOfLight) {
  // Four alike at distances 1, 2, 3, 4 above a floor: shares go with the irradiance.
  std::vector<LightBounds> lights(4);
  double total = 0;
  for (int i = 0; i < 4; ++i) {
    auto& light = lights[static_cast<std::size_t>(i)];
    light.box = geom::Box3(Vec3(0, 0, static_cast<float>(i + 1)));
    light.falling = 1;
    total += 1.0 / ((i + 1) * (i + 1));
  }
  const LightTree tree(lights, numbered(4));
  const LitPoint point{Vec3(0), Vec3(0, 0, 1)};
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(
        static_cast<double>(tree.probability(point, i)) / (1.0 / ((i + 1) * (i + 1)) / total), 1,
        .35)
        << i;
}

TEST(LightTree, ManyLightsInOnePlaceAreSplitEvenly) {
  std::vector<LightBounds> lights(300);
  for (LightBounds& light : lights) light.box = geom::Box3(Vec3(0)), light.falling = 1;
  const LightTree tree(lights, numbered(300));
  for (int i = 0; i < 300; ++i)
    EXPECT_NEAR(tree.probability({Vec3(1, 2, 3), Vec3(0)}, i), 1 / 300.0f, 1e-3f / 300);
}

TEST(LightTree, PartsHoldEachLightOnce) {
  const int n = 400;
  const LightTree tree(random_lights(n, 9), numbered(n));
  for (const std::size_t most : {std::size_t{1}, std::size_t{20}, std::size_t{1000}}) {
    const std::vector<LightTree::Part> parts = tree.parts(most);
    EXPECT_LE(parts.size(), most);
    EXPECT_GE(parts.size(), std::min<std::size_t>(n, most > 8 ? most - 7 : 1));
    std::vector<int> found(n);
    for (const LightTree::Part part : parts) {
      tree.for_each_light(part, [&](int light) {
        ++found[static_cast<std::size_t>(light)];
        for (const LitPoint& point : kPoints) {
          const float whole = tree.probability(point, light),
                      by_parts = tree.probability_of(point, part, LightTree::kWhole) *
                                 tree.probability_of(point, ~light, part);
          EXPECT_NEAR(whole, by_parts, 1e-5f * whole);
        }
      });
    }
    EXPECT_EQ(std::count(found.begin(), found.end(), 1), n);
  }
}

TEST(LightTree, FlatLightsAreWeighedBySideAndCosine) {
  // Two triangles in one plane and a third beside it, which shines to its back by a quarter.
  std::vector<LightBounds> lights(3);
  for (int i = 0; i < 3; ++i) {
    auto& light = lights[static_cast<std::size_t>(i)];
    const Vec3 centre(static_cast<float>(i), 0, 0);
    light.box = {centre - Vec3(.01f, .01f, 0), centre + Vec3(.01f, .01f, 0)};
    light.normals = {Vec3(0, 0, i < 2 ? 1 : -1), 1};
    light.cos_reach = 0;
    light.thickness = 0;
    light.falling = 1;
  }
  lights[2].behind = .25f;
  const LightTree tree(lights, numbered(3));
  const Vec3 above(.4f, .3f, 2);
  double total = 0;
  std::vector<double> share;
  for (int i = 0; i < 3; ++i) {
    const Vec3 to = above - lights[static_cast<std::size_t>(i)].box.center();
    share.push_back((i < 2 ? 1 : .25) * double(to.z) / std::pow(double(length(to)), 3));
    total += share.back();
  }
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(double(tree.probability({above, Vec3(0)}, i)), share[std::size_t(i)] / total, 1e-3);
  // Close to the plane, and on the other side of it.
  const LitPoint below{Vec3(.5f, 0, -1e-3f), Vec3(0)};
  EXPECT_EQ(tree.probability(below, 0), 0);
  EXPECT_EQ(tree.probability(below, 2), 1);
}

TEST(LightTree, ClosedLampsAreSampledByTheirSeenSides) {
  // Noise of one sample of a sphere of triangles, each with its exact irradiance and never hidden
  // but by its own back. Without the mean cosine of a node's cone it is .6, without cones 1.3.
  std::vector<LightBounds> lights;
  std::vector<Vec3> centres, normals;
  constexpr int kRings = 24;
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < 2 * kRings; ++j) {
      const float theta = kPi * (float(i) + .5f) / kRings, phi = kPi * float(j) / kRings;
      const Vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                   std::cos(theta));
      LightBounds light;
      light.box = {n * .1f - Vec3(1e-3f), n * .1f + Vec3(1e-3f)};
      light.normals = {n, 1};
      light.cos_reach = 0;
      light.falling = std::sin(theta);
      lights.push_back(light);
      centres.push_back(n * .1f);
      normals.push_back(n);
    }
  const LightTree tree(lights, numbered(static_cast<int>(lights.size())));
  for (const LitPoint& lit : {LitPoint{Vec3(2, -1, .5f), Vec3(-1, 0, 0)},
                              LitPoint{Vec3(.3f, .2f, -.5f), Vec3(0, 0, 1)}}) {
    double mean = 0, square = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const Vec3 to = centres[i] - lit.position;
      const double d2 = double(to.length2()),
                   seen = -double(dot(to, normals[i])) * double(dot(to, lit.normal));
      if (!(dot(to, normals[i]) < 0) || !(seen > 0)) continue;
      const double value = double(lights[i].falling) * seen / (d2 * d2);
      mean += value;
      square += value * value / double(tree.probability(lit, static_cast<int>(i)));
    }
    EXPECT_LT(square / (mean * mean) - 1, .25);
  }
}

TEST(LightTree, RaysMeetTheBoxesThatTheyCross) {
  const int n = 300;
  const std::vector<LightBounds> lights = random_lights(n, 6);
  const LightTree tree(lights, numbered(n));
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> u(-1, 1);
  int met = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 from(5 + 6 * u(engine), 5 + 6 * u(engine), 1.5f + 2 * u(engine));
    // Through the middle of a light, beyond it, and short of it.
    const int aim = k % n;
    const Vec3 to = lights[static_cast<std::size_t>(aim)].box.center() - from;
    std::vector<int> found;
    tree.for_each_on_way(from, normalize(to), length(to) * 1.01f,
                         [&](int light) { found.push_back(light); });
    EXPECT_TRUE(std::find(found.begin(), found.end(), aim) != found.end());
    met += static_cast<int>(found.size());
    bool again = false;
    const Vec3 half = lights[static_cast<std::size_t>(aim)].box.size();
    tree.for_each_on_way(from, normalize(to), std::max(0.0f, length(to) - length(half)) * .99f,
                         [&](int light) { again |= light == aim; });
    EXPECT_FALSE(again);
  }
  EXPECT_LT(met, 2000 * 12) << "boxes are passed over that no ray meets";
}

TEST(DirectionCone, TwoConesFitInTheirUnion) {
  std::mt19937 engine(8);
  std::uniform_real_distribution<float> u(-1, 1);
  for (int k = 0; k < 500; ++k) {
    const auto cone = [&] {
      return DirectionCone{normalize(Vec3(u(engine), u(engine), u(engine))), u(engine)};
    };
    const DirectionCone a = cone(), b = cone(), all = joined(a, b);
    for (const DirectionCone& part : {a, b}) {
      const Frame frame(part.axis);
      for (int j = 0; j < 16; ++j) {
        const float phi = kTwoPi * static_cast<float>(j) / 16;
        const float sine = std::sqrt(1 - sqr(part.cosine));
        const Vec3 rim =
            frame.to_world(Vec3(sine * std::cos(phi), sine * std::sin(phi), part.cosine));
        EXPECT_GT(dot(rim, all.axis), all.cosine - 1e-3f);
      }
    }
  }
}

}  // namespace light_tree_test
}  // namespace oriel
