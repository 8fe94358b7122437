// SPDX-License-Identifier: Apache-2.0
#include "lights/mesh_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace oriel {
namespace mesh_lights_test {

struct Triangles {
  std::vector<EmissiveTriangle> list;
  std::vector<LightBounds> bounds;
};

/// Of two instances, every second primitive of the second one emits.
Triangles random_triangles(std::uint32_t n, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> u;
  Triangles t;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec3 centre(10 * u(engine), 10 * u(engine), 3 * u(engine));
    LightBounds b;
    b.box = {centre - Vec3(.01f), centre + Vec3(.01f)};
    b.falling = .1f + u(engine);
    if (i % 3 == 0) {
      b.normals = {normalize(Vec3(u(engine) - .5f, u(engine) - .5f, u(engine) - .5f)), 1};
      b.cos_reach = 0;
    }
    t.bounds.push_back(b);
    t.list.push_back({i % 2, i % 2 ? 2 * (i / 2) : i / 2, b.falling});
  }
  return t;
}

MeshLights lights_of(const Triangles& t) {
  const auto n = static_cast<std::uint32_t>(t.list.size());
  const std::vector<std::uint32_t> counts = {n, 2 * n};
  return {t.list, t.bounds, counts};
}

TEST(MeshLights, ChancesSumToNearlyOneAndAreThoseOfTheChoices) {
  // In clusters of one, and of several.
  for (const std::uint32_t n : {1u, 2u, 700u, 60000u}) {
    const Triangles t = random_triangles(n, n);
    const MeshLights lights = lights_of(t);
    ASSERT_EQ(lights.size(), n);
    EXPECT_LE(lights.clusters(), MeshLights::kMaxClusters);
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> u;
    for (int place = 0; place < 3; ++place) {
      const LitPoint lit{Vec3(10 * u(engine), 10 * u(engine), -1), Vec3(0, 0, 1)};
      double sum = 0;  // double: thousands of terms
      for (const EmissiveTriangle& g : t.list)
        sum += static_cast<double>(lights.probability(lit, {}, g.instance, g.primitive));
      // What the cones of several triangles together might light, though none of them does, ends
      // a few choices in nothing.
      if (n > 2) {
        EXPECT_GT(sum, .97) << n;
      }
      EXPECT_LT(sum, 1.001) << n;
      for (int i = 0; i < 200; ++i) {
        const auto chosen = lights.choose(lit, {}, Vec2(u(engine), u(engine)));
        if (!chosen) continue;
        EXPECT_NEAR(chosen->probability,
                    lights.probability(lit, {}, chosen->instance, chosen->primitive),
                    1e-4f * chosen->probability);
      }
    }
  }
}

TEST(MeshLights, LearnedChancesOfPartsReplaceThoseOfTheTree) {
  const Triangles t = random_triangles(3000, 4);
  const MeshLights lights = lights_of(t);
  ASSERT_GT(lights.parts(), 8u);
  ASSERT_LE(lights.parts(), MeshLights::kMaxParts);
  // Only the first parts, beside a share of the tree.
  std::vector<float> probability(lights.parts()), until(lights.parts(), 1);
  probability[0] = .75f, probability[1] = .25f, until[0] = .75f;
  const LightChances chances{probability, until, .2f};
  const LitPoint lit{Vec3(4, 5, 8), Vec3(0)};
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> u;
  // Triangles of a part have the share of the part.
  std::vector<double> of_part(2);
  std::vector<std::vector<bool>> seen(2, std::vector<bool>(3000));
  const auto number = [](const MeshLights::Choice& c) {
    return c.instance == 0 ? 2 * c.primitive : c.primitive + 1;
  };
  for (std::size_t part = 0; part < 2; ++part)
    for (int i = 0; i < 20000; ++i) {
      const auto chosen = lights.choose_of(part, lit, Vec2(u(engine), u(engine)));
      ASSERT_TRUE(chosen);
      if (seen[part][number(*chosen)]) continue;
      seen[part][number(*chosen)] = true;
      const float by_tree = lights.probability_of(part, lit);
      EXPECT_NEAR(lights.probability(lit, {}, chosen->instance, chosen->primitive),
                  by_tree * chosen->probability, 1e-4f * chosen->probability);
      EXPECT_NEAR(lights.probability(lit, chances, chosen->instance, chosen->primitive),
                  (.2f * by_tree + .8f * probability[part]) * chosen->probability,
                  1e-4f * chosen->probability);
      of_part[part] += static_cast<double>(chosen->probability);
    }
  EXPECT_NEAR(of_part[0], 1, .02);
  EXPECT_NEAR(of_part[1], 1, .02);
  int first = 0;
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    const auto chosen = lights.choose(lit, chances, Vec2(u(engine), u(engine)));
    ASSERT_TRUE(chosen);
    EXPECT_NEAR(chosen->probability,
                lights.probability(lit, chances, chosen->instance, chosen->primitive),
                1e-4f * chosen->probability);
    first += seen[0][number(*chosen)];
  }
  const float expected = .8f * .75f + .2f * lights.probability_of(0, lit);
  EXPECT_NEAR(first, kDraws * expected, 4 * std::sqrt(kDraws * expected * (1 - expected)));
}

TEST(MeshLights, NonEmissiveTrianglesAreNeverSampled) {
  const Triangles t = random_triangles(100, 3);
  const MeshLights lights = lights_of(t);
  const LitPoint lit{Vec3(5, 5, -1), Vec3(0)};
  EXPECT_GT(lights.probability(lit, {}, 1, 0), 0);
  EXPECT_EQ(lights.probability(lit, {}, 1, 1), 0) << "a triangle between";
  EXPECT_EQ(lights.probability(lit, {}, 2, 0), 0) << "an instance that does not emit";
  EXPECT_FALSE(MeshLights().choose(lit, {}, Vec2(.5f)));
  EXPECT_EQ(MeshLights().probability(lit, {}, 0, 0), 0);
}

TEST(MeshLights, DistantTrianglesAreInDifferentClusters) {
  // Two patches of many triangles: at one of them the other hardly counts.
  Triangles t;
  for (std::uint32_t i = 0; i < 40000; ++i) {
    LightBounds b;
    const float along = static_cast<float>(i >> 1) * 1e-5f;
    const Vec3 centre(i % 2 ? 100 : 0, along, 0);
    b.box = {centre - Vec3(1e-6f), centre + Vec3(1e-6f)};
    b.falling = 1;
    t.bounds.push_back(b);
    t.list.push_back({i % 2, i % 2 ? 2 * (i / 2) : i / 2, 1});
  }
  const MeshLights lights = lights_of(t);
  double near = 0;  // double: thousands of terms
  for (std::uint32_t i = 0; i < 20000; ++i)
    near += static_cast<double>(lights.probability({Vec3(0, 0, 1), Vec3(0)}, {}, 0, i));
  EXPECT_GT(near, .999);
}

}  // namespace mesh_lights_test
}  // namespace oriel
