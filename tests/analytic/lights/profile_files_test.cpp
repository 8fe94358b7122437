// SPDX-License-Identifier: Apache-2.0
// Light profiles of manufacturers, compared with their tables integrated by hand. Origin of the
// files: tests/data/ies/NOTICE.txt.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "photometry/profile_file.h"
#include "support/directions.h"

namespace oriel::photometry {
namespace profile_files_test {

using testing::luminaire_direction;

ProfileData read(const std::string& name) {
  return read_profile(std::string(ORIEL_TEST_DATA) + "/ies/" + name);
}

// The sums of (integral of I sin v dv) over the tables, exact for intensities that are linear
// between their angles, were worked out apart from this project.
constexpr float kDummyFlux = 904.52453f, kQuadrantFlux = 143.66056f;

// acceptance: H6
TEST(ProfileFiles, OnePlaneOfCandelaIsTurnedAboutTheAxis) {
  const ProfileData data = read("dummy.ies");
  const LightProfile profile(data.table);
  EXPECT_EQ(data.report.version, "LM-63-1995");
  EXPECT_FALSE(data.report.lamp_lumens.has_value()) << "absolute: -1 lumens";
  EXPECT_FLOAT_EQ(data.report.watts, 15);
  EXPECT_NEAR(profile.flux(), kDummyFlux, 1e-4f * kDummyFlux);
  EXPECT_NEAR(profile.peak(), 2200, 1e-2f);
  for (float h = 0; h < 360; h += 45) {
    EXPECT_NEAR(profile.evaluate(luminaire_direction(10, h)), 1328.4f, .05f) << h;
    EXPECT_NEAR(profile.evaluate(luminaire_direction(11.25f, h)), (1328.4f + 1115.1f) / 2, .5f)
        << h;
    EXPECT_EQ(profile.evaluate(luminaire_direction(120, h)), 0) << "nothing upward, " << h;
  }
}

// acceptance: H6
TEST(ProfileFiles, BothFormatsOfOneLuminaireAreTheSame) {
  // 1000 cd per 1000 lm, for a flux of 1000 lm: the numbers in both files are candela.
  const ProfileData data = read("dummy.ldt");
  const LightProfile a(read("dummy.ies").table), b(data.table);
  EXPECT_EQ(data.report.format, "EULUMDAT");
  EXPECT_NEAR(b.flux(), kDummyFlux, 1e-4f * kDummyFlux);
  for (float v = 0; v <= 180; v += 3.7f)
    for (float h = 0; h < 360; h += 60)
      EXPECT_NEAR(a.evaluate(luminaire_direction(v, h)), b.evaluate(luminaire_direction(v, h)), .2f)
          << v << ' ' << h;
}

// acceptance: H6
TEST(ProfileFiles, AQuadrantIsMirroredIntoTheOthers) {
  const ProfileData data = read("quadrant.ies");
  const LightProfile profile(data.table);
  EXPECT_NEAR(profile.flux(), kQuadrantFlux, 1e-4f * kQuadrantFlux);
  // The table's numbers times the multiplier.
  EXPECT_NEAR(profile.peak(), 1730 * .025f, 1e-3f);
  EXPECT_NEAR(profile.evaluate(luminaire_direction(50, 0)), 670 * .025f, 5e-3f);
  EXPECT_NEAR(profile.evaluate(luminaire_direction(50, 90)), 825 * .025f, 5e-3f);
  EXPECT_NEAR(profile.evaluate(luminaire_direction(110, 45)), 190 * .025f, 5e-3f);
  EXPECT_NEAR(profile.evaluate(luminaire_direction(180, 0)), 935 * .025f, 5e-3f);
  for (float v = 5; v < 180; v += 12.5f)
    for (float h = 0; h <= 90; h += 15)
      for (const float other : {180 - h, 180 + h, 360 - h})
        EXPECT_NEAR(profile.evaluate(luminaire_direction(v, h)),
                    profile.evaluate(luminaire_direction(v, other)), 5e-3f)
            << v << ' ' << h << ' ' << other;
}

}  // namespace profile_files_test
}  // namespace oriel::photometry
