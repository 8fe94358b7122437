// SPDX-License-Identifier: Apache-2.0
// Visibility of the model for its cameras, and selection of the camera.
#include "models/camera_view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "models/testing/model_file.h"

namespace oriel::models {
namespace camera_view_test {

/// A square of side `size` about the origin, on z = 0, and cameras half a radian high and wide
/// that look along -z from (x, 0, z).
scene::Scene seen_from(float size, const std::vector<std::pair<float, float>>& eyes) {
  testing::Quad square;
  square.material = R"("doubleSided":true)";
  const std::string half = std::to_string(-size / 2), side = std::to_string(size);
  square.node =
      ",\"translation\":[" + half + "," + half + ",0],\"scale\":[" + side + "," + side + ",1]";
  std::string cameras;
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    const std::string number = std::to_string(i);
    square.scene += "," + std::to_string(i + 1);
    square.nodes += R"(,{"camera":)" + number + R"(,"name":"eye)" + number +
                    R"(","translation":[)" + std::to_string(eyes[i].first) + ",0," +
                    std::to_string(eyes[i].second) + "]}";
    cameras += std::string(i > 0 ? "," : "") +
               R"({"type":"perspective","perspective":{"aspectRatio":1,"yfov":0.5,"znear":0.1}})";
  }
  square.more = R"("cameras":[)" + cameras + "],";
  return testing::imported("m.gltf", square.text());
}

TEST(CameraView, PointsInTheFrameAreVisible) {
  const scene::Scene scene = seen_from(2, {{0, 5}, {2.2f, 5}, {2.4f, 5}, {0, -5}});
  EXPECT_TRUE(sees_model(scene, "eye0_inst"));
  // tan(.25) 5 = 1.277: the square's edge is 1.2 to the left, then 1.4.
  EXPECT_TRUE(sees_model(scene, "eye1_inst"));
  EXPECT_FALSE(sees_model(scene, "eye2_inst"));
  EXPECT_FALSE(sees_model(scene, "eye3_inst")) << "it is behind";
}

TEST(CameraView, ParallelCamerasSeePointsInFrontOfTheFilm) {
  scene::Scene scene = seen_from(2, {{0, 5}, {2.9f, 5}, {3.1f, 5}, {0, -5}});
  for (const char* name : {"eye0", "eye1", "eye2", "eye3"}) {
    auto* camera = scene.get<scene::Camera>(name);
    ASSERT_TRUE(camera) << name;
    camera->orthographic = true;
    camera->focal.reset();
    camera->aperture = 4;  // the square's edge is 1.9 to the left, then 2.1
  }
  EXPECT_TRUE(sees_model(scene, "eye0_inst"));
  EXPECT_TRUE(sees_model(scene, "eye1_inst"));
  EXPECT_FALSE(sees_model(scene, "eye2_inst"));
  EXPECT_FALSE(sees_model(scene, "eye3_inst")) << "it is behind";
}

TEST(CameraView, AWallFillsTheFrameWithItsCornersOutside) {
  const scene::Scene scene = seen_from(200, {{0, 5}, {99, -5}});
  EXPECT_TRUE(sees_model(scene, "eye0_inst"));
  EXPECT_FALSE(sees_model(scene, "eye1_inst"));
}

TEST(CameraView, FirstCameraThatSeesTheModelIsUsed) {
  scene::Scene scene = seen_from(2, {{9, 5}, {0, 5}, {0, 4}});
  Diagnostics diagnostics;
  EXPECT_TRUE(choose_camera(scene, {}, diagnostics));
  EXPECT_EQ(scene.renders.at(0).camera, "eye1_inst");
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].code, "OR-MD-011");
  scene::Scene good = seen_from(2, {{0, 5}, {9, 5}});
  Diagnostics none;
  EXPECT_TRUE(choose_camera(good, {}, none));
  EXPECT_EQ(good.renders.at(0).camera, "eye0_inst");
  EXPECT_TRUE(none.all().empty());
}

TEST(CameraView, GroundIsBelowCamerasUnderTheModel) {
  for (const float height : {2.0f, -2.0f}) {
    testing::Quad square;
    square.scene = "0,1";
    square.material = R"("doubleSided":true)";
    square.nodes =
        R"(,{"camera":0,"name":"eye","translation":[0,)" + std::to_string(height) + ",5]}";
    square.more = R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}],)";
    scene::Scene scene = testing::imported("m.gltf", square.text());
    add_daylight(scene, {});
    const float ground = scene.get<scene::Object>("ground")->groups[0].vectors[0].y;
    // The square is on y = 0.
    EXPECT_LT(ground, std::min(height, 0.0f));
    EXPECT_GT(ground, std::min(height, 0.0f) - .1f);
  }
}

TEST(CameraView, CameraIsAddedIfNoneSeesTheModel) {
  scene::Scene scene = seen_from(2, {{9, 5}, {0, -5}});
  Diagnostics diagnostics;
  EXPECT_FALSE(choose_camera(scene, {}, diagnostics));
  EXPECT_EQ(diagnostics.all().size(), 1u);
  EXPECT_TRUE(sees_model(scene, scene.renders.at(0).camera));
  for (const char* kept : {"eye0_inst", "eye1_inst"}) EXPECT_TRUE(scene.find(kept)) << kept;
}

}  // namespace camera_view_test
}  // namespace oriel::models
