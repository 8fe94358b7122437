// SPDX-License-Identifier: Apache-2.0
// Coverage of pixels by objects before an empty background.
#include "render/silhouettes.h"

#include <cmath>

#include "support/picture.h"

namespace oriel::testing {
namespace silhouettes_test {

constexpr int kSide = 32;
constexpr float kRadiance = 3;

/// A triangle in pixels of the picture, and its place in front of the camera.
const std::vector<Vec2> kTriangle = {Vec2(4.3f, 3.1f), Vec2(27.6f, 8.4f), Vec2(11.2f, 26.9f)};

SceneText triangle(const std::string& options = {}) {
  SceneText text("trace depth 2 2 2 " + options);
  std::vector<Vec3> corners;
  for (const Vec2& p : kTriangle) corners.push_back(Vec3(p.x / kSide - .5f, p.y / kSide - .5f, -1));
  text.emitter("lamp", kRadiance).polygon("lamp", corners);
  return text;
}

float area(const std::vector<Vec2>& polygon) {
  float twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

/// The part of a polygon where `inside` is not negative; it is linear.
template <class F>
std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, const F& inside) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const float at_a = inside(a), at_b = inside(b);
    if (at_a >= 0) kept.push_back(a);
    if (at_a * at_b < 0) kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  return kept;
}

/// The share of a pixel that the triangle covers, exact. Film rows count from the top.
float coverage(int x, int y) {
  const auto left = static_cast<float>(x), bottom = static_cast<float>(kSide - 1 - y);
  std::vector<Vec2> p = clipped(kTriangle, [&](const Vec2& v) { return v.x - left; });
  p = clipped(p, [&](const Vec2& v) { return left + 1 - v.x; });
  p = clipped(p, [&](const Vec2& v) { return v.y - bottom; });
  return area(clipped(p, [&](const Vec2& v) { return bottom + 1 - v.y; }));
}

struct Errors {
  double mean = 0, square = 0;  ///< over the pixels that the triangle covers partly
  int pixels = 0;
};

/// Differences of alpha, or of the light, from the exact coverage.
Errors errors(const SceneText& text, std::uint32_t samples, bool of_light) {
  Errors e;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    SessionSettings settings;
    settings.budget.samples = samples;
    settings.seed = seed;
    const RenderedScene scene(text, settings);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const float exact = coverage(x, y);
        if (exact < 1e-4f || exact > 1 - 1e-4f) continue;
        const Rgba seen = scene.at(x, y);
        const double d = (of_light ? seen.g / kRadiance : seen.a) - exact;
        e.mean += d, e.square += d * d, ++e.pixels;
      }
  }
  e.mean /= e.pixels, e.square /= e.pixels;
  return e;
}

TEST(Silhouettes, AlphaAndLightAreTheExactCoverage) {
  for (const bool of_light : {false, true}) {
    const Errors e = errors(triangle(), 32, of_light);
    EXPECT_GT(e.pixels, 200);
    // Four standard errors of the mean.
    EXPECT_LT(std::abs(e.mean), 4 * std::sqrt(e.square / e.pixels));
    EXPECT_LT(std::sqrt(e.square), .02) << "of one place for each sample: .03";
  }
}

TEST(Silhouettes, HaveLessNoiseThanBeforeADarkEnvironment) {
  for (const bool of_light : {false, true}) {
    const Errors empty = errors(triangle(), 16, of_light);
    const Errors black = errors(triangle().uniform_sky(0), 16, true);
    const Errors dark = errors(triangle().uniform_sky(1e-6f), 16, true);
    EXPECT_LT(empty.square * 5, dark.square);
    EXPECT_LT(black.square * 5, dark.square);
  }
}

TEST(Silhouettes, TheSumOfThePixelsIsTheAreaWithEachFilter) {
  for (const char* filter : {"box 1 1", "box 2 2", "triangle 2 2", "gauss 3 3", "mitchell 4 4"}) {
    SessionSettings settings;
    settings.budget.samples = 64;
    const RenderedScene scene(triangle("filter " + std::string(filter)), settings);
    double alpha = 0, light = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        alpha += scene.at(x, y).a;
        light += scene.at(x, y).g / kRadiance;
      }
    EXPECT_NEAR(alpha, area(kTriangle), .004 * area(kTriangle)) << filter;
    EXPECT_NEAR(light, area(kTriangle), .004 * area(kTriangle)) << filter;
  }
}

/// Root mean square difference between the coverage of pixels and their mapped brightness, which is
/// 1 within the triangle.
double mapped_error(SceneText text, std::uint32_t samples) {
  text.camera(
      "lens \"mia_exposure_simple\" ( \"gain\" 20, \"compression\" 1000, \"gamma\" 1 ) "
      "focal 1 aperture 1 aspect 1 resolution 32 32");
  SessionSettings settings;
  settings.budget.samples = samples;
  const RenderedScene scene(text, settings);
  const Film& film = scene.session().film();
  const float white = film.shown(14, 18).y;
  double square = 0;
  int pixels = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const float exact = coverage(x, y);
      if (exact < .05f || exact > .95f) continue;
      const double d = film.shown(x, y).y / white - exact;
      square += d * d, ++pixels;
    }
  return std::sqrt(square / pixels);
}

/// Bright light is mapped part by part: a pixel that it half covers is half as bright, not white.
/// Parts that edges cross are brighter than that, as with many samples of one place.
TEST(Silhouettes, MappedEdgesAreNotWider) {
  const double one_place = mapped_error(triangle().uniform_sky(1e-6f), 64 * kSilhouettePlaces);
  EXPECT_LT(one_place, .2) << "of whole pixels: .4";
  EXPECT_NEAR(mapped_error(triangle(), 64), one_place, .05 * one_place);
}

TEST(Silhouettes, MattesHaveTheCoverageOfAlpha) {
  SessionSettings settings;
  settings.budget.samples = 16;
  settings.mattes = MatteNames{{"triangle"}, {"triangle"}, {0}};
  const RenderedScene scene(triangle(), settings);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      float covered = 0;
      for (const Mattes::Share& share : scene.session().mattes()->shares(x, y))
        if (share.seen.instance >= 0) covered += share.coverage;
      EXPECT_NEAR(covered, scene.at(x, y).a, 1e-5f) << x << " " << y;
    }
}

}  // namespace silhouettes_test
}  // namespace oriel::testing
