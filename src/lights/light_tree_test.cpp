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
