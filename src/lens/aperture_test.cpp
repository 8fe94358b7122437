// SPDX-License-Identifier: Apache-2.0
// Apertures: areas, corners, radial distribution, kernels from pictures.
#include "lens/aperture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sampling/sampler.h"

namespace oriel::lens {
namespace aperture_test {

constexpr int kSamples = 1 << 16;

template <class F>
void each_sample(const Aperture& aperture, const F& f) {
  for (int i = 0; i < kSamples; ++i) {
    sampling::Sampler sampler(1, 2, static_cast<std::uint32_t>(i));
    f(aperture.sample(sampler.next_2d()));
  }
}

/// Share of samples within `radius`.
float share_within(const Aperture& aperture, float radius) {
  int inside = 0;
  each_sample(aperture, [&](const Aperture::Sample& s) { inside += s.point.length() < radius; });
  return static_cast<float>(inside) / kSamples;
}

// acceptance: K2
TEST(Aperture, BiasShapesTheHistogramOfRadii) {
  // P(distance < r) = r^(2 bias): uniform, concentrated at the centre, at the rim.
  for (float bias : {0.5f, 1.0f, 2.0f})
    for (float r : {0.25f, 0.5f, 0.75f, 0.9f})
      EXPECT_NEAR(share_within(Aperture(0, 0, bias), r), std::pow(r, 2 * bias), 2e-3f)
          << bias << " " << r;
  EXPECT_GT(share_within(Aperture(0, 0, 0), 1e-3f), 0.99f);
}

// acceptance: K2
TEST(Aperture, AnEvenPolygonFillsItsArea) {
  for (int n : {3, 4, 6, 9}) {
    // The inscribed circle has the share pi r^2 of the polygon area n/2 sin(2 pi / n).
    const float inner = std::cos(kPi / static_cast<float>(n));
    const float area = static_cast<float>(n) / 2 * std::sin(kTwoPi / static_cast<float>(n));
    EXPECT_NEAR(share_within(Aperture(n, 0.13f, 1), inner), kPi * sqr(inner) / area, 3e-3f) << n;
    EXPECT_EQ(share_within(Aperture(n, 0.13f, 1), 1.00001f), 1);
  }
}

// acceptance: K2
TEST(Aperture, CornersLieWhereTheBladeAngleSays) {
  // A square with its first corner at 36 degrees: the farthest samples of each quarter turn.
  for (float angle : {0.0f, 0.1f, 1.1f}) {
    const Aperture aperture(4, angle, 1);
    float farthest[4] = {0, 0, 0, 0}, at[4] = {0, 0, 0, 0};
    each_sample(aperture, [&](const Aperture::Sample& s) {
      float turn = std::atan2(s.point.y, s.point.x) / kTwoPi - angle + 0.125f;
      turn -= std::floor(turn);
      const int quarter = std::min(static_cast<int>(turn * 4), 3);
      if (s.point.length() <= farthest[quarter]) return;
      farthest[quarter] = s.point.length();
      at[quarter] = turn - 0.125f - 0.25f * static_cast<float>(quarter);
    });
    for (int q = 0; q < 4; ++q) {
      EXPECT_NEAR(farthest[q], 1, 0.01f);
      EXPECT_NEAR(at[q], 0, 0.01f) << "turns off the corner";
    }
  }
}

// acceptance: K2
TEST(Aperture, FewerThanThreeBladesAreRound) {
  for (int n : {-1, 0, 1, 2}) EXPECT_NEAR(share_within(Aperture(n, 0, 1), 0.9f), 0.81f, 2e-3f);
}

// acceptance: K3
TEST(Aperture, PicturesAreReproduced) {
  // 4 x 2 texels: the sum of weights in each is its share of the picture, in each channel.
  const std::vector<Rgb> texels = {Rgb(1),   Rgb(0),       Rgb(2, 1, 0), Rgb(0, 0, 3),
                                   Rgb(.5f), Rgb(0, 4, 0), Rgb(0),       Rgb(1, 1, 2)};
  const Aperture aperture(texels, 4, 2);
  std::vector<Rgb> got(8, Rgb(0));
  each_sample(aperture, [&](const Aperture::Sample& s) {
    const int x = static_cast<int>((s.point.x + 1) * 2), y = static_cast<int>(s.point.y + 1);
    got[static_cast<std::size_t>(y * 4 + x)] += s.weight / float(kSamples);
  });
  Rgb sum(0);
  for (const Rgb& t : texels) sum += t;
  for (std::size_t i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(got[i][k], texels[i][k] / max_component(sum), 2e-3f) << i << " " << k;
}

// acceptance: K3
TEST(Aperture, GreyPicturesWeighEverythingAlike) {
  const std::vector<Rgb> texels = {Rgb(0), Rgb(1), Rgb(.25f), Rgb(3)};
  each_sample(Aperture(texels, 2, 2), [](const Aperture::Sample& s) {
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(s.weight[k], 1, 1e-5f);
    ASSERT_FALSE(s.point.x < 0 && s.point.y < 0) << "the black texel";
  });
}

TEST(Aperture, ABlackPictureLetsNothingIn) {
  const std::vector<Rgb> texels(4, Rgb(0));
  each_sample(Aperture(texels, 2, 2),
              [](const Aperture::Sample& s) { ASSERT_TRUE(is_black(s.weight)); });
}

TEST(Aperture, OddParametersGivePoints) {
  const float inf = std::numeric_limits<float>::infinity();
  for (float odd : {inf, -inf, std::nanf(""), -3.0f})
    for (const Aperture& a : {Aperture(6, odd, 1), Aperture(6, 0, odd), Aperture(2000000000, 0, 1)})
      each_sample(a, [](const Aperture::Sample& s) { ASSERT_LE(s.point.length(), 1.00001f); });
  const std::vector<Rgb> texels = {Rgb(inf, 1, 1), Rgb(-1), Rgb(std::nanf("")), Rgb(1)};
  each_sample(Aperture(texels, 2, 2), [](const Aperture::Sample& s) {
    ASSERT_TRUE(std::isfinite(s.weight.x + s.weight.y + s.weight.z));
  });
}

}  // namespace aperture_test
}  // namespace oriel::lens
