// SPDX-License-Identifier: Apache-2.0
#include "geom/point_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "sampling/sampler.h"

namespace oriel::geom {
namespace point_tree_test {

struct Cloud {
  int dimensions;
  std::vector<std::vector<float>> places;
  PointTree tree;

  /// Coordinates are multiples of 1/8: many points coincide and many distances are equal.
  Cloud(int its_dimensions, int count) : dimensions(its_dimensions), tree(dimensions, sizeof(int)) {
    sampling::Sampler sampler;
    for (int i = 0; i < count; ++i) {
      sampler.start(i, 0, 0, 7);
      std::vector<float> place;
      for (int k = 0; k < dimensions; ++k)
        place.push_back(std::floor(sampler.next_2d().x * 32) / 8);
      EXPECT_TRUE(tree.add(place.data(), &i));
      places.push_back(std::move(place));
    }
  }

  double distance(int i, const std::vector<float>& from) const {
    double sum = 0;
    for (std::size_t k = 0; k < from.size(); ++k) {
      const double d = static_cast<double>(places[static_cast<std::size_t>(i)][k]) - from[k];
      sum += d * d;
    }
    return std::sqrt(sum);
  }

  /// Points within a radius, nearest first, by linear search.
  std::vector<int> search(const std::vector<float>& from, float radius, std::size_t most) const {
    std::vector<std::pair<double, int>> all;
    for (int i = 0; i < static_cast<int>(places.size()); ++i)
      if (distance(i, from) <= radius) all.emplace_back(distance(i, from), i);
    std::sort(all.begin(), all.end());
    std::vector<int> numbers;
    for (const auto& [d, i] : all)
      if (numbers.size() < most) numbers.push_back(i);
    return numbers;
  }
};

TEST(PointTree, MatchesBruteForceSearch) {
  for (const auto& [dimensions, count] : {std::pair(1, 300), {2, 777}, {3, 1000}, {7, 500}}) {
    const Cloud cloud(dimensions, count);
    for (const float radius : {0.f, .3f, 1.f, 100.f})
      for (const std::size_t most : {std::size_t{1}, std::size_t{5}, std::size_t{10000}})
        for (const float at : {-1.f, .5f, 1.8125f, 3.f}) {
          const std::vector<float> place(static_cast<std::size_t>(dimensions), at);
          std::vector<int> found;
          for (const PointTree::Near& near : cloud.tree.near(place.data(), radius, most)) {
            found.push_back(*static_cast<const int*>(near.point.data));
            EXPECT_NEAR(near.distance, cloud.distance(found.back(), place), 1e-5);
          }
          EXPECT_EQ(found, cloud.search(place, radius, most))
              << dimensions << " coordinates, radius " << radius << ", most " << most;
        }
  }
}

TEST(PointTree, StoresAllPointsExactly) {
  PointTree tree(3, 2);
  const float place[] = {1, 2, 3};
  EXPECT_TRUE(tree.add(place, nullptr));
  const PointTree::Point first = tree.all().front();
  EXPECT_EQ(static_cast<const char*>(first.data)[1], 0) << "no data is zeros";
  for (int i = 0; i < 1000; ++i) tree.add(place, "ab");
  EXPECT_EQ(tree.all().size(), 1001u);
  EXPECT_EQ(tree.all().front().data, first.data);
  EXPECT_EQ(first.place[2], 3);
  EXPECT_GE(tree.bytes(), 1001u * 14);
}

TEST(PointTree, RejectsNonFinitePoints) {
  PointTree tree(2, 0);
  const float nan[] = {0, std::numeric_limits<float>::quiet_NaN()};
  const float far[] = {std::numeric_limits<float>::infinity(), 0};
  const float place[] = {3e38f, -3e38f}, other[] = {-3e38f, 3e38f};
  EXPECT_FALSE(tree.add(nan, nullptr));
  EXPECT_FALSE(tree.add(far, nullptr));
  EXPECT_TRUE(tree.add(place, nullptr));
  EXPECT_EQ(tree.near(nan, 1, 9).size(), 0u);
  EXPECT_EQ(tree.near(place, -1, 9).size(), 0u);
  EXPECT_EQ(tree.near(other, std::numeric_limits<float>::infinity(), 9).size(), 1u);
}

TEST(PointTree, SupportsConcurrentInsertionAndQueries) {
  PointTree tree(1, 0);
  const auto work = [&] {
    for (int i = 0; i < 2000; ++i) {
      const float place = static_cast<float>(i);
      tree.add(&place, nullptr);
      EXPECT_GE(tree.near(&place, 0, 10).size(), 1u);
    }
  };
  std::thread other(work);
  work();
  other.join();
  EXPECT_EQ(tree.all().size(), 4000u);
}

}  // namespace point_tree_test
}  // namespace oriel::geom
