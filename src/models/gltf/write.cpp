// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "base/math.h"
#include "models/gltf/plain_file.h"
#include "models/gltf/scene_unit.h"
#include "models/gltf/shader_call.h"
#include "models/gltf/write_material.h"
#include "models/import.h"
#include "models/import_view.h"
#include "scene/hierarchy.h"

namespace oriel::models::gltf {
namespace {

constexpr float kDefaultFocal = 1, kDefaultAperture = 1;

json matrix_of(const Mat4& m) {
  json list = json::array();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) list.push_back(m[row][column]);
  return list;
}

/// Corners of the triangles of a polygon: ears are cut off, of the plane that it lies in most.
std::vector<std::array<std::uint32_t, 3>> triangles_of(std::vector<std::uint32_t> loop,
                                                       const std::vector<Vec3>& points) {
  std::vector<std::array<std::uint32_t, 3>> made;
  Vec3 normal(0);
  for (std::size_t i = 0; i < loop.size(); ++i)
    normal += cross(points[i], points[(i + 1) % loop.size()]);
  std::vector<std::size_t> left(loop.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
    return dot(cross(points[b] - points[a], points[c] - points[b]), normal);
  };
  while (left.size() > 3) {
    std::size_t ear = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const std::size_t n = left.size(), a = left[(i + n - 1) % n], b = left[i],
                        c = left[(i + 1) % n];
      const bool empty = std::none_of(left.begin(), left.end(), [&](std::size_t p) {
        return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
               turn(c, a, p) >= 0;
      });
      if (turn(a, b, c) > 0 && empty) {
        ear = i;
        break;
      }
    }
    const std::size_t n = left.size();
    made.push_back({loop[left[(ear + n - 1) % n]], loop[left[ear]], loop[left[(ear + 1) % n]]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  if (left.size() == 3) made.push_back({loop[left[0]], loop[left[1]], loop[left[2]]});
  return made;
}

class Writer {
 public:
  explicit Writer(const scene::Scene& scene)
      : scene_(scene), unit_(unit_of(scene)), materials_(scene, file_, unit_) {}

  std::string bytes(bool z_is_up, Diagnostics& diagnostics) {
    file_.root["asset"] = {{"version", "2.0"}, {"generator", "Oriel"}};
    file_.root["nodes"] = json::array();
    Diagnostics unheard;  // of scenes that rendering reports
    const std::string root = scene_.renders.empty() ? kRootGroup : scene_.renders.back().root;
    for (const scene::Leaf& leaf : scene::flatten(scene_, root, unheard)) add_leaf(leaf);
    json nodes = json::array();
    for (std::size_t i = 0; i < file_.root["nodes"].size(); ++i) nodes.push_back(i);
    file_.root["scene"] = 0;
    if (z_is_up) {  // glTF has y up
      constexpr double kHalf = 0.70710678118654752;
      const std::size_t turned = file_.root["nodes"].size();
      file_.root["nodes"].push_back({{"name", "z_is_up"},
                                     {"rotation", {-kHalf, 0, 0, kHalf}},
                                     {"children", std::move(nodes)}});
      nodes = json::array({turned});
    }
    file_.root["scenes"] = json::array({{{"nodes", std::move(nodes)}}});
    std::set<std::string> used = materials_.extensions();
    if (!lights_.empty()) {
      used.insert("KHR_lights_punctual");
      file_.root["extensions"]["KHR_lights_punctual"]["lights"] = std::move(lights_);
    }
    if (!used.empty()) file_.root["extensionsUsed"] = used;
    notes_.insert(materials_.notes().begin(), materials_.notes().end());
    for (const std::string& note : notes_)
      diagnostics.note("OR-MD-030", {}, fmt::format("approximated or left out: {}", note));
    return file_.binary();
  }

 private:
  void add_leaf(const scene::Leaf& leaf) {
    json node = {{"name", leaf.instance().name}};
    if (leaf.local_to_world != Mat4()) node["matrix"] = matrix_of(leaf.local_to_world);
    if (const auto* object = leaf.object()) {
      const auto mesh = mesh_of(*object, leaf);
      if (!mesh) return;
      node["mesh"] = *mesh;
    } else if (const auto* camera = leaf.camera()) {
      json& cameras = file_.root["cameras"];
      cameras.push_back(camera_of(*camera));
      node["camera"] = cameras.size() - 1;
    } else if (const auto* light = leaf.light()) {
      if (!add_light(*light, leaf.local_to_world, node)) return;
    } else {
      notes_.insert("geometry shaders");
      return;
    }
    file_.root["nodes"].push_back(std::move(node));
  }

  json camera_of(const scene::Camera& camera) const {
    const float aspect = camera.aspect.value_or(kCameraAspect);
    const float half = camera.aperture.value_or(kDefaultAperture) / 2;
    json made = {{"name", camera.name}};
    constexpr float kNear = .01f, kFar = 1e5f;
    if (camera.orthographic) {
      made["type"] = "orthographic";
      made["orthographic"] = {
          {"xmag", half}, {"ymag", half / aspect}, {"znear", kNear}, {"zfar", kFar}};
    } else {
      const float across = half / camera.focal.value_or(kDefaultFocal);
      made["type"] = "perspective";
      made["perspective"] = {
          {"yfov", 2 * math::atan(across / aspect)}, {"aspectRatio", aspect}, {"znear", kNear}};
    }
    return made;
  }

  /// Whether the light can be written; its node then looks along the light's direction.
  bool add_light(const scene::Light& light, const Mat4& to_world, json& node) {
    const scene::ShaderUse* use =
        light.shaders.empty() ? nullptr : call_of(scene_, light.shaders.front());
    const std::string type = use ? use->type : "none";
    const bool physical = type == "physical_light", infinite = type == "mib_light_infinite";
    if (!physical && !infinite && type != "mib_light_point" && type != "mib_light_spot") {
      notes_.insert(fmt::format("lights of shader {}", type));
      return false;
    }
    Vec3 color(1);
    float inner = 1;
    for (const scene::Argument& a : use->arguments) {
      const std::vector<double>& n = a.value.numbers;
      if (a.name == "color" && n.size() >= 3)
        color = Vec3(static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2]));
      if (a.name == "cone" && !n.empty()) inner = static_cast<float>(n[0]);
    }
    // A surface that faces a light of E lux shows E / pi; physical_light spreads over 4 pi.
    color *= unit_ * (physical ? 1 / 4.0f : kPi);
    const float most = max_component(color);
    if (!(most > 0)) return false;
    if (light.area) notes_.insert("shapes of area lights");
    if (!physical && !infinite) notes_.insert("lights without physical decay");
    const bool spot = !infinite && light.spread && light.direction;
    json made = {{"name", light.name},
                 {"type", infinite ? "directional"
                          : spot   ? "spot"
                                   : "point"},
                 {"intensity", most},
                 {"color", {color.x / most, color.y / most, color.z / most}}};
    if (spot) {
      const float outer = math::acos(clamp(*light.spread, -1, 1));
      constexpr float kMaxCone = kPi / 2, kMinEdge = 1e-4f;
      made["spot"]["outerConeAngle"] = clamp(outer, kMinEdge, kMaxCone);
      made["spot"]["innerConeAngle"] =
          clamp(math::acos(clamp(inner, -1, 1)), 0, std::min(outer, kMaxCone) - kMinEdge);
    }
    const Vec3 p = transform_point(light.origin.value_or(Vec3(0)), to_world);
    const Vec3 d = light.direction ? transform_vector(*light.direction, to_world) : Vec3(0, 0, -1);
    const Vec3 z = normalize(-d), up = std::fabs(z.y) < .9f ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    const Vec3 x = normalize(cross(up, z)), y = cross(z, x);
    node["matrix"] = {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, p.x, p.y, p.z, 1};
    node["extensions"]["KHR_lights_punctual"]["light"] = lights_.size();
    lights_.push_back(std::move(made));
    return true;
  }

  /// Index of the mesh of an object with the materials of an instance; unset: nothing to be seen.
  std::optional<std::size_t> mesh_of(const scene::Object& object, const scene::Leaf& leaf) {
    const std::string own = leaf.material_source && !leaf.material_source->materials.empty()
                                ? leaf.material_source->materials.front()
                                : std::string();
    const auto key = std::make_tuple(object.name, own, leaf.material_override);
    if (const auto found = meshes_.find(key); found != meshes_.end()) return found->second;
    json primitives = json::array();
    for (const scene::PolygonGroup& group : object.groups)
      add_group(group, own, leaf.material_override, primitives);
    if (!object.hairs.empty()) notes_.insert("hair");
    std::optional<std::size_t>& index = meshes_[key];
    if (primitives.empty()) return index;
    json& meshes = file_.root["meshes"];
    meshes.push_back({{"name", object.name}, {"primitives", std::move(primitives)}});
    return index = meshes.size() - 1;
  }

  void add_group(const scene::PolygonGroup& group, const std::string& own, bool overrides,
                 json& primitives) {
    if (!group.subdivisions.empty()) notes_.insert("subdivision surfaces");
    if (!group.polygons.holes.empty()) notes_.insert("holes of polygons");
    const scene::PolygonList& polygons = group.polygons;
    const auto& points = group.vertices.point;
    std::map<std::string, std::vector<std::uint32_t>> by_material;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      std::vector<std::uint32_t> loop(polygons.indices.begin() + polygons.first[i],
                                      polygons.indices.begin() + polygons.first[i + 1]);
      const bool whole = std::all_of(loop.begin(), loop.end(), [&](std::uint32_t corner) {
        return corner < points.size() && points[corner] < group.vectors.size();
      });
      if (!whole || loop.size() < 3) continue;
      std::string material = own;
      const std::uint32_t label =
          i < polygons.material.size() ? polygons.material[i] : scene::kNone;
      if (!overrides && label < group.materials.size()) material = group.materials[label];
      std::vector<Vec3> places;
      places.reserve(loop.size());
      for (const std::uint32_t corner : loop) places.push_back(group.vectors[points[corner]]);
      for (const auto& triangle : triangles_of(std::move(loop), places))
        by_material[material].insert(by_material[material].end(), triangle.begin(), triangle.end());
    }
    if (by_material.empty()) return;
    const json attributes = attributes_of(group);
    for (const auto& [material, indices] : by_material) {
      json primitive = {{"attributes", attributes}, {"indices", file_.add_indices(indices)}};
      if (!material.empty()) primitive["material"] = materials_.index_of(material);
      primitives.push_back(std::move(primitive));
    }
  }

  json attributes_of(const scene::PolygonGroup& group) {
    const std::size_t count = group.vertices.point.size();
    const auto column = [&](const std::vector<std::uint32_t>& indices, std::size_t width,
                            auto&& use) {
      std::vector<float> values;
      values.reserve(count * width);
      for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t at = i < indices.size() ? indices[i] : scene::kNone;
        const Vec3 v = use(at < group.vectors.size() ? group.vectors[at] : Vec3(0, 0, 0));
        for (std::size_t k = 0; k < width; ++k) values.push_back(v[static_cast<int>(k)]);
      }
      return values;
    };
    json made;
    made["POSITION"] =
        file_.add_points(column(group.vertices.point, 3, [](const Vec3& v) { return v; }));
    if (group.vertices.normal.size() == count)
      made["NORMAL"] = file_.add_numbers(column(group.vertices.normal, 3,
                                                [](const Vec3& v) {
                                                  const float l = length(v);
                                                  return l > 0 ? v / l : Vec3(0, 0, 1);
                                                }),
                                         3);
    for (std::size_t i = 0; i < group.vertices.textures.size(); ++i)
      made[fmt::format("TEXCOORD_{}", i)] =
          file_.add_numbers(column(group.vertices.textures[i].coordinate, 2,
                                   [](const Vec3& v) { return Vec3(v.x, 1 - v.y, 0); }),
                            2);
    return made;
  }

  const scene::Scene& scene_;
  float unit_;  ///< cd/m2 of one pixel unit
  PlainFile file_;
  MaterialWriter materials_;
  json lights_ = json::array();
  std::map<std::tuple<std::string, std::string, bool>, std::optional<std::size_t>> meshes_;
  std::set<std::string> notes_;
};

}  // namespace

std::string write_glb(const scene::Scene& scene, Diagnostics& diagnostics, bool z_is_up) {
  return Writer(scene).bytes(z_is_up, diagnostics);
}

}  // namespace oriel::models::gltf
