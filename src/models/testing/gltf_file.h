// SPDX-License-Identifier: Apache-2.0
// Test support: builds glTF files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "models/gltf/document.h"
#include "models/testing/model_file.h"
#include "scene/hierarchy.h"

namespace oriel::models::testing {

using gltf::json;

inline constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                     kUnsignedInt = 5125, kFloat = 5126;

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// One node "thing" with one mesh "thing" of one primitive with the material "paint".
struct GltfFile {
  json root = {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"name", "thing"}, {"mesh", 0}}}},
      {"meshes",
       {{{"name", "thing"}, {"primitives", {{{"attributes", json::object()}, {"material", 0}}}}}}},
      {"materials", {{{"name", "paint"}}}},
      {"accessors", json::array()},
      {"bufferViews", json::array()}};
  std::string bytes;

  json& primitive() { return root["meshes"][0]["primitives"][0]; }
  json& material() { return root["materials"][0]; }
  json& node() { return root["nodes"][0]; }

  std::size_t add_view(const std::string& content) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}});
    bytes += content;
    return root["bufferViews"].size() - 1;
  }
  template <class T>
  std::size_t add(const std::vector<T>& values, int component_type, const char* type,
                  std::size_t width, bool normalized = false) {
    root["accessors"].push_back({{"bufferView", add_view(bytes_of(values))},
                                 {"componentType", component_type},
                                 {"count", values.size() / width},
                                 {"type", type}});
    if (normalized) root["accessors"].back()["normalized"] = true;
    return root["accessors"].size() - 1;
  }
  /// The triangle (0,0,0) (1,0,0) (0,1,0).
  void add_triangle() {
    primitive()["attributes"]["POSITION"] =
        add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, kFloat, "VEC3", 3);
  }
  /// The JSON with its buffer embedded.
  std::string text() {
    root["buffers"][0] = {{"byteLength", bytes.size()},
                          {"uri", "data:application/octet-stream;base64," + base64(bytes)}};
    return root.dump();
  }
  std::string binary() {
    root["buffers"][0] = {{"byteLength", bytes.size()}};
    return gltf::glb(root, bytes);
  }
};

/// An imported file with its folder and diagnostics.
struct Made {
  Folder folder;
  Diagnostics diagnostics;
  std::optional<scene::Scene> scene;

  void import(const std::string& content, const std::string& name = "m.gltf") {
    scene = import_model(folder.write(name, content), {folder.path() / "t", folder.path()},
                         diagnostics);
  }
  bool said(const std::string& words) const {
    for (const Diagnostic& d : diagnostics.all())
      if (diagnostics.format(d).find(words) != std::string::npos) return true;
    return false;
  }
  const scene::PolygonGroup& group(const char* object = "thing") const {
    static const scene::PolygonGroup none;
    const auto* found = scene ? scene->get<scene::Object>(object) : nullptr;
    EXPECT_TRUE(found);
    return found && !found->groups.empty() ? found->groups[0] : none;
  }
  Vec3 point(std::size_t corner) const {
    const scene::PolygonGroup& g = group();
    return g.vectors.at(g.vertices.point.at(corner));
  }
  Vec3 uv(std::size_t space, std::size_t corner) const {
    const scene::PolygonGroup& g = group();
    return g.vectors.at(g.vertices.textures.at(space).coordinate.at(corner));
  }
};

/// World positions of the points of all instances.
inline std::vector<Vec3> world_points(const scene::Scene& scene) {
  std::vector<Vec3> points;
  Diagnostics ignored;
  for (const scene::Leaf& leaf : scene::flatten(scene, kRootGroup, ignored))
    if (const auto* object = leaf.object())
      for (const std::uint32_t i : object->groups[0].vertices.point)
        points.push_back(transform_point(object->groups[0].vectors[i], leaf.local_to_world));
  return points;
}

}  // namespace oriel::models::testing
