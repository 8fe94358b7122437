// SPDX-License-Identifier: Apache-2.0
#include "output/picture_metadata.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "prepare/testing/prepared_scene.h"

namespace oriel {
namespace picture_metadata_test {

using testing::PreparedScene;

constexpr const char* kElements = "material \"m\" \"mib_illum_lambert\" ( ) end material ";

Mat4 matrix(const std::map<std::string, ExrValue>& all, const char* name) {
  const auto& values = std::get<ExrMatrix>(all.at(name));
  Mat4 m;
  std::copy(values.begin(), values.end(), m.getValue());
  return m;
}

/// OpenEXR's definition: v * M, divided by the last component.
Vec3 applied(const Vec3& p, const Mat4& m) {
  const float in[4] = {p.x, p.y, p.z, 1};
  float out[4] = {};
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) out[column] += in[row] * m[row][column];
  return Vec3(out[0], out[1], out[2]) / out[3];
}

// acceptance: M9
TEST(PictureMetadata, CameraMatricesProjectPointsToTheirPixels) {
  // Shifted film, and an orthographic camera.
  for (const char* camera : {"", "offset 3 -2", "focal infinity aperture 4"}) {
    const PreparedScene s(testing::scene_text(kElements, {}, camera));
    ASSERT_NE(s.world, nullptr) << s.messages();
    const Camera& c = s.world->camera;
    const auto all = picture_metadata(*s.world, {});
    const Mat4 to_ndc = matrix(all, "worldToNDC"), to_camera = matrix(all, "worldToCamera");
    for (const Vec2& raster : {Vec2(2, 3), Vec2(9.5f, 11)}) {
      const Camera::Ray ray = c.ray(raster);
      const Vec3 p = ray.origin + ray.direction * 4;
      const Vec3 ndc = applied(p, to_ndc);
      EXPECT_NEAR(ndc.x * static_cast<float>(c.width), raster.x, 1e-3f) << camera;
      EXPECT_NEAR((1 - ndc.y) * static_cast<float>(c.height), raster.y, 1e-3f) << camera;
      EXPECT_GT(applied(p, to_camera).z, 0) << "z points forward";
    }
  }
}

TEST(PictureMetadata, PhotographicExposuresAreStandardAttributes) {
  const PreparedScene s(testing::scene_text(
      kElements, {},
      "lens \"mia_exposure_photographic\" ( \"cm2_factor\" 1, \"film_iso\" 200, "
      "\"camera_shutter\" 50, \"f_number\" 5.6, \"whitepoint\" 1 .9 .8, \"burn_highlights\" .3 )"));
  ASSERT_NE(s.world, nullptr) << s.messages();
  const auto all = picture_metadata(*s.world, {});
  EXPECT_EQ(all.at("isoSpeed"), ExrValue(200.0f));
  EXPECT_EQ(all.at("aperture"), ExrValue(5.6f));
  EXPECT_EQ(all.at("expTime"), ExrValue(.02f));
  EXPECT_EQ(all.at("oriel.exposure"), ExrValue(std::string("mia_exposure_photographic")));
  EXPECT_EQ(all.at("oriel.exposure.whitepoint.g"), ExrValue(.9f));
  EXPECT_EQ(all.at("oriel.exposure.burn_highlights"), ExrValue(.3f));
}

TEST(PictureMetadata, DatesAreWrittenOnRequestAndFromTheEnvironment) {
  unsetenv("SOURCE_DATE_EPOCH");
  EXPECT_EQ(capture_date(false), std::nullopt);
  EXPECT_TRUE(capture_date(true).has_value());
  setenv("SOURCE_DATE_EPOCH", "86400", 1);
  EXPECT_EQ(capture_date(false), "1970:01:02 00:00:00");
  unsetenv("SOURCE_DATE_EPOCH");
}

}  // namespace picture_metadata_test
}  // namespace oriel
