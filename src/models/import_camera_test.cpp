// SPDX-License-Identifier: Apache-2.0
// Angles of cameras of glTF, Collada, FBX and 3DS.
#include <cmath>

#include "models/testing/fbx_file.h"
#include "models/testing/gltf_file.h"
#include "models/text_files.h"

namespace oriel::models {
namespace import_camera_test {

using testing::GltfFile;
using testing::json;
using testing::Made;

constexpr double kDegrees = 180 / kPi;
/// Relative tolerance of angles.
constexpr double kTolerance = 1e-3;

/// Full angles of a camera in degrees.
struct Angles {
  double across = 0, upright = 0;
};
Angles angles_of(const Made& made, const char* name = "eye") {
  const auto* camera = made.scene ? made.scene->get<scene::Camera>(name) : nullptr;
  if (!camera || !camera->focal) {
    ADD_FAILURE() << name;
    return {};
  }
  const double half = *camera->aperture / 2 / *camera->focal;
  return {2 * std::atan(half) * kDegrees, 2 * std::atan(half / *camera->aspect) * kDegrees};
}

void import_with(Made& made, const std::string& content, const std::string& name,
                 std::optional<float> aspect) {
  ImportOptions options{made.folder.path() / "t", made.folder.path(), {}, aspect};
  made.scene = import_model(made.folder.write(name, content), options, made.diagnostics);
}

GltfFile gltf_camera(double yfov, double aspect) {
  GltfFile file;
  file.add_triangle();
  file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", yfov}}}}};
  if (aspect > 0) file.root["cameras"][0]["perspective"]["aspectRatio"] = aspect;
  file.root["nodes"].push_back({{"name", "eye"}, {"camera", 0}, {"translation", {1, 2, 3}}});
  file.root["scenes"][0]["nodes"].push_back(1);
  return file;
}

// A 20 mm lens on full-frame film, 24 mm high: vertical angle 61.93 degrees.
// acceptance: M2
TEST(ModelCamera, GltfKeepsItsVerticalAngle) {
  const double yfov = 2 * std::atan(12. / 20);
  for (const double aspect : {1., 1.5, 2.35, 0.})
    for (const double picture : {0., 1., 2.}) {
      Made made;
      import_with(made, gltf_camera(yfov, aspect).text(), "m.gltf",
                  picture > 0 ? std::optional(static_cast<float>(picture)) : std::nullopt);
      const double shape = picture > 0 ? picture : aspect > 0 ? aspect : 1.5;
      const Angles found = angles_of(made);
      EXPECT_NEAR(found.upright, yfov * kDegrees, kTolerance * 61.93) << aspect << ' ' << picture;
      EXPECT_NEAR(std::tan(found.across / 2 / kDegrees), .6 * shape, kTolerance * .6 * shape);
    }
}

TEST(ModelCamera, SharedCamerasAndLightsAreInstancedPerNode) {
  GltfFile file = gltf_camera(.5, 1);
  for (const double x : {7., 8.})
    file.root["nodes"].push_back({{"name", "eye"}, {"camera", 0}, {"translation", {x, 0, 0}}});
  for (const double x : {1., 2., 3.})
    file.root["nodes"].push_back(
        {{"translation", {x, 0, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  file.root["extensions"]["KHR_lights_punctual"]["lights"] =
      json::array({{{"type", "point"}}, {{"type", "point"}, {"name", "unused"}}});
  for (int node = 2; node < 7; ++node) file.root["scenes"][0]["nodes"].push_back(node);
  Made made;
  made.import(file.text());
  ASSERT_TRUE(made.scene);
  std::vector<float> cameras, lights;
  for (const std::string& member : made.scene->get<scene::InstanceGroup>(kRootGroup)->members) {
    const auto* placed = made.scene->get<scene::Instance>(member);
    const float x = placed->transform.value_or(Mat4()).inverse().translation().x;
    if (made.scene->get<scene::Camera>(placed->element)) cameras.push_back(x);
    if (made.scene->get<scene::Light>(placed->element)) lights.push_back(x);
  }
  std::sort(cameras.begin(), cameras.end());
  std::sort(lights.begin(), lights.end());
  EXPECT_EQ(cameras, (std::vector<float>{1, 7, 8}));
  EXPECT_EQ(lights, (std::vector<float>{1, 2, 3}));
}

std::string collada_camera(const std::string& angles) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" )"
         R"(version="1.4.1"><asset><up_axis>Y_UP</up_axis></asset><library_cameras><camera id="c">)"
         "<optics><technique_common><perspective>" +
         angles +
         R"(<znear>.1</znear><zfar>100</zfar></perspective></technique_common></optics></camera>)"
         R"(</library_cameras><library_geometries><geometry id="g"><mesh><source id="p">)"
         R"(<float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>)"
         R"(<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param )"
         R"(name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>)"
         R"(</source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>)"
         R"(<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p>)"
         R"(</triangles></mesh></geometry></library_geometries><library_visual_scenes>)"
         R"(<visual_scene id="s"><node id="eye" name="eye"><instance_camera url="#c"/></node>)"
         R"(<node id="n"><instance_geometry url="#g"/></node></visual_scene>)"
         R"(</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

// Two of three numbers define the view of a Collada camera.
// acceptance: M2
TEST(ModelCamera, ColladaKeepsTheAnglesThatItDefines) {
  const double y = 40, half = std::tan(20 / kDegrees);
  for (const double aspect : {1., 1.5, 2.35}) {
    const double x = 2 * std::atan(half * aspect) * kDegrees;
    const std::string across = fmt::format("<xfov sid=\"X\"> {} </xfov>", x);
    const std::string upright = fmt::format("<yfov sid=\"Y\">{}</yfov>", y);
    const std::string shape = fmt::format("<aspect_ratio>{}</aspect_ratio>", aspect);
    for (const std::string& angles :
         {across + shape, across + upright, upright + shape, across + upright + shape}) {
      Made made;
      import_with(made, collada_camera(angles), "m.dae", std::nullopt);
      EXPECT_NEAR(angles_of(made).across, x, kTolerance * x) << angles;
      EXPECT_NEAR(angles_of(made).upright, y, kTolerance * y) << angles;
    }
    Made made;
    import_with(made, collada_camera(upright), "m.dae", static_cast<float>(aspect));
    EXPECT_NEAR(angles_of(made).across, x, kTolerance * x) << "picture of " << aspect;
    EXPECT_NEAR(angles_of(made).upright, y, kTolerance * y) << "picture of " << aspect;
  }
}

// FBX: FieldOfView is the horizontal angle.
// acceptance: M2
TEST(ModelCamera, FbxKeepsItsHorizontalAngle) {
  for (const double aspect : {1., 1.5, 2.35}) {
    testing::FbxFile file;
    file.camera = "P: \"Visibility\", \"Visibility\", \"\", \"A\",1\n";
    file.lens = fmt::format(
        "P: \"FieldOfView\", \"FieldOfView\", \"\", \"A\",70\nP: \"AspectWidth\", \"double\", "
        "\"Number\", \"\",{}\nP: \"AspectHeight\", \"double\", \"Number\", \"\",100\n",
        aspect * 100);
    Made made;
    import_with(made, file.text(), "m.fbx", std::nullopt);
    const double upright = 2 * std::atan(std::tan(35 / kDegrees) / aspect) * kDegrees;
    EXPECT_NEAR(angles_of(made).across, 70, kTolerance * 70);
    EXPECT_NEAR(angles_of(made).upright, upright, kTolerance * upright);
  }
}

}  // namespace import_camera_test
}  // namespace oriel::models
