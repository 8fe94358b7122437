// SPDX-License-Identifier: Apache-2.0
// The photographic exposure composed with its inverse.
#include "tone/exposure_reverse.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <vector>

#include "color/luminance.h"

namespace oriel::lens {
namespace exposure_reverse_test {

std::vector<PhotographicParameters> table() {
  std::vector<PhotographicParameters> all;
  for (const float burn : {1.0f, .5f, .1f, 0.0f})
    for (const float crush : {0.0f, .25f, 1.0f})
      for (const float vignetting : {0.0f, 3.0f})
        for (const float saturation : {1.0f, 1.4f})
          for (const float gamma : {1.0f, 2.2f}) {
            PhotographicParameters p;
            p.cm2_factor = 2;
            p.whitepoint = Rgb(1, .8f, .55f);
            p.f_number = 4;
            p.burn_highlights = burn;
            p.crush_blacks = crush;
            p.vignetting = vignetting;
            p.saturation = saturation;
            p.gamma = gamma;
            all.push_back(p);
          }
  return all;
}

const Rgb kShown[] = {Rgb(0),
                      Rgb(.02f),
                      Rgb(.2f),
                      Rgb(.5f),
                      Rgb(.9f),
                      Rgb(.98f),
                      Rgb(.1f, .5f, .9f),
                      Rgb(.9f, .5f, .1f),
                      Rgb(.6f, 0, .3f),
                      Rgb(.01f, .02f, .9f),
                      Rgb(.3f, .9f, .3f)};

// Display colours that the exposure can produce survive the round trip, with all steps enabled.
TEST(ReverseExposure, ComesBackThroughTheExposure) {
  for (const PhotographicParameters& p : table())
    for (const Rgb& shown : kShown)
      for (const float cosine : {1.0f, .8f}) {
        const Rgb light = ReversePhotographicExposure(p)(shown, cosine);
        const Rgb again = PhotographicExposure(p)(light, cosine);
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(again[k], shown[k], 1e-4f) << fmt::format(
              "burn {} crush {} vignetting {} saturation {} gamma {} colour {} {} {}",
              p.burn_highlights, p.crush_blacks, p.vignetting, p.saturation, p.gamma, shown.x,
              shown.y, shown.z);
      }
}

TEST(ReverseExposure, BringsBackTheLight) {
  PhotographicParameters p = table().front();
  p.burn_highlights = .3f;
  p.crush_blacks = .2f;
  p.saturation = .8f;
  p.gamma = 2.2f;
  const PhotographicExposure forward(p);
  const ReversePhotographicExposure reverse(p);
  for (const Rgb& light :
       {Rgb(30), Rgb(200, 300, 250), Rgb(900, 700, 500), Rgb(1e4f, 8e3f, 9e3f)}) {
    const Rgb back = reverse(forward(light));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[k], light[k], 2e-3f * light[k]);
  }
}

// Computed by hand: film_iso 0 and gain 1 leave gamma and burn, c = d / (1 - d).
TEST(ReverseExposure, ClosedForms) {
  PhotographicParameters p;
  p.film_iso = 0;
  p.vignetting = 0;
  p.crush_blacks = 0;
  p.gamma = 1;
  EXPECT_NEAR(ReversePhotographicExposure(p)(Rgb(.75f)).x, 3, 1e-5f);
  p.gamma = 2;
  EXPECT_NEAR(ReversePhotographicExposure(p)(Rgb(.5f)).x, 1.0f / 3, 1e-5f);
  p.gamma = 1;
  p.burn_highlights = 1;
  p.vignetting = 3;
  EXPECT_NEAR(ReversePhotographicExposure(p)(Rgb(.25f), .5f).x, 2, 1e-5f);
  p.film_iso = 100;
  p.vignetting = 0;
  EXPECT_NEAR(ReversePhotographicExposure(p)(Rgb(1)).x, 30720, 1);
}

TEST(ReverseExposure, WhatCannotHaveBeenShownIsFinite) {
  for (PhotographicParameters p : table())
    for (const float saturation : {p.saturation, 0.0f, .5f}) {
      p.saturation = saturation;
      for (const Rgb& c : {Rgb(1), Rgb(4, 0, 0), Rgb(-1), Rgb(std::nanf("")), Rgb(1, 1, 0)}) {
        const Rgb light = ReversePhotographicExposure(p)(c, 0);
        for (int k = 0; k < 3; ++k) {
          EXPECT_TRUE(std::isfinite(light[k]));
          EXPECT_GE(light[k], 0);
        }
      }
    }
  PhotographicParameters p;
  p.camera_shutter = 0;
  EXPECT_EQ(ReversePhotographicExposure(p)(Rgb(.5f)), Rgb(0));
}

}  // namespace exposure_reverse_test
}  // namespace oriel::lens
