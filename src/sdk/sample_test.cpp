// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "oriel/sdk/shader/sample.h"
#include "sdk/testing/bare_state.h"

namespace oriel::sdk {
namespace sample_test {

using testing::BareState;

TEST(Sample, AloneIsOneFilledPoint) {
  BareState bare;
  double s[5] = {-1, -1, -1, -1, -1};
  EXPECT_FALSE(mi_sample(s, nullptr, &bare.state(), 4, nullptr));
  for (int i = 0; i < 4; ++i) {
    EXPECT_GE(s[i], 0);
    EXPECT_LT(s[i], 1);
  }
  EXPECT_EQ(s[4], -1) << "no more than it was asked for";
}

TEST(Sample, LoopRunsTheGivenCount) {
  BareState bare;
  double s[3];
  int instance = 0, seen = 0;
  const miUint n = 7;
  while (mi_sample(s, &instance, &bare.state(), 3, &n)) EXPECT_EQ(instance, ++seen);
  EXPECT_EQ(seen, 7);
  const miUint none = 0;
  instance = 0;
  EXPECT_FALSE(mi_sample(s, &instance, &bare.state(), 3, &none));
}

TEST(Sample, LoopWithoutACountContinues) {
  BareState bare;
  double s[2];
  int instance = 0;
  for (int i = 1; i <= 1000; ++i) {
    ASSERT_TRUE(mi_sample(s, &instance, &bare.state(), 2, nullptr));
    ASSERT_EQ(instance, i);
    ASSERT_LT(s[0], 1);
  }
}

TEST(Sample, LoopIsStratifiedWithCorrectMean) {
  BareState bare;
  constexpr int kLoops = 2000;
  const miUint n = 16;
  double mean = 0, square = 0;
  for (int i = 0; i < kLoops; ++i) {
    bare.numbers.start(i);
    double s[2], sum = 0;
    int instance = 0;
    while (mi_sample(s, &instance, &bare.state(), 2, &n)) sum += s[0] * s[1] / n;
    mean += sum / kLoops;
    square += (sum - .25) * (sum - .25) / kLoops;
  }
  const double alone = std::sqrt((1 / 9.0 - 1 / 16.0) / n);  // error of 16 independent points
  EXPECT_NEAR(mean, .25, 4 * std::sqrt(square / kLoops));
  EXPECT_LT(std::sqrt(square), alone / 2);
}

TEST(Sample, NestedLoopsAreUncorrelated) {
  BareState bare;
  const miUint outer_n = 8, inner_n = 4;
  double product = 0;
  int count = 0;
  for (int i = 0; i < 500; ++i) {
    bare.numbers.start(i);
    double outer[1], inner[1];
    int a = 0;
    while (mi_sample(outer, &a, &bare.state(), 1, &outer_n)) {
      int b = 0;
      while (mi_sample(inner, &b, &bare.state(), 1, &inner_n)) {
        product += (outer[0] - .5) * (inner[0] - .5) * 12;
        ++count;
      }
    }
  }
  EXPECT_EQ(count, 500 * 32);
  EXPECT_NEAR(product / count, 0, 4 / std::sqrt(500.0 * 8));
}

TEST(Random, IsReproduciblePerSample) {
  BareState bare;
  bare.numbers.start(3);
  const double first = mi_par_random(&bare.state());
  EXPECT_NE(mi_par_random(&bare.state()), first);
  bare.numbers.start(3);
  EXPECT_EQ(mi_par_random(&bare.state()), first);
}

TEST(Random, SeedRestartsTheSequence) {
  mi_srandom(42);
  const float a = mi_random(), b = mi_random();
  mi_srandom(42);
  EXPECT_EQ(mi_random(), a);
  EXPECT_EQ(mi_random(), b);
  mi_srandom(43);
  EXPECT_NE(mi_random(), a);
  double mean = 0;
  for (int i = 0; i < 10000; ++i) mean += mi_random() / 10000;
  EXPECT_NEAR(mean, .5, 4 * .29 / 100);
}

TEST(Random, SeededSequenceMatchesPosix) {
  unsigned short ours[3] = {1, 2, 3}, theirs[3] = {1, 2, 3};
  for (int i = 0; i < 100; ++i) {
    EXPECT_NEAR(mi_erandom(ours), erand48(theirs), 1e-7);
    EXPECT_EQ(ours[2], theirs[2]);
  }
}

}  // namespace sample_test
}  // namespace oriel::sdk
