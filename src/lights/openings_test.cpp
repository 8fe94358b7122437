// SPDX-License-Identifier: Apache-2.0
#include "lights/openings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sampling/sampler.h"

namespace oriel {
namespace openings_test {

/// Two squares of side 2: above the origin at z = 1, facing down, and beside it at x = 2.
Openings two_squares() {
  return Openings({{Vec3(-1, -1, 1), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, -1)},
                   {Vec3(2, -1, 0), Vec3(0, 2, 0), Vec3(0, 0, 2), Vec3(-1, 0, 0)}});
}

TEST(Openings, DensityMatchesTheSamples) {
  const Openings openings = two_squares();
  const LitPoint at{Vec3(.2f, .1f, 0), Vec3(0, 0, 1)};
  const float total = openings.total(at);
  constexpr int kDraws = 100000;
  double above = 0, beside = 0;
  for (int i = 0; i < kDraws; ++i) {
    sampling::Sampler random(i, 0, 0);
    const auto s = openings.sample(at, total, random.next_2d());
    ASSERT_TRUE(s);
    ASSERT_NEAR(openings.pdf(at, total, s->wi) / s->pdf, 1, 1e-4);
    const Vec3 top = at.position + s->wi * (1 / s->wi.z);
    const bool is_above = std::max(std::abs(top.x), std::abs(top.y)) < 1;
    (is_above ? above : beside) += 1.0 / kDraws / static_cast<double>(s->pdf);
  }
  // Solid angles of rectangles by their corners: sums of asin(x y / (a b)) at distance d, where
  // a^2 = x^2 + d^2, b^2 = y^2 + d^2.
  const auto corner = [](double x, double y, double d) {
    return std::asin(x * y / std::sqrt((x * x + d * d) * (y * y + d * d)));
  };
  EXPECT_NEAR(
      above / (corner(.8, .9, 1) + corner(1.2, .9, 1) + corner(.8, 1.1, 1) + corner(1.2, 1.1, 1)),
      1, .01);
  EXPECT_NEAR(beside / (corner(.9, 2, 1.8) + corner(1.1, 2, 1.8)), 1, .01);
}

TEST(Openings, DoNotLightWhatIsBehindThem) {
  const Openings openings = two_squares();
  EXPECT_EQ(openings.total({Vec3(5, 0, 3), Vec3(0)}), 0);
  EXPECT_FALSE(openings.sample({Vec3(5, 0, 3), Vec3(0)}, 0, Vec2(.5f)));
  EXPECT_GT(openings.total({Vec3(5, 0, .5f), Vec3(0)}), 0) << "below the first one";
  // The square above is behind the surface, the other one is not.
  const LitPoint down{Vec3(0), Vec3(0, 0, -1)};
  EXPECT_EQ(openings.total(down), 0);
  const LitPoint beside{Vec3(0, 0, .5f), Vec3(0, 0, -1)};
  EXPECT_GT(openings.total(beside), 0);
  EXPECT_EQ(openings.pdf(beside, openings.total(beside), Vec3(0, 0, 1)), 0);
  EXPECT_TRUE(Openings().empty());
  EXPECT_FALSE(Openings().sample(down, 0, Vec2(.5f)));
}

}  // namespace openings_test
}  // namespace oriel
