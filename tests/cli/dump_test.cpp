// SPDX-License-Identifier: Apache-2.0
// oriel convert of a scene to JSON and arrays.
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace oriel {
namespace dump_test {

using nlohmann::json;

class SceneDumpTest : public ProgramTest {
 protected:
  json dump(const std::string& text) {
    write("scene.mi", text);
    const RunResult r = run({"convert", "scene.mi", "scene.json"});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    arrays_ = text_of(file("scene.bin"));
    return json::parse(text_of(file("scene.json")), nullptr, false);
  }
  template <class T>
  std::vector<T> array(const json& place) const {
    const std::size_t offset = place.at("offset"), count = place.at("count");
    EXPECT_LE(offset + count * sizeof(T), arrays_.size());
    std::vector<T> values(count);
    std::memcpy(values.data(), arrays_.data() + offset, count * sizeof(T));
    return values;
  }
  std::string arrays_;
};

constexpr const char* kScene = R"($include "base.mi"
$include "architectural.mi"
options "o" object space end options
shader "paint" "mia_material_x" ( "diffuse" 1 .5 .25, "refl_is_metal" on )
material "red" = "paint" end material
material "blue" "mia_material_x" ( "diffuse" = "paint.result" ) end material
color texture "wood" "missing/wood.png"
light "lamp" "physical_light" ( "color" 3 2 1 ) origin 0 0 0 direction 0 0 -1
  rectangle 2 0 0 0 1 0 end light
instance "lamp_inst" "lamp" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -5 1 end instance
object "square" visible on shadow on trace on tagged on group
  0.1 0.2 0.3 1 0 0 1 1 0 0 1 0  0 0 2
  v 0 n 4 v 1 n 4 v 2 n 4 v 3 n 4
  p 1 0 1 2 3 p 0 0 2 3 end group end object
instance "a" "square" material [ "red", "blue" ] end instance
instance "b" "square" material [ "red" ] shadow 4 reflection 4
  transform 1 0 0 0 0 1 0 0 0 0 1 0 -4 0 0 1 end instance
camera "c" focal 50 aperture 36 aspect 1.5 resolution 60 40 offset 3 -2 end camera
instance "c_inst" "c" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -9 1 end instance
instgroup "root" "a" "b" "lamp_inst" "c_inst" end instgroup
render "root" "c_inst" "o"
)";

TEST_F(SceneDumpTest, ContainsGeometryOnceAndEveryPlacement) {
  const json root = dump(kScene);
  ASSERT_TRUE(root.is_object());
  EXPECT_EQ(root["format"], "oriel-scene");
  EXPECT_EQ(root["binary"], "scene.bin");
  ASSERT_EQ(root["objects"].size(), 1u);
  const json& object = root["objects"][0];
  const auto points = array<float>(object["positions"]);
  ASSERT_EQ(points.size(), 12u);
  EXPECT_EQ(points[0], .1f);
  EXPECT_EQ(points[2], .3f);
  const auto normals = array<float>(object["normals"]);
  ASSERT_EQ(normals.size(), 12u);
  EXPECT_EQ(normals[2], 1) << "unit length";
  const auto corners = array<std::uint32_t>(object["triangles"]);
  ASSERT_EQ(corners.size(), 9u) << "a quad and a triangle";
  const auto slots = array<std::uint32_t>(object["slot"]);
  ASSERT_EQ(slots.size(), 3u);
  EXPECT_EQ(object["slots"][slots[0]]["label"], 1);
  EXPECT_EQ(object["slots"][slots[2]]["label"], 0);
  ASSERT_EQ(root["instances"].size(), 4u);
  EXPECT_EQ(root["instances"][0]["materials"], json({"red", "blue"}));
  EXPECT_EQ(root["instances"][1]["matrix"][12], 4) << "from local to world space";
  EXPECT_FALSE(root["instances"][0].contains("hidden_from"));
  EXPECT_EQ(root["render"]["gamma"], 1);
  EXPECT_EQ(root["instances"][1]["hidden_from"], json({"shadow", "reflection"}));
}

TEST_F(SceneDumpTest, FindsIncludesInGivenFolders) {
  ASSERT_TRUE(std::filesystem::create_directory(file("parts")));
  write("parts/square.mi", kScene);
  write("scene.mi", "$include \"square.mi\"\n");
  const RunResult r = run({"convert", "scene.mi", "scene.json", "-I", "parts"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  const json root = json::parse(text_of(file("scene.json")), nullptr, false);
  EXPECT_EQ(root["objects"].size(), 1u);
}

TEST_F(SceneDumpTest, KeepsCamerasLightsAndShaderCalls) {
  const json root = dump(kScene);
  ASSERT_TRUE(root.is_object());
  const json& camera = root["cameras"][0];
  EXPECT_EQ(camera["focal"], 50);
  EXPECT_EQ(camera["offset"], json({3, -2}));
  EXPECT_EQ(camera["resolution"], json({60, 40}));
  const json& light = root["lights"][0];
  EXPECT_EQ(light["area"]["shape"], "rectangle");
  EXPECT_EQ(light["area"]["numbers"], json({2, 0, 0, 0, 1, 0}));
  EXPECT_EQ(light["shaders"][0]["parameters"]["color"], json({3, 2, 1}));
  EXPECT_EQ(root["materials"][0]["shaders"][0]["reference"], "paint");
  EXPECT_EQ(root["materials"][1]["shaders"][0]["parameters"]["diffuse"]["shader"], "paint.result");
  EXPECT_EQ(root["shaders"]["paint"][0]["parameters"]["refl_is_metal"], true);
  EXPECT_EQ(root["textures"][0]["type"], "color texture");
  EXPECT_EQ(root["render"]["camera"], "c_inst");
}

TEST_F(SceneDumpTest, InvalidUtf8NamesAreReplaced) {
  const json root = dump(
      "options \"o\" object space end options\nobject \"\xff\xfe\" visible on group 0 0 0 1 0 0 0 "
      "1 0 "
      "v 0 v 1 v 2 p 0 1 2 end group end object\ninstance \"i\" \"\xff\xfe\" end instance\n"
      "camera \"c\" end camera instance \"ci\" \"c\" end instance\n"
      "instgroup \"r\" \"i\" \"ci\" end instgroup\nrender \"r\" \"ci\" \"o\"\n");
  ASSERT_TRUE(root.is_object());
  EXPECT_EQ(root["objects"].size(), 1u);
}

TEST_F(SceneDumpTest, FramesMoveInstances) {
  const json root = dump(std::string(kScene) + R"(
incremental instance "b" "square" material [ "red" ]
  transform 1 0 0 0 0 1 0 0 0 0 1 0 -6 0 0 1 end instance
render "root" "c_inst" "o"
incremental instance "c_inst" "c" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -7 1 end instance
render "root" "c_inst" "o"
)");
  ASSERT_TRUE(root.is_object());
  EXPECT_EQ(root["render"]["frames"], 3);
  std::map<std::string, std::vector<float>> along;
  for (const json& placed : root["instances"]) {
    if (!placed.contains("motion")) continue;
    const auto numbers = array<float>(placed["motion"]);
    ASSERT_EQ(numbers.size(), 48u);
    const std::size_t axis = placed["kind"] == "camera" ? 14 : 12;
    for (std::size_t frame = 0; frame < 3; ++frame)
      along[placed["name"]].push_back(numbers[16 * frame + axis]);
  }
  const std::map<std::string, std::vector<float>> expected = {{"b", {4, 6, 6}},
                                                              {"c_inst", {9, 9, 7}}};
  EXPECT_EQ(along, expected) << "instances without a change have no motion";
}

TEST_F(SceneDumpTest, FramesChangeElements) {
  const json root = dump(std::string(kScene) + R"(
incremental camera "c" focal 25 aperture 36 aspect 1.5 resolution 60 40 end camera
instance "c2_inst" "c" end instance
incremental instgroup "root" "a" "b" "lamp_inst" "c_inst" "c2_inst" end instgroup
render "root" "c2_inst" "o"
incremental shader "paint" "mia_material_x" ( "diffuse" 0 .5 .25 )
render "root" "c_inst" "o"
)");
  ASSERT_TRUE(root.is_object());
  const json& changes = root["changes"];
  EXPECT_EQ(changes.size(), 2u) << "the light and the materials do not change: " << changes.dump();
  const json& camera = changes["cameras"]["c"];
  ASSERT_EQ(camera.size(), 2u);
  EXPECT_EQ(camera[0]["frame"], 0);
  EXPECT_EQ(camera[0]["value"]["focal"], 50);
  EXPECT_EQ(camera[1]["frame"], 1);
  EXPECT_EQ(camera[1]["value"]["focal"], 25);
  const json& paint = changes["shaders"]["paint"];
  ASSERT_EQ(paint.size(), 2u);
  EXPECT_EQ(paint[1]["frame"], 2);
  EXPECT_EQ(paint[0]["value"][0]["parameters"]["diffuse"], json({1, .5, .25}));
  EXPECT_EQ(paint[1]["value"][0]["parameters"]["diffuse"], json({0, .5, .25}));
  EXPECT_EQ(root["render"]["cameras"], json({"c_inst", "c2_inst", "c_inst"}));
}

}  // namespace dump_test
}  // namespace oriel
