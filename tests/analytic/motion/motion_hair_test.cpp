// SPDX-License-Identifier: Apache-2.0
// Moving hair, compared with the fraction of time that a straight hair covers a pixel.
#include "motion_scenes.h"

namespace oriel::testing {
namespace motion_hair_test {

constexpr float kRadius = .7f;

/// An upright hair at x = -8 that glows and reaches beyond the strip. Motion vectors of the hair,
/// or of each of its vertices alike.
SceneText hair_streak(const std::string& shutter, int degree, const std::vector<Vec3>& vectors,
                      bool of_hair = false, const std::string& flags = {}) {
  std::string motion, scalars;
  for (const Vec3& v : vectors) motion += text_of(v) + ' ';
  if (of_hair) scalars = motion;
  for (int i = 0; i <= degree; ++i)
    scalars +=
        fmt::format("-8 {} -5 {}", -6 + 12 * i / static_cast<float>(degree), of_hair ? "" : motion);
  const std::size_t vertices = static_cast<std::size_t>(degree) + 1;
  const std::size_t count = 3 * vertices + 3 * vectors.size() * (of_hair ? 1 : vertices);
  const std::string field = vectors.empty() ? "" : fmt::format("m {}", vectors.size());
  SceneText scene(shutter);
  return scene.emitter("glow", 1)
      .statement(fmt::format("object \"o\" visible on shadow on trace on\n"
                             "hair radius {} degree {} {} {} scalar [{}] {} hair [2] 0 {}\n"
                             "end hair end object\n"
                             "instance \"i\" \"o\" material \"glow\" {} end instance",
                             kRadius, degree,
                             field.empty() ? ""
                             : of_hair     ? "hair"
                                           : "vertex",
                             field, count, scalars, count, flags))
      .member("i")
      .camera(kStrip);
}

TEST(MotionBlur, AMovingHairCoversEachPixelForItsShareOfTheTime) {
  for (const int degree : {1, 2, 3})
    for (const bool of_hair : {false, true})
      expect_streak(rendered(hair_streak("shutter 1", degree, {{12.5f, 0, 0}}, of_hair)), -8, 12.5,
                    0, 1, kRadius);
}

TEST(MotionBlur, ShutterLimitsTheMotionOfHair) {
  expect_streak(rendered(hair_streak("shutter .25 .75", 3, {{12.5f, 0, 0}})), -8, 12.5, .25, .75,
                kRadius);
  expect_streak(rendered(hair_streak("shutter -.5 .5", 1, {{12.5f, 0, 0}})), -8, 12.5, -.5, .5,
                kRadius);
  // Faster in its second half.
  const Image image = rendered(hair_streak("shutter 1", 1, {{2, 0, 0}, {12, 0, 0}}));
  for (int i = 0; i < 40; ++i) {
    const double exact = (covered(i - 20, -8, 2, 0, 1, static_cast<double>(kRadius)) +
                          covered(i - 20, -6, 10, 0, 1, static_cast<double>(kRadius))) /
                         2;
    EXPECT_NEAR(image.at(i, 2)[0], exact, 4 * std::sqrt(exact * (1 - exact) / kSamples) + 1e-3)
        << i;
  }
}

TEST(MotionBlur, HairMovesWithItsInstance) {
  const std::string way = moves_by(12.5f), part = moves_by(7.5f);
  for (const int degree : {1, 3}) {
    expect_streak(rendered(hair_streak("shutter 1", degree, {}, false, way)), -8, 12.5, 0, 1,
                  kRadius);
    expect_streak(rendered(hair_streak("shutter 1", degree, {{5, 0, 0}}, false, part)), -8, 12.5, 0,
                  1, kRadius);
  }
}

TEST(MotionBlur, ClosedShutterShowsStaticHair) {
  const Image still = rendered(hair_streak("", 1, {}), 16);
  for (const char* closed : {"shutter 0 0", "shutter 1 motion off", ""})
    EXPECT_EQ(rendered(hair_streak(closed, 1, {{12.5f, 0, 0}}), 16).pixels, still.pixels) << closed;
}

TEST(MotionLayer, ContainsTheMotionOfHair) {
  for (const bool of_hair : {false, true}) {
    const Vec3 found = motion_layer(hair_streak("shutter .5", 3, {{12.5f, 2, -1}}, of_hair));
    EXPECT_LT(length(found - Vec3(6.25f, 1, .5f)), 1e-4f) << found;
  }
}

}  // namespace motion_hair_test
}  // namespace oriel::testing
