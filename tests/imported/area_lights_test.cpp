// SPDX-License-Identifier: Apache-2.0
// Area lights of Collada and FBX files: lux on a white floor, compared with closed forms.
#include <fmt/format.h>

#include <fstream>

#include "mi/writer.h"
#include "models/daylight.h"
#include "models/light_units.h"
#include "models/testing/fbx_file.h"
#include "models/testing/model_file.h"
#include "support/probe.h"

namespace oriel {
namespace area_lights_test {

using models::testing::Folder;
using testing::Measured;
using testing::Probe;

constexpr float kWatts = 100, kHeight = 3;

/// A floor at z = 0 and a light above it that shines down, as Blender writes both.
std::string collada(const std::string& shape, const std::string& matrix) {
  return fmt::format(R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><contributor><authoring_tool>Blender 3.4.1</authoring_tool></contributor>
    <unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
  <library_lights><light id="Panel-light" name="Panel"><technique_common><point>
    <color sid="color">{0} {0} {0}</color></point></technique_common>
    <extra><technique profile="blender"><type sid="type" type="int">4</type>
    {1}</technique></extra></light></library_lights>
  <library_effects><effect id="e"><profile_COMMON><technique sid="common"><lambert>
    <diffuse><color>1 1 1 1</color></diffuse></lambert></technique></profile_COMMON></effect>
  </library_effects>
  <library_materials><material id="m" name="m"><instance_effect url="#e"/></material>
  </library_materials>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="12">-5 -5 0 5 -5 0 5 5 0 -5 5 0</float_array>
      <technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/>
      <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
    </source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles material="m" count="2"><input semantic="VERTEX" source="#v" offset="0"/>
    <p>0 1 2 0 2 3</p></triangles></mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s">
    <node id="f"><instance_geometry url="#g"><bind_material><technique_common>
      <instance_material symbol="m" target="#m"/></technique_common></bind_material>
      </instance_geometry></node>
    <node id="Panel" name="Panel"><matrix>{2}</matrix><instance_light url="#Panel-light"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene></COLLADA>)",
                     kWatts, shape, matrix);
}

std::string blender_shape(int shape, float width, float height) {
  return fmt::format(
      R"(<area_shape sid="area_shape" type="int">{}</area_shape>
      <area_size sid="area_size" type="float">{}</area_size>
      <area_sizey sid="area_sizey" type="float">{}</area_sizey>)",
      shape, width, height);
}

/// Light of a model on its floor at x and y, in lux.
double lux(const std::string& text, const char* name, float x, float y) {
  const Folder folder;
  Diagnostics diagnostics;
  auto scene = models::import_model(folder.write(name, text), {folder.path() / "t", folder.path()},
                                    diagnostics);
  EXPECT_TRUE(scene);
  models::add_camera(*scene, {});
  const std::string file = (folder.path() / "m.mi").string();
  EXPECT_TRUE(mi::write_scene(*scene, file, diagnostics));
  std::ifstream read(file);
  const std::string mi{std::istreambuf_iterator<char>(read), {}};
  // Scenes have y up: z of the file is y, y is -z.
  const Vec3 place(x, 0, -y), up(0, 1, 0);
  const Measured m = Probe(mi).direct_only().ray(place + up, -up, 4096);
  return m.mean.x * double{kPi};
}

/// Lux per cd/m2 below a corner of a rectangle of a x b at a height, facing down.
double corner(double a, double b, double h) {
  const auto part = [&](double x, double y) {
    return x / std::sqrt(x * x + h * h) * std::atan(y / std::sqrt(x * x + h * h));
  };
  return (part(a, b) + part(b, a)) / 2;
}

constexpr double kLumens = double{kWatts} * models::kLumensOfWatt;
constexpr const char* kDown = "1 0 0 0 0 1 0 0 0 0 1 3 0 0 0 1";

TEST(AreaLightsOfModels, ColladaHasTheSizesThatBlenderWrites) {
  const std::string panel = collada(blender_shape(1, 2, .5f), kDown);
  const double luminance = kLumens / (M_PI * 2 * .5);
  const double below = luminance * 4 * corner(1, .25, kHeight);
  EXPECT_NEAR(lux(panel, "m.dae", 0, 0) / below, 1, .01);
  // Below the ends of both axes; the light is four times as long along x.
  const double along_x = luminance * 2 * corner(2, .25, kHeight);
  EXPECT_NEAR(lux(panel, "m.dae", 1, 0) / along_x, 1, .01);
  const double along_y = luminance * 2 * (corner(1, 1.25, kHeight) - corner(1, .75, kHeight));
  EXPECT_NEAR(lux(panel, "m.dae", 0, 1) / along_y, 1, .01);
  // A square takes one size, a disc its diameter.
  const double square = kLumens / (M_PI * 4) * 4 * corner(1, 1, kHeight);
  EXPECT_NEAR(lux(collada(blender_shape(0, 2, .5f), kDown), "m.dae", 0, 0) / square, 1, .01);
  const double disc = kLumens / (M_PI * M_PI) * M_PI / (1 + kHeight * kHeight);
  EXPECT_NEAR(lux(collada(blender_shape(4, 2, .5f), kDown), "m.dae", 0, 0) / disc, 1, .01);
}

TEST(AreaLightsOfModels, ShineToOneSide) {
  // Turned by half a turn about x: upward.
  const std::string up = "1 0 0 0 0 -1 0 0 0 0 -1 3 0 0 0 1";
  EXPECT_EQ(lux(collada(blender_shape(1, 2, .5f), up), "m.dae", 0, 0), 0);
  EXPECT_EQ(lux(collada(blender_shape(4, 2, .5f), up), "m.dae", 0, 0), 0);
}

TEST(AreaLightsOfModels, PointLightsStayPoints) {
  std::string point = collada(blender_shape(1, 2, .5f), kDown);
  point.replace(point.find(">4</type>"), 9, ">0</type>");
  const double below = kLumens / (4 * M_PI) / (kHeight * kHeight);
  EXPECT_NEAR(lux(point, "m.dae", 0, 0) / below, 1, .01);
}

TEST(AreaLightsOfModels, OfFbxAreSquaresOfTheirNodes) {
  models::testing::FbxFile file;
  file.sun = models::testing::property("Lcl Scaling", {3, 1, 1});
  file.light = "P: \"LightType\", \"enum\", \"\", \"\",3\n";
  const Folder folder;
  Diagnostics diagnostics;
  const auto scene = models::import_model(folder.write("m.fbx", file.text()),
                                          {folder.path() / "t", folder.path()}, diagnostics);
  ASSERT_TRUE(scene);
  int areas = 0;
  for (const scene::Element& element : scene->elements())
    if (const auto* light = std::get_if<scene::Light>(&element); light && light->area) {
      ++areas;
      EXPECT_EQ(light->area->keyword, "rectangle");
      ASSERT_EQ(light->area->values.size(), 6u);
    }
  EXPECT_EQ(areas, 1);
  bool said = false;
  for (const Diagnostic& d : diagnostics.all()) said |= d.code == "OR-MD-025";
  EXPECT_TRUE(said);
}

}  // namespace area_lights_test
}  // namespace oriel
