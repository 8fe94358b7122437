// SPDX-License-Identifier: Apache-2.0
// Exposures as lens shaders of a camera give the same values as their pure functions.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "probe.h"
#include "tone/exposure.h"

namespace oriel {
namespace lens_test {

/// A camera with one exposure, and the mapped value of a colour.
struct Exposed : testing::PreparedScene {
  explicit Exposed(std::string_view shader)
      : PreparedScene(testing::scene_text("material \"m\" \"mib_illum_lambert\" ( ) end material",
                                          {}, fmt::format("lens {}", shader))) {
    EXPECT_TRUE(diagnostics.all().empty()) << messages();
    EXPECT_TRUE(world && world->lens.size() == 1);
  }
  Rgb operator()(const Rgb& c, float cosine = 1, bool orthographic = false) const {
    ShadingPoint point;
    const ShaderNode* node = world->lens.at(0);
    return node->with_params(point, [&](const Call& call) {
      return node->spec().lens.map_color(call, {cosine, orthographic}, c);
    });
  }
};

const Rgb kColours[] = {Rgb(0.0f),    Rgb(1e-3f, 2e-3f, 5e-4f), Rgb(.18f), Rgb(.9f, .4f, .1f),
                        Rgb(3, 2, 1), Rgb(8000, 6000, 5000),    Rgb(1e5f)};

void expect_same(const Exposed& shader, const auto& function) {
  for (const Rgb& c : kColours) {
    const Rgb a = shader(c), b = function(c);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(a[i], b[i]) << c.x;
  }
}

// acceptance: X1
TEST(LensShaders, SimpleExposureIsTheFunctionWithItsDefaults) {
  expect_same(Exposed("\"mia_exposure_simple\" ( )"), lens::SimpleExposure({}));
  expect_same(Exposed("\"mia_exposure_simple\" ( \"pedestal\" .02, \"gain\" .18, \"knee\" .75, "
                      "\"compression\" 3, \"gamma\" 1.8 )"),
              lens::SimpleExposure(
                  {.pedestal = .02f, .gain = .18f, .knee = .75f, .compression = 3, .gamma = 1.8f}));
}

// acceptance: X1
TEST(LensShaders, SimpleExposureWorksInTheOrderOfItsParameters) {
  // Pedestal, gain: (.1 + .1) * 3 = .6; .1 above the knee, squashed; gamma 2 is the root.
  const Exposed shader(
      "\"mia_exposure_simple\" ( \"pedestal\" .1, \"gain\" 3, \"knee\" .5, "
      "\"compression\" 0, \"gamma\" 2 )");
  EXPECT_NEAR(shader(Rgb(.1f)).x, std::sqrt(.6), 1e-6);
}

// acceptance: X3, X4, X5, X7
TEST(LensShaders, PhotographicExposureIsTheFunctionWithItsDefaults) {
  expect_same(Exposed("\"mia_exposure_photographic\" ( )"), lens::PhotographicExposure({}));
  expect_same(
      Exposed("\"mia_exposure_photographic\" ( \"cm2_factor\" 2, \"whitepoint\" 1 .9 .7, "
              "\"film_iso\" 400, \"camera_shutter\" 60, \"f_number\" 4, \"vignetting\" 3, "
              "\"burn_highlights\" .5, \"crush_blacks\" .1, \"saturation\" .8, \"gamma\" 1.8 )"),
      lens::PhotographicExposure({.cm2_factor = 2,
                                  .whitepoint = Rgb(1, .9f, .7f),
                                  .film_iso = 400,
                                  .camera_shutter = 60,
                                  .f_number = 4,
                                  .vignetting = 3,
                                  .burn_highlights = .5f,
                                  .crush_blacks = .1f,
                                  .saturation = .8f,
                                  .gamma = 1.8f}));
}

// acceptance: X3
TEST(LensShaders, EqualExposuresGiveEqualPixels) {
  const Exposed a(
      "\"mia_exposure_photographic\" ( \"film_iso\" 100, \"camera_shutter\" 100, "
      "\"f_number\" 16 )");
  const Exposed b(
      "\"mia_exposure_photographic\" ( \"film_iso\" 400, \"camera_shutter\" 1600, "
      "\"f_number\" 8 )");
  for (const Rgb& c : kColours) EXPECT_NEAR(a(c).x, b(c).x, 1e-5 * std::max(1.0f, a(c).x));
}

// acceptance: X4
TEST(LensShaders, FilmIsoZeroIsAPlainGain) {
  const Exposed shader(
      "\"mia_exposure_photographic\" ( \"film_iso\" 0, \"cm2_factor\" .25, "
      "\"burn_highlights\" 1, \"crush_blacks\" 0, \"gamma\" 1, \"f_number\" 2 )");
  EXPECT_NEAR(shader(Rgb(.8f, .4f, 2)).x, .2, 1e-6);
  EXPECT_NEAR(shader(Rgb(.8f, .4f, 2)).z, .5, 1e-6);
}

// acceptance: X6
TEST(LensShaders, VignettingFollowsTheCosineOfEachPixelsRay) {
  const Exposed shader(
      "\"mia_exposure_photographic\" ( \"film_iso\" 0, \"cm2_factor\" 1, "
      "\"vignetting\" 4, \"burn_highlights\" 1, \"crush_blacks\" 0, \"gamma\" 1 )");
  const Camera& camera = shader.world->camera;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const Camera::Ray ray =
          camera.ray(Vec2(static_cast<float>(x) + .5f, static_cast<float>(y) + .5f));
      // Focal 1, film 1 x .75: the point of the film, by hand.
      const double fx = (x + .5) / 16 - .5, fy = ((y + .5) / 12 - .5) * .75;
      const double cosine = 1 / std::sqrt(1 + fx * fx + fy * fy);
      EXPECT_NEAR(shader(Rgb(.5f), ray.cos_to_film).x, .5 * std::pow(cosine, 4), 1e-5);
    }
  EXPECT_FLOAT_EQ(shader(Rgb(.5f), .7f, true).x, .5f);
}

TEST(LensShaders, OptionsMayTurnLensShadersOff) {
  const testing::PreparedScene s(
      testing::scene_text("material \"m\" \"mib_illum_lambert\" ( ) end material", {},
                          "lens \"mia_exposure_simple\" ( )", "lens off"));
  ASSERT_TRUE(s.world);
  EXPECT_TRUE(s.world->lens.empty());
}

TEST(LensShaders, ShadersOfOtherRolesAreReportedAndSkipped) {
  const testing::PreparedScene s(testing::scene_text(
      "material \"m\" \"mib_illum_lambert\" ( ) end material", {}, "lens \"mib_light_point\" ( )"));
  EXPECT_NE(s.only("OR-RN-010"), nullptr) << s.messages();
  ASSERT_TRUE(s.world);
  EXPECT_TRUE(s.world->lens.empty());
}

}  // namespace lens_test
}  // namespace oriel
