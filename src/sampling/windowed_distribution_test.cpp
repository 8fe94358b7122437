// SPDX-License-Identifier: Apache-2.0
#include "sampling/windowed_distribution.h"

#include <gtest/gtest.h>

#include <array>

#include "sampling/sampler.h"

namespace oriel::sampling {
namespace windowed_distribution_test {

constexpr std::size_t kWidth = 4, kHeight = 2;
constexpr std::array<float, 8> kTable = {1, 2, 0, 5,  //
                                         3, 0, 7, 1};

/// Overlap of [a, b] with the cell.
float overlap(float a, float b, std::size_t cell, std::size_t cells) {
  const float n = static_cast<float>(cells), lo = static_cast<float>(cell) / n;
  return std::max(0.0f, std::min(b, lo + 1 / n) - std::max(a, lo));
}
float part(const Window& w, std::size_t x, std::size_t y) {
  return kTable[y * kWidth + x] * overlap(w.lo.x, w.hi.x, x, kWidth) *
         overlap(w.lo.y, w.hi.y, y, kHeight);
}
const Window kWindows[] = {{Vec2(0), Vec2(1)},
                           {Vec2(.1f, .2f), Vec2(.9f, .95f)},
                           {Vec2(.3f, .3f), Vec2(.45f, .8f)},
                           {Vec2(.6f, .1f), Vec2(.8f, .4f)},
                           {Vec2(.51f, .55f), Vec2(.511f, .5501f)}};

TEST(WindowedDistribution, IntegralsAreSumsOfOverlaps) {
  const WindowedDistribution2D table(kTable, kWidth, kHeight);
  for (const Window& w : kWindows) {
    float sum = 0;
    for (std::size_t y = 0; y < kHeight; ++y)
      for (std::size_t x = 0; x < kWidth; ++x) sum += part(w, x, y);
    EXPECT_NEAR(table.integral(w), sum, 1e-6f * sum + 1e-9f);
  }
}

TEST(WindowedDistribution, SamplesMatchTheTableInsideOfTheWindow) {
  const WindowedDistribution2D table(kTable, kWidth, kHeight);
  constexpr int kSamples = 1 << 16;
  for (const Window& w : kWindows) {
    const float all = table.integral(w);
    std::array<int, 8> count{};
    Vec2 moment(0);
    for (int i = 0; i < kSamples; ++i) {
      Sampler sampler(1, 2, static_cast<std::uint32_t>(i));
      const auto s = table.sample(sampler.next_2d(), w);
      ASSERT_GE(s.uv.x, w.lo.x);
      ASSERT_LE(s.uv.x, w.hi.x);
      ASSERT_GE(s.uv.y, w.lo.y);
      ASSERT_LE(s.uv.y, w.hi.y);
      const auto x = std::min(static_cast<std::size_t>(s.uv.x * kWidth), kWidth - 1);
      const auto y = std::min(static_cast<std::size_t>(s.uv.y * kHeight), kHeight - 1);
      ++count[y * kWidth + x];
      moment += s.uv;
      ASSERT_NEAR(s.pdf * all, kTable[y * kWidth + x], 1e-4f);
      ASSERT_NEAR(s.pdf, table.pdf(s.uv, w), 1e-4f * s.pdf);
    }
    Vec2 centre(0);
    for (std::size_t y = 0; y < kHeight; ++y)
      for (std::size_t x = 0; x < kWidth; ++x) {
        const float share = part(w, x, y) / all;
        const double sigma = std::sqrt(double(share) * (1 - double(share)) * kSamples) + 1;
        EXPECT_NEAR(count[y * kWidth + x], double(share) * kSamples, 4 * sigma) << x << ' ' << y;
        const auto middle = [](float a, float b, std::size_t cell, std::size_t cells) {
          const float n = static_cast<float>(cells), lo = static_cast<float>(cell) / n;
          return (std::max(a, lo) + std::min(b, lo + 1 / n)) / 2;
        };
        centre +=
            Vec2(middle(w.lo.x, w.hi.x, x, kWidth), middle(w.lo.y, w.hi.y, y, kHeight)) * share;
      }
    // Uniform inside cells, so the mean is that of the cell centres.
    EXPECT_NEAR(moment.x / kSamples, centre.x, 4 * .3f / std::sqrt(kSamples * 1.0f));
    EXPECT_NEAR(moment.y / kSamples, centre.y, 4 * .3f / std::sqrt(kSamples * 1.0f));
  }
}

TEST(WindowedDistribution, WindowsWithoutWeightGiveNothing) {
  const WindowedDistribution2D table(kTable, kWidth, kHeight);
  const Window dark{Vec2(.55f, .1f), Vec2(.7f, .4f)};
  EXPECT_EQ(table.integral(dark), 0);
  EXPECT_EQ(table.sample(Vec2(.5f), dark).pdf, 0);
  EXPECT_EQ(table.pdf(Vec2(.6f, .2f), dark), 0);
  const Window flat{Vec2(.3f), Vec2(.3f, .9f)};
  EXPECT_EQ(table.sample(Vec2(.5f), flat).pdf, 0);
}

}  // namespace windowed_distribution_test
}  // namespace oriel::sampling
