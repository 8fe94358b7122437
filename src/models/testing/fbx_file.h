// SPDX-License-Identifier: Apache-2.0
// Test support: FBX 7.3 files as text.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "models/import.h"
#include "scene/scene.h"

namespace oriel::models::testing {

/// A property with three numbers.
inline std::string property(const char* name, const std::array<double, 3>& v) {
  return fmt::format("P: \"{}\", \"Vector3D\", \"Vector\", \"\",{},{},{}\n", name, v[0], v[1],
                     v[2]);
}

/// A file with nodes; the first one is a triangle (0,0,0) (100,0,0) (0,100,0).
struct FbxFile {
  double unit = 1;                            ///< in centimetres
  std::array<int, 6> axes{1, 1, 2, 1, 0, 1};  ///< up, front, right: axis and sign of each
  std::string triangle;                       ///< properties of its node "chair"
  const char* light = "P: \"LightType\", \"enum\", \"\", \"\",1\n";  ///< type of the sun
  std::string lens = "P: \"FieldOfView\", \"FieldOfView\", \"\", \"A\",40\n";
  std::string camera, sun;  ///< of "eye" and "sun"; empty: no such node
  std::string layers;       ///< of the triangle
  std::string creator, definitions;
  std::string more;   ///< further objects
  std::string links;  ///< connections of the further objects

  /// A layer that assigns the first material of the node to the triangle.
  static std::string one_material() {
    return "LayerElementMaterial: 0 {\nVersion: 101\nName: \"\"\nMappingInformationType: "
           "\"AllSame\"\nReferenceInformationType: \"IndexToDirect\"\nMaterials: *1 { a: 0 }\n}\n"
           "Layer: 0 {\nVersion: 100\nLayerElement:  {\nType: \"LayerElementMaterial\"\n"
           "TypedIndex: 0\n}\n}\n";
  }
  std::string text() const {
    const auto node = [](int id, const char* name, const char* kind,
                         const std::string& properties) {
      return fmt::format(
          "Model: {}, \"Model::{}\", \"{}\" {{\nVersion: 232\nProperties70:  {{\n{}}}\n}}\n", id,
          name, kind, properties);
    };
    const auto attribute = [](int id, const char* kind, const char* properties) {
      return fmt::format(
          "NodeAttribute: {}, \"NodeAttribute::\", \"{}\" {{\nTypeFlags: \"{}\"\nGeometryVersion: "
          "124\nProperties70:  {{\n{}}}\n}}\n",
          id, kind, kind, properties);
    };
    std::string settings, objects, joined = links;
    const char* const names[] = {"UpAxis",        "UpAxisSign", "FrontAxis",
                                 "FrontAxisSign", "CoordAxis",  "CoordAxisSign"};
    for (std::size_t i = 0; i < 6; ++i)
      settings += fmt::format("P: \"{}\", \"int\", \"Integer\", \"\",{}\n", names[i], axes[i]);
    objects =
        "Geometry: 10, \"Geometry::seat\", \"Mesh\" {\nVertices: *9 { a: 0,0,0,100,0,0,0,100,0 }\n"
        "PolygonVertexIndex: *3 { a: 0,1,-3 }\nGeometryVersion: 124\n" +
        layers + "}\n" + node(11, "chair", "Mesh", triangle) + more;
    joined += "C: \"OO\",11,0\nC: \"OO\",10,11\n";
    if (!camera.empty()) {
      objects += node(21, "eye", "Camera", camera) + attribute(20, "Camera", lens.c_str());
      joined += "C: \"OO\",21,0\nC: \"OO\",20,21\n";
    }
    if (!sun.empty()) {
      objects += node(31, "sun", "Light", sun) + attribute(30, "Light", light);
      joined += "C: \"OO\",31,0\nC: \"OO\",30,31\n";
    }
    return fmt::format(
        "; FBX 7.3.0 project file\nFBXHeaderExtension:  {{\nFBXHeaderVersion: 1003\nFBXVersion: "
        "7300\nCreator: \"{}\"\n}}\nGlobalSettings:  {{\nVersion: 1000\nProperties70:  {{\n{}P: "
        "\"UnitScaleFactor\", \"double\", \"Number\", \"\",{}\n}}\n}}\n{}Objects:  {{\n{}}}\n"
        "Connections:  {{\n{}}}\n",
        creator, settings, unit, definitions, objects, joined);
  }
};

/// From the space of an instance directly below the root to world space.
inline Mat4 to_world(const scene::Scene& scene, const char* instance) {
  const auto* placed = scene.get<scene::Instance>(instance);
  EXPECT_TRUE(placed) << instance;
  return placed ? placed->transform.value_or(Mat4()).inverse() : Mat4();
}

/// World direction of a camera.
inline Vec3 view_of(const scene::Scene& scene, const char* instance) {
  return transform_vector(Vec3(0, 0, -1), to_world(scene, instance));
}

}  // namespace oriel::models::testing
