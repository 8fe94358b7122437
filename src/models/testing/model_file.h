// SPDX-License-Identifier: Apache-2.0
// Test support: small model files and their import.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "base/temporary_folder.h"
#include "models/import.h"

namespace oriel::models::testing {

/// A temporary folder that is deleted with the test.
class Folder : public TemporaryFolder {
 public:
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(file(name), std::ios::binary) << content;
    return file(name);
  }
};

inline std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// A glTF file with one triangle (0,0,0) (1,0,0) (0,1,0) under a node, with a material and more.
inline std::string gltf(const std::string& material, const std::string& node = "",
                        const std::string& more = "") {
  const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string bytes(reinterpret_cast<const char*>(points), sizeof points);
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)" + more +
         R"("nodes":[{"name":"chair","mesh":0)" + node +
         R"(}],"meshes":[{"name":"seat","primitives":[{"attributes":{"POSITION":0},"material":0}]}],)"
         R"("materials":[{"name":"oak",)" +
         material +
         R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
         R"("min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
         R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)" +
         base64(bytes) + "\"}]}";
}

/// A glTF file of the square 0..1 of the plane z = 0, facing z, with two sets of coordinates.
struct Quad {
  using Corners = std::vector<float>;  ///< u and v of (0,0) (1,0) (1,1) (0,1), v down
  Corners uv0{0, 1, 1, 1, 1, 0, 0, 0}, uv1{0, 1, 1, 1, 1, 0, 0, 0};
  std::vector<float> tangents;  ///< x y z w of the corners; none unless written
  std::string material, node, more;
  std::string nodes;  ///< further nodes, each with a preceding comma
  std::string scene = "0";

  std::string text() const {
    const std::vector<float> points{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::vector<float> normals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    std::string bytes, views, accessors, attributes;
    const auto add = [&](const char* name, const char* type, const std::vector<float>& values) {
      if (values.empty()) return;
      const std::string index = std::to_string(count_of(views, '{'));
      const std::string comma = views.empty() ? "" : ",";
      views += comma + R"({"buffer":0,"byteOffset":)" + std::to_string(bytes.size()) +
               R"(,"byteLength":)" + std::to_string(values.size() * sizeof(float)) + "}";
      accessors += comma + R"({"bufferView":)" + index +
                   R"(,"componentType":5126,"count":4,"type":")" + type + "\"}";
      attributes += comma + "\"" + name + "\":" + index;
      bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    };
    add("POSITION", "VEC3", points);
    add("NORMAL", "VEC3", normals);
    add("TEXCOORD_0", "VEC2", uv0);
    add("TEXCOORD_1", "VEC2", uv1);
    add("TANGENT", "VEC4", tangents);
    const std::string corners = std::to_string(count_of(views, '{'));
    const unsigned char order[6] = {0, 1, 2, 0, 2, 3};
    views += R"(,{"buffer":0,"byteOffset":)" + std::to_string(bytes.size()) + R"(,"byteLength":6})";
    bytes.append(reinterpret_cast<const char*>(order), sizeof order);
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + scene + "]}]," + more +
           R"("nodes":[{"name":"chair","mesh":0)" + node + "}" + nodes +
           R"(],"meshes":[{"name":"seat","primitives":[{"material":0,"attributes":{)" + attributes +
           R"(},"indices":)" + corners + R"(}]}],"materials":[{"name":"oak",)" + material +
           R"(}],"accessors":[)" + accessors + R"(,{"bufferView":)" + corners +
           R"(,"componentType":5121,"count":6,"type":"SCALAR"}],"bufferViews":[)" + views +
           R"(],"buffers":[{"byteLength":)" + std::to_string(bytes.size()) +
           R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + "\"}]}";
  }

 private:
  static std::size_t count_of(const std::string& text, char c) {
    std::size_t n = 0;
    for (const char t : text) n += t == c;
    return n;
  }
};

/// `materials`: contents of m.mtl in the same folder.
inline scene::Scene imported(const std::string& name, const std::string& content,
                             const std::string& materials = "") {
  const Folder folder;
  if (!materials.empty()) folder.write("m.mtl", materials);
  Diagnostics diagnostics;
  auto scene =
      import_model(folder.write(name, content), {folder.path() / "t", folder.path()}, diagnostics);
  EXPECT_TRUE(scene.has_value());
  return scene ? std::move(*scene) : scene::Scene();
}

/// The only call in the surface shaders of a material, also by reference to a shader element; null:
/// none.
inline const scene::ShaderUse* surface_of(const scene::Scene& scene, const char* material) {
  const auto* m = scene.get<scene::Material>(material);
  if (!m || m->shaders.size() != 1) return nullptr;
  if (m->shaders[0].reference.empty()) return &m->shaders[0];
  const auto* element = scene.get<scene::ShaderElement>(m->shaders[0].reference);
  return element && element->functions.size() == 1 ? &element->functions[0] : nullptr;
}

/// Numbers of a parameter of the only shader call of a material; empty: not set.
inline std::vector<double> set_in(const scene::Scene& scene, const char* material,
                                  const char* parameter) {
  const scene::ShaderUse* surface = surface_of(scene, material);
  if (!surface) return {};
  for (const scene::Argument& a : surface->arguments)
    if (a.name == parameter)
      return a.value.kind == scene::Value::Kind::Boolean
                 ? std::vector<double>{a.value.boolean ? 1.0 : 0.0}
                 : a.value.numbers;
  return {};
}

}  // namespace oriel::models::testing
