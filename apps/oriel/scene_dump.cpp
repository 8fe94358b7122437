// SPDX-License-Identifier: Apache-2.0
#include "scene_dump.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "geom/tessellate.h"
#include "models/import.h"
#include "scene/approximation.h"
#include "scene/asset_path.h"
#include "scene/element_settings.h"
#include "scene/hierarchy.h"
#include "scene/render_options.h"
#include "scene_json.h"
#include "scene_motion.h"

namespace oriel::app {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxMotionMatrices = std::size_t{1} << 22;  ///< 256 MB

static_assert(std::endian::native == std::endian::little, "arrays are written as in memory");

json matrix_json(const Mat4& m) {
  json list = json::array();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) list.push_back(m[row][column]);
  return list;
}

class Dump {
 public:
  Dump(const scene::Scene& scene, const SceneMotion& motion) : scene_(scene), motion_(motion) {}

  SceneDump run(const std::string& binary_name, Diagnostics& diagnostics) {
    root_ = {{"format", "oriel-scene"}, {"version", 1}, {"binary", binary_name}};
    for (const char* list :
         {"objects", "instances", "cameras", "lights", "materials", "textures", "profiles"})
      root_[list] = json::array();
    root_["shaders"] = json::object();
    Diagnostics unheard;  // problems of scenes that rendering reports
    const std::string group =
        scene_.renders.empty() ? models::kRootGroup : scene_.renders.back().root;
    for (const scene::Leaf& leaf : scene::flatten(scene_, group, unheard)) add_leaf(leaf);
    for (const scene::Element& element : scene_.elements()) add_element(element);
    if (!scene_.renders.empty())
      root_["render"] = {{"camera", scene_.renders.back().camera},
                         {"frames", scene_.renders.size()}};
    add_gamma();
    if (!motion_.cameras().empty()) root_["render"]["cameras"] = motion_.cameras();
    if (motion_.truncated()) left_out_.insert("changes of elements of many frames");
    for (const std::string& kind : left_out_)
      diagnostics.note("OR-MD-031", {}, fmt::format("left out: {}", kind));
    return {root_.dump(1, ' ', false, json::error_handler_t::replace) + "\n", std::move(binary_)};
  }

 private:
  /// Appends an array; returns its place.
  template <class T>
  json array(const std::vector<T>& values) {
    const json place = {{"offset", binary_.size()}, {"count", values.size()}};
    binary_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    return place;
  }

  static std::vector<float> column(const std::vector<Vec3>& vectors, std::size_t count) {
    std::vector<float> values;
    values.reserve(count * 3);
    for (std::size_t i = 0; i < count && i < vectors.size(); ++i)
      values.insert(values.end(), {vectors[i].x, vectors[i].y, vectors[i].z});
    return values;
  }

  /// The gamma by which colour textures of eight bits are decoded.
  void add_gamma() {
    if (scene_.renders.empty()) return;
    Diagnostics unheard;
    if (const auto* block = scene_.get<scene::Options>(scene_.renders.back().options))
      root_["render"]["gamma"] = scene::interpret_options(*block, unheard).gamma;
  }

  void add_leaf(const scene::Leaf& leaf) {
    json placed = {{"name", leaf.instance().name}, {"matrix", matrix_json(leaf.local_to_world)}};
    add_motion(leaf.instance().name, placed);
    if (const auto* object = leaf.object()) {
      if (!add_object(*object, leaf)) return;
      placed["kind"] = "object";
      placed["element"] = object->name;
      if (leaf.material_source) placed["materials"] = leaf.material_source->materials;
      if (leaf.material_override) placed["override"] = true;
      add_visibility(leaf.flags, placed);
    } else if (const auto* camera = leaf.camera()) {
      placed["kind"] = "camera";
      placed["element"] = camera->name;
    } else if (const auto* light = leaf.light()) {
      placed["kind"] = "light";
      placed["element"] = light->name;
    } else {
      left_out_.insert("geometry shaders");
      return;
    }
    root_["instances"].push_back(std::move(placed));
  }

  /// Names the kinds of rays that do not see the object.
  static void add_visibility(const scene::ResolvedFlags& flags, json& placed) {
    const std::pair<const char*, bool> kinds[] = {{"camera", flags.visible},
                                                  {"shadow", flags.casts_shadow},
                                                  {"reflection", flags.reflection.seen},
                                                  {"refraction", flags.refraction.seen},
                                                  {"finalgather", flags.finalgather.seen}};
    for (const auto& [name, seen] : kinds)
      if (!seen) placed["hidden_from"].push_back(name);
  }

  /// Whether the object has triangles; it is written once.
  bool add_object(const scene::Object& object, const scene::Leaf& leaf) {
    const auto [found, is_new] = objects_.try_emplace(&object, false);
    if (!is_new) return found->second;
    if (!object.hairs.empty()) left_out_.insert("hair");
    scene::ApproximationContext context;
    context.chain = leaf.chain;
    Diagnostics unheard;
    const geom::Mesh mesh = geom::tessellate(object, context, unheard);
    if (mesh.triangles.empty()) return false;
    found->second = true;
    json made = {{"name", object.name}, {"tagged", mesh.tagged}};
    const std::size_t count = mesh.vertex_count();
    made["positions"] = array(column(mesh.positions, count));
    if (!mesh.normals.empty()) made["normals"] = array(column(mesh.normals, count));
    made["uvs"] = json::array();
    for (const geom::TextureSpace& space : mesh.textures)
      made["uvs"].push_back(array(column(space.coordinate, count)));
    std::vector<std::uint32_t> corners;
    corners.reserve(mesh.triangles.size() * 3);
    for (const geom::Triangle& t : mesh.triangles) corners.insert(corners.end(), {t.a, t.b, t.c});
    made["triangles"] = array(corners);
    if (!mesh.slot.empty()) made["slot"] = array(mesh.slot);
    made["slots"] = json::array();
    for (const geom::MaterialSlot& slot : mesh.slots) {
      if (slot.label != geom::kNone)
        made["slots"].push_back({{"label", slot.label}});
      else
        made["slots"].push_back({{"material", slot.name}});
    }
    root_["objects"].push_back(std::move(made));
    return true;
  }

  void add_element(const scene::Element& element) {
    if (const auto* texture = std::get_if<scene::Texture>(&element)) add_texture(*texture);
    if (const auto* profile = std::get_if<scene::LightProfile>(&element)) add_profile(*profile);
    const std::string list = element_list(element);
    if (list.empty()) return;
    const std::string& name = scene::name_of(element);
    if (list == "shaders")
      root_[list][name] = element_json(element);
    else
      root_[list].push_back(element_json(element));
    add_changes(list, name);
  }

  void add_texture(const scene::Texture& texture) {
    json made = {{"name", texture.name}, {"type", scene::type_name(texture.type)}};
    if (!texture.file.empty())
      made["file"] = scene::find_asset(texture.file, texture.directory, scene_.files);
    else
      left_out_.insert("pixels of textures inside the scene");
    root_["textures"].push_back(std::move(made));
  }

  void add_profile(const scene::LightProfile& profile) {
    const std::string file = scene::settings_of(profile).file;
    root_["profiles"].push_back(
        {{"name", profile.name},
         {"file", scene::find_asset(file, profile.directory, scene_.files)}});
  }

  /// The versions of an element that changes from frame to frame.
  void add_changes(const std::string& list, const std::string& name) {
    for (const SceneMotion::Version& version : motion_.versions(list, name))
      root_["changes"][list][name].push_back(
          {{"frame", version.frame}, {"value", json::parse(version.json)}});
  }

  /// The matrices of the frames of a placement that moves.
  void add_motion(const std::string& name, json& placed) {
    const std::vector<Mat4> matrices = motion_.matrices(name, placements_[name]++);
    if (matrices.empty()) return;
    motion_matrices_ += matrices.size();
    if (motion_matrices_ > kMaxMotionMatrices) {
      left_out_.insert("movements of many objects in many frames");
      return;
    }
    std::vector<float> numbers;
    numbers.reserve(matrices.size() * 16);
    for (const Mat4& m : matrices)
      for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) numbers.push_back(m[row][column]);
    placed["motion"] = array(numbers);
  }

  const scene::Scene& scene_;
  const SceneMotion& motion_;
  std::map<std::string, std::size_t> placements_;  ///< so far, by instance
  std::size_t motion_matrices_ = 0;
  json root_;
  std::string binary_;
  std::map<const scene::Object*, bool> objects_;
  std::set<std::string> left_out_;
};

}  // namespace

SceneDump dump_scene(const scene::Scene& scene, const std::string& binary_name,
                     const SceneMotion& motion, Diagnostics& diagnostics) {
  return Dump(scene, motion).run(binary_name, diagnostics);
}

}  // namespace oriel::app
