// SPDX-License-Identifier: Apache-2.0
// Correction of exporter errors: polygons without area, invisible materials, text encodings.
#include "models/mend_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/testing/model_file.h"
#include "models/text_files.h"

namespace oriel::models {
namespace mend_model_test {

using testing::Folder;
using testing::imported;
using testing::set_in;

/// A Collada file of one triangle with a Phong material; effect: additional XML.
std::string collada(const std::string& effect, const std::string& color = ".8 .4 .2 1") {
  return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="c"><phong>
<diffuse><color>)" +
         color + "</color></diffuse>" + effect +
         R"(</phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="oak" name="oak"><instance_effect url="#e"/></material>
</library_materials>
<library_geometries><geometry id="g" name="seat"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y"
type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="chair">
<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="m"
target="#oak"/></technique_common></bind_material></instance_geometry></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

std::string utf16(const std::string& ascii, bool big_endian) {
  std::string text = big_endian ? "\xfe\xff" : "\xff\xfe";
  for (const char c : ascii) {
    if (big_endian) text += '\0';
    text += c;
    if (!big_endian) text += '\0';
  }
  return text;
}

std::ptrdiff_t count_of(const Diagnostics& diagnostics, const char* code) {
  return std::count_if(diagnostics.all().begin(), diagnostics.all().end(),
                       [&](const Diagnostic& d) { return d.code == code; });
}

TEST(ModelMend, ZeroAreaPolygonsAreDroppedWithOneNote) {
  const Folder folder;
  Diagnostics diagnostics;
  // A point three times, a line as a triangle, a line as a quad; a triangle and a concave quad.
  const auto scene = import_model(
      folder.write("m.obj",
                   "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 1 0\nv 0.1 0.1 0\no one\nf 1 1 1\n"
                   "f 1 2 3\nf 1 2 3 4\nf 1 2 5\no two\nf 2 3 2\nf 1 2 6 5\n"),
      {folder.path() / "t", folder.path()}, diagnostics);
  ASSERT_TRUE(scene);
  std::size_t polygons = 0;
  for (const scene::Element& e : scene->elements())
    if (const auto* object = std::get_if<scene::Object>(&e))
      polygons += object->groups[0].polygons.size();
  EXPECT_EQ(polygons, 2u);
  ASSERT_EQ(count_of(diagnostics, "OR-MD-009"), 1);
  EXPECT_NE(diagnostics.all()[0].message.find("dropped: 4"), std::string::npos);
}

TEST(ModelMend, FullyTransparentColladaIsOpaque) {
  const auto with = [&](const char* transparency) {
    return imported("m.dae", collada(std::string("<transparent><color>1 1 1 1</color>"
                                                 "</transparent><transparency><float>") +
                                     transparency + "</float></transparency>"));
  };
  const auto transparency = [&](const char* written) {
    const auto set = set_in(with(written), "oak", "transparency");
    return set.empty() ? 0 : set[0];
  };
  EXPECT_EQ(transparency("0"), 0);
  EXPECT_NEAR(transparency("0.25"), .75, 1e-6) << "what can be meant is taken as it stands";
  EXPECT_EQ(transparency("1"), 0);
}

TEST(ModelMend, ColladaSpotAnglesAreFullAngles) {
  std::string text = collada("");
  const auto insert = [&](const char* before, const char* what) {
    text.insert(text.find(before), what);
  };
  insert(
      "<library_effects>",
      "<library_lights><light id=\"l\" name=\"lamp\"><technique_common><spot><color>1 1 1</color>"
      "<falloff_angle>40</falloff_angle><falloff_exponent>0</falloff_exponent></spot>"
      "</technique_common></light></library_lights>");
  insert("</visual_scene>", "<node id=\"lamp\"><instance_light url=\"#l\"/></node>");
  const scene::Scene scene = imported("m.dae", text);
  const auto* lamp = scene.get<scene::Light>("lamp");
  ASSERT_TRUE(lamp && lamp->spread);
  EXPECT_NEAR(*lamp->spread, std::cos(20 * kPi / 180), 1e-5f);
}

TEST(ModelMend, CamerasInRadiansAreReported) {
  for (const bool radians : {true, false}) {
    std::string text = collada("");
    text.insert(
        text.find("<library_effects>"),
        std::string("<library_cameras><camera id=\"c\" name=\"eye\"><optics><technique_common>"
                    "<perspective><xfov>") +
            (radians ? "1" : "3") +
            "</xfov></perspective></technique_common></optics></camera></library_cameras>");
    text.insert(text.find("</visual_scene>"),
                "<node id=\"eye\"><instance_camera url=\"#c\"/></node>");
    const Folder folder;
    Diagnostics diagnostics;
    const auto scene = import_model(folder.write("m.dae", text),
                                    {folder.path() / "t", folder.path()}, diagnostics);
    ASSERT_TRUE(scene);
    const auto* camera = scene->get<scene::Camera>("eye");
    ASSERT_TRUE(camera);
    EXPECT_NEAR(2 * std::atan(*camera->aperture / 2 / *camera->focal), radians ? 1 : 3 * kPi / 180,
                1e-4f);
    EXPECT_EQ(count_of(diagnostics, "OR-MD-014"), radians ? 1 : 0);
  }
}

TEST(ModelTextFiles, Utf16BecomesUtf8) {
  // U+0041, U+00E9, U+20AC, U+1F600 and a lone surrogate; their UTF-8 by the table of Unicode 3-6.
  const std::string big("\xfe\xff\x00\x41\x00\xe9\x20\xac\xd8\x3d\xde\x00\xd8\x3d", 14);
  EXPECT_EQ(utf8_of(big), "A\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\xef\xbf\xbd");
  EXPECT_EQ(utf8_of(std::string("\xff\xfe\x41\x00\x42", 5)), "A\xef\xbf\xbd");
  EXPECT_EQ(utf8_of("\xef\xbb\xbfplain"), "\xef\xbb\xbfplain");
}

TEST(ModelTextFiles, ModelsMayBeInUtf16) {
  for (const bool big_endian : {false, true}) {
    const scene::Scene scene = imported("m.dae", utf16(collada(""), big_endian));
    EXPECT_NEAR(set_in(scene, "oak", "diffuse").at(1), .4, 1e-6);
    const scene::Scene obj =
        imported("m.obj", utf16("o seat\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", big_endian));
    EXPECT_TRUE(obj.get<scene::Object>("seat"));
  }
}

TEST(ModelTextFiles, ColladaMayHaveBlanksAroundNumbers) {
  EXPECT_EQ(without_blanks_before_numbers("<a> <b>\n\t-1 2 </b> x</a>"), "<a> <b>-1 2 </b> x</a>");
  const scene::Scene scene = imported("m.dae", collada("", "  .8 .4\n .2 1.0  "));
  EXPECT_NEAR(set_in(scene, "oak", "diffuse").at(1), .4, 1e-6);
}

}  // namespace mend_model_test
}  // namespace oriel::models
