// SPDX-License-Identifier: Apache-2.0
// Test support: a glass pane in each model format.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "mi/writer.h"
#include "models/shader_call.h"
#include "models/testing/fbx_file.h"
#include "models/testing/gltf_file.h"

namespace oriel::pane_models {

using models::testing::GltfFile;
using models::testing::json;

/// Illuminance of the sun on a surface that faces it.
inline constexpr float kSunLux = 10000;
/// Relative tolerance of illuminances.
inline constexpr double kTolerance = .03;
/// What an interface of index 1.5 transmits of perpendicular light.
inline constexpr double kClear = .96;

/// A pane from -5 to 5 in x and y, `thickness` high; a single quad for thickness 0.
struct PaneMesh {
  std::vector<float> points;
  std::vector<std::uint16_t> quads;  ///< four corners each, counter-clockwise from outside

  explicit PaneMesh(float thickness) {
    for (const float z : {0.0f, thickness})
      for (const auto& [x, y] : {std::pair(-5.f, -5.f), {5.f, -5.f}, {5.f, 5.f}, {-5.f, 5.f}})
        points.insert(points.end(), {x, y, z});
    quads = {0, 1, 2, 3};
    if (thickness > 0)
      quads = {3, 2, 1, 0, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
    if (!(thickness > 0)) points.resize(12);
  }
};

/// A glTF pane of that material with coordinates (.5, .5) everywhere.
inline GltfFile gltf_pane(const json& material, float thickness) {
  const PaneMesh mesh(thickness);
  GltfFile file;
  file.primitive()["attributes"]["POSITION"] =
      file.add<float>(mesh.points, models::testing::kFloat, "VEC3", 3);
  file.primitive()["attributes"]["TEXCOORD_0"] = file.add<float>(
      std::vector<float>(mesh.points.size() / 3 * 2, .5f), models::testing::kFloat, "VEC2", 2);
  std::vector<std::uint16_t> triangles;
  for (std::size_t i = 0; i < mesh.quads.size(); i += 4)
    for (const std::size_t k : {0, 1, 2, 0, 2, 3}) triangles.push_back(mesh.quads[i + k]);
  file.primitive()["indices"] =
      file.add<std::uint16_t>(triangles, models::testing::kUnsignedShort, "SCALAR", 1);
  file.material() = material;
  file.material()["name"] = "pane";
  file.root["images"] = {{{"uri", "t.png"}}};
  file.root["textures"] = {{{"source", 0}}};
  return file;
}

inline json transmitting(double transmission, json more = json::object(), double base = 1) {
  json material = {{"pbrMetallicRoughness",
                    {{"metallicFactor", 0},
                     {"roughnessFactor", 0},
                     {"baseColorFactor", {base, base, base, 1}}}}};
  more["KHR_materials_transmission"]["transmissionFactor"] = transmission;
  material["extensions"] = more;
  return material;
}

inline json covering(const char* mode, double alpha, bool textured = false) {
  json material = {
      {"alphaMode", mode},
      {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorFactor", {.5, .5, .5, alpha}}}}};
  if (textured) material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  return material;
}

inline void add_sun(scene::Scene& scene, const Vec3& to_sun) {
  scene::Light sun;
  sun.name = "test_sun";
  models::ShaderCall call("mib_light_infinite");
  call.set("color", Vec3(kSunLux / kPi)).set("shadow", true);
  sun.shaders = {call.use()};
  sun.direction = -to_sun;
  scene::Instance instance;
  instance.name = "test_sun_inst";
  instance.element = sun.name;
  scene.add(std::move(sun));
  scene.get<scene::InstanceGroup>(models::kRootGroup)->members.push_back(instance.name);
  scene.add(std::move(instance));
}

/// The scene as it is written for users.
inline std::string text_of(models::testing::Made& made) {
  const std::string path = (made.folder.path() / "m.mi").string();
  EXPECT_TRUE(mi::write_scene(*made.scene, path, made.diagnostics));
  for (const Diagnostic& d : made.diagnostics.all())
    if (d.severity >= Severity::Warning) ADD_FAILURE() << made.diagnostics.format(d);
  std::ifstream read(path);
  std::string text{std::istreambuf_iterator<char>(read), {}};
  // The probe's text has no folder.
  const std::string from = "\"t.png\"";
  for (auto at = text.find(from); at != text.npos; at = text.find(from, at + 1))
    text.replace(at, from.size(), fmt::format("\"{}\"", (made.folder.path() / "t.png").string()));
  return text;
}

inline std::string obj_pane(float thickness) {
  const PaneMesh mesh(thickness);
  std::string text = "mtllib m.mtl\n";
  for (std::size_t i = 0; i < mesh.points.size(); i += 3)
    text += fmt::format("v {} {} {}\n", mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]);
  text += "vt 0.5 0.5\nusemtl pane\n";
  for (std::size_t i = 0; i < mesh.quads.size(); i += 4)
    text += fmt::format("f {}/1 {}/1 {}/1 {}/1\n", mesh.quads[i] + 1, mesh.quads[i + 1] + 1,
                        mesh.quads[i + 2] + 1, mesh.quads[i + 3] + 1);
  return text;
}

/// `surface`: children of the effect's `<lambert>`.
inline std::string collada_pane(const std::string& surface, float thickness) {
  const PaneMesh mesh(thickness);
  std::string counts, indices;
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    if (i % 4 == 0) counts += "4 ";
    indices += fmt::format("{} ", mesh.quads[i]);
  }
  return fmt::format(
      R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" )"
      R"(version="1.4.1"><asset><unit meter="1"/><up_axis>Y_UP</up_axis></asset>)"
      R"(<library_effects><effect id="e"><profile_COMMON><technique sid="common"><lambert>)"
      R"(<diffuse><color>.5 .5 .5 1</color></diffuse>{}</lambert></technique></profile_COMMON>)"
      R"(</effect></library_effects><library_materials><material id="pane" name="pane">)"
      R"(<instance_effect url="#e"/></material></library_materials><library_geometries>)"
      R"(<geometry id="g"><mesh><source id="p"><float_array id="pa" count="{}">{}</float_array>)"
      R"(<technique_common><accessor source="#pa" count="{}" stride="3"><param name="X" )"
      R"(type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>)"
      R"(</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/>)"
      R"(</vertices><polylist material="pane" count="{}"><input semantic="VERTEX" source="#v" )"
      R"(offset="0"/><vcount>{}</vcount><p>{}</p></polylist></mesh></geometry>)"
      R"(</library_geometries><library_visual_scenes><visual_scene id="s"><node id="n">)"
      R"(<instance_geometry url="#g"><bind_material><technique_common><instance_material )"
      R"(symbol="pane" target="#pane"/></technique_common></bind_material></instance_geometry>)"
      R"(</node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/>)"
      R"(</scene></COLLADA>)",
      surface, mesh.points.size(), fmt::join(mesh.points, " "), mesh.points.size() / 3,
      mesh.quads.size() / 4, counts, indices);
}

/// The triangle of FbxFile; `properties` of its material.
inline std::string fbx_pane(const std::string& properties) {
  models::testing::FbxFile file;
  file.layers = models::testing::FbxFile::one_material();
  file.more = fmt::format(
      "Material: 40, \"Material::pane\", \"\" {{\nVersion: 102\nShadingModel: \"phong\"\n"
      "MultiLayer: 0\nProperties70:  {{\n{}}}\n}}\n",
      properties);
  file.links = "C: \"OO\",40,11\n";
  return file.text();
}

/// A plate of 10 x 10 x .02 m; `style`: the entity of number 50 with its parameters.
inline std::string ifc_pane(const std::string& style, const std::string& schema = "IFC2X3",
                            const std::string& owner = "#5") {
  return fmt::format(
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
      "FILE_NAME('m.ifc','2020-01-01T00:00:00',(''),(''),'','','');\nFILE_SCHEMA(('{1}'));\n"
      "ENDSEC;\nDATA;\n"
      "#1=IFCPERSON($,$,'',$,$,$,$,$);\n#2=IFCORGANIZATION($,'',$,$,$);\n"
      "#3=IFCPERSONANDORGANIZATION(#1,#2,$);\n#4=IFCAPPLICATION(#2,'1','a','a');\n"
      "#5=IFCOWNERHISTORY(#3,#4,$,.ADDED.,$,$,$,0);\n"
      "#10=IFCCARTESIANPOINT((0.,0.,0.));\n#11=IFCDIRECTION((0.,0.,1.));\n"
      "#12=IFCDIRECTION((1.,0.,0.));\n#13=IFCAXIS2PLACEMENT3D(#10,#11,#12);\n"
      "#14=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#13,$);\n"
      "#15=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n#16=IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.);\n"
      "#17=IFCUNITASSIGNMENT((#15,#16));\n#18=IFCLOCALPLACEMENT($,#13);\n"
      "#20=IFCPROJECT('0000000000000000000001',{2},'p',$,$,$,$,(#14),#17);\n"
      "#21=IFCSITE('0000000000000000000002',{2},'site',$,$,#18,$,$,.ELEMENT.,$,$,$,$,$);\n"
      "#22=IFCBUILDING('0000000000000000000003',{2},'house',$,$,#18,$,$,.ELEMENT.,$,$,$);\n"
      "#23=IFCBUILDINGSTOREY('0000000000000000000004',{2},'Ground floor',$,$,#18,$,$,.ELEMENT.,"
      "0.);\n"
      "#24=IFCRELAGGREGATES('0000000000000000000005',{2},$,$,#20,(#21));\n"
      "#25=IFCRELAGGREGATES('0000000000000000000006',{2},$,$,#21,(#22));\n"
      "#26=IFCRELAGGREGATES('0000000000000000000007',{2},$,$,#22,(#23));\n"
      "#30=IFCCARTESIANPOINT((0.,0.));\n#31=IFCAXIS2PLACEMENT2D(#30,$);\n"
      "#32=IFCRECTANGLEPROFILEDEF(.AREA.,$,#31,10.,10.);\n"
      "#33=IFCEXTRUDEDAREASOLID(#32,#13,#11,0.02);\n"
      "#34=IFCSHAPEREPRESENTATION(#14,'Body','SweptSolid',(#33));\n"
      "#35=IFCPRODUCTDEFINITIONSHAPE($,$,(#34));\n"
      "#36=IFCPLATE('0000000000000000000008',{2},'glazing',$,$,#18,#35,$);\n"
      "#37=IFCRELCONTAINEDINSPATIALSTRUCTURE('0000000000000000000009',{2},$,$,(#36),#23);\n"
      "#49=IFCCOLOURRGB($,0.5,0.5,0.5);\n#50={0};\n"
      "#51=IFCSURFACESTYLE('clear glass',.BOTH.,(#50));\n"
      "#52=IFCPRESENTATIONSTYLEASSIGNMENT((#51));\n#53=IFCSTYLEDITEM(#33,(#52),$);\n"
      "ENDSEC;\nEND-ISO-10303-21;\n",
      style, schema, owner);
}

}  // namespace oriel::pane_models
