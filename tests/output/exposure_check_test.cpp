// SPDX-License-Identifier: Apache-2.0
#include "output/exposure_check.h"

#include <gtest/gtest.h>

#include "output/camera_output.h"
#include "prepare/testing/prepared_scene.h"

namespace oriel {
namespace exposure_check_test {

using testing::PreparedScene;

/// Diagnostics of a scene with the output file `file`.
struct Checked : PreparedScene {
  Checked(const std::string& camera_statements, const std::string& elements = {},
          const std::string& members = {}, const std::string& options = {},
          const std::string& file = "a.png")
      : PreparedScene(
            testing::scene_text("material \"m\" \"mib_illum_lambert\" ( ) end material " + elements,
                                members, camera_statements, options)) {
    const scene::Camera* camera = find_camera(scene, scene.renders.back());
    PictureFile picture = picture_file(file);
    picture.shaders = camera_output_shaders(*camera, scene, builtin_shaders(), *world, diagnostics);
    check_exposures(*world, {picture}, diagnostics);
  }
  std::string message(std::string_view code) const {
    const Diagnostic* d = only(code);
    return d ? d->message + " / " + d->hint : "";
  }
};

const std::string kSimple = "\"mia_exposure_simple\" ( )";
const std::string kGamma22 = "gamma 2.2";

TEST(ExposureCheck, DoubleGammaIsReportedForLensAndOutput) {
  for (const char* role : {"lens ", "output "}) {
    const Checked c(role + kSimple, {}, {}, kGamma22);
    EXPECT_NE(c.only("OR-RN-041"), nullptr) << role << c.messages();
    EXPECT_TRUE(Checked(role + kSimple).diagnostics.all().empty());
    EXPECT_TRUE(
        Checked(std::string(role) + "\"mia_exposure_simple\" ( \"gamma\" 1 )", {}, {}, kGamma22)
            .diagnostics.all()
            .empty());
    // Gamma of the options does not act on floats: the shader's alone does.
    EXPECT_EQ(Checked(role + kSimple, {}, {}, kGamma22, "a.exr").only("OR-RN-041"), nullptr);
  }
}

TEST(ExposureCheck, FloatFilesOfMappedColoursAreReportedOnce) {
  for (const char* role : {"lens ", "output "}) {
    Checked c(role + kSimple, {}, {}, {}, "a.exr");
    ASSERT_NE(c.only("OR-RN-066"), nullptr) << c.messages();
    EXPECT_NE(c.message("OR-RN-066").find("--linear"), std::string::npos);
    PictureFile again = picture_file("b.exr");
    check_exposures(*c.world, {again}, c.diagnostics);
    EXPECT_NE(c.only("OR-RN-066"), nullptr) << "said twice";
    EXPECT_EQ(Checked(role + kSimple, {}, {}, {}, "a.png").only("OR-RN-066"), nullptr);
  }
  EXPECT_EQ(Checked("", {}, {}, {}, "a.exr").messages(), "");
}

TEST(ExposureCheck, LensAndOutputCopiesApplyGammaTwiceWithoutSideChannel) {
  EXPECT_NE(Checked("lens " + kSimple + " output " + kSimple).only("OR-RN-041"), nullptr);
  const std::string side =
      "\"mia_exposure_photographic\" ( \"film_iso\" 0, \"side_channel_mode\" 1, \"side_channel\" "
      "\"s\" )";
  EXPECT_EQ(Checked("lens " + side + " output " + side).messages(), "");
}

std::string sun(const char* unit) {
  return std::string("light \"sun\" \"mia_physicalsun\" ( \"rgb_unit_conversion\" ") + unit +
         " ) direction 0 -1 0 end light instance \"sun_i\" \"sun\" end instance";
}
std::string photographic(const char* parameters) {
  return std::string("lens \"mia_exposure_photographic\" ( ") + parameters + " )";
}

TEST(ExposureCheck, UnitsOtherThanCandelaPerSquareMetreAreReported) {
  const std::string members = "\"sun_i\"";
  const Checked c(photographic("\"cm2_factor\" 1"), sun(".0001 .0001 .0001"), members);
  ASSERT_NE(c.only("OR-RN-044"), nullptr) << c.messages();
  // log2(.318 / .0001) stops; the factor that would fit.
  EXPECT_NE(c.message("OR-RN-044").find("11.6 stops too dark"), std::string::npos)
      << c.message("OR-RN-044");
  EXPECT_NE(c.message("OR-RN-044").find("3183"), std::string::npos) << c.message("OR-RN-044");
  for (const auto& [parameters, unit] :
       {std::pair("\"cm2_factor\" 1", ".318 .318 .318"), std::pair("\"cm2_factor\" 1", "1 1 1"),
        std::pair("\"cm2_factor\" 3183", ".0001 .0001 .0001"),
        std::pair("\"film_iso\" 0, \"cm2_factor\" 1", ".0001 .0001 .0001"),
        // 0 0 0 means one over 80000 lux.
        std::pair("\"cm2_factor\" 25465", "0 0 0")})
    EXPECT_EQ(Checked(photographic(parameters), sun(unit), members).messages(), "") << parameters;
  EXPECT_NE(Checked(photographic("\"cm2_factor\" 477"), sun(".318 .318 .318"), members)
                .message("OR-RN-044")
                .find("bright"),
            std::string::npos);
}

TEST(ExposureCheck, ScenesWithoutSunOrSkyMayHaveAnyUnit) {
  EXPECT_EQ(Checked(photographic("\"cm2_factor\" 1")).messages(), "");
}

}  // namespace exposure_check_test
}  // namespace oriel
