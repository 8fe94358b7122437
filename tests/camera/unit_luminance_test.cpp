// SPDX-License-Identifier: Apache-2.0
#include "render/unit_luminance.h"

#include <gtest/gtest.h>

#include "prepare/testing/prepared_scene.h"

namespace oriel {
namespace unit_luminance_test {

using testing::PreparedScene;

const std::string kSky = "environment \"mia_physicalsky\" ( \"rgb_unit_conversion\" ";

struct Unit : PreparedScene {
  UnitLuminance unit;
  explicit Unit(const std::string& camera)
      : PreparedScene(testing::scene_text("material \"m\" \"mib_illum_lambert\" ( ) end material ",
                                          {}, camera)) {
    unit = unit_luminance(*world, {}, diagnostics);
  }
};

TEST(UnitLuminance, IsOneByDefault) {
  const Unit u("");
  EXPECT_EQ(u.unit.cd_m2, 1);
  EXPECT_EQ(u.unit.by, "");
}

TEST(UnitLuminance, MatchesTheExposureShader) {
  const Unit u("lens \"mia_exposure_photographic\" ( \"cm2_factor\" 12.5 )");
  EXPECT_EQ(u.unit.cd_m2, 12.5f);
  EXPECT_EQ(u.unit.by, "mia_exposure_photographic");
  EXPECT_EQ(Unit("lens \"mia_exposure_photographic\" ( \"film_iso\" 0, \"cm2_factor\" 5 )").unit.by,
            "");
}

TEST(UnitLuminance, MatchesTheSkyWithoutAnExposure) {
  const Unit lux(kSky + "1 1 1 )");
  EXPECT_NEAR(lux.unit.cd_m2, 1 / kPi, 1e-6f);
  EXPECT_EQ(lux.unit.by, "mia_physicalsky");
  EXPECT_NEAR(Unit(kSky + "0 0 0 )").unit.cd_m2, 80000 / kPi, .01f);
}

TEST(UnitLuminance, ConflictsAreReported) {
  const std::string exposure = "lens \"mia_exposure_photographic\" ( \"cm2_factor\" 1 ) ";
  EXPECT_EQ(Unit(exposure + kSky + ".318 .318 .318 )").messages(), "");
  const Unit u(exposure + kSky + "1 1 1 )");
  EXPECT_EQ(u.unit.cd_m2, 1);
  EXPECT_NE(u.only("OR-RN-045"), nullptr) << u.messages();
}

}  // namespace unit_luminance_test
}  // namespace oriel
