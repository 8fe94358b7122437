// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/plain_nodes.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "models/gltf/accessor.h"

namespace oriel::models::gltf {
namespace {

/// Above the limit of the importer, which reports deep nesting, and low enough for recursive
/// functions.
constexpr int kDeepest = 600;
/// Limit of all instances. A guess: each takes about a kilobyte during the import.
constexpr std::size_t kMaxInstances = 200'000;

/// A list of exactly `count` numbers; null otherwise.
json numbers_of(const json& list, std::size_t count) {
  if (!list.is_array() || list.size() != count) return {};
  json made = json::array();
  for (std::size_t i = 0; i < count; ++i) made.push_back(number(list[i], 0));
  return made;
}

/// The transform and the objects of a node.
json plain_node(const json& written) {
  json made = json::object();
  for (const auto& [name, count] :
       {std::pair("translation", 3), {"rotation", 4}, {"scale", 3}, {"matrix", 16}})
    if (json list = numbers_of(member(written, name), static_cast<std::size_t>(count));
        !list.is_null())
      made[name] = std::move(list);
  for (const char* name : {"mesh", "camera"})
    if (const auto index = whole(member(written, name))) made[name] = *index;
  if (const std::string name = words(member(written, "name")); !name.empty()) made["name"] = name;
  if (const json& light = extension(written, "KHR_lights_punctual"); light.is_object())
    made["extensions"]["KHR_lights_punctual"] = light;
  return made;
}

class NodeMaker {
 public:
  NodeMaker(const json& root, Buffers& buffers)
      : root_(root), buffers_(buffers), written_(member(root, "nodes")) {}

  PlainNodes all() {
    if (!written_.is_array()) return std::move(made_);
    reached_.assign(written_.size(), false);
    for (std::size_t i = 0; i < written_.size(); ++i) made_.nodes.push_back(json::object());
    for (const std::size_t root : roots())
      if (visit(root, 0)) made_.roots.push_back(root);
    return std::move(made_);
  }

 private:
  std::vector<std::size_t> roots() const {
    std::vector<std::size_t> found;
    const json& scenes = member(root_, "scenes");
    const json& chosen = at(scenes, whole(member(root_, "scene"), 0));
    for (const json& node : member(chosen.is_null() ? at(scenes, 0) : chosen, "nodes"))
      if (const auto index = whole(node)) found.push_back(*index);
    if (scenes.is_array() && !scenes.empty()) return found;
    std::vector<bool> below(written_.size(), false);
    for (const json& node : written_)
      for (const json& child : member(node, "children"))
        if (const auto index = whole(child); index && *index < below.size()) below[*index] = true;
    for (std::size_t i = 0; i < below.size(); ++i)
      if (!below[i]) found.push_back(i);
    return found;
  }

  /// Returns true when the node is visited for the first time.
  bool visit(std::size_t index, int depth) {
    if (index >= reached_.size() || reached_[index] || depth > kDeepest) return false;
    reached_[index] = true;
    json node = plain_node(written_[index]);
    json children = json::array();
    for (const json& child : member(written_[index], "children"))
      if (const auto below = whole(child); below && visit(*below, depth + 1))
        children.push_back(*below);
    if (const json& instances = extension(written_[index], "EXT_mesh_gpu_instancing");
        instances.is_object() && node.contains("mesh"))
      add_instances(instances, node, children);
    if (!children.empty()) node["children"] = std::move(children);
    made_.nodes[index] = std::move(node);
    return true;
  }

  void add_instances(const json& instances, json& node, json& children) {
    try {
      struct Place {
        const char *name, *attribute;
        std::size_t components;
        Column column;
      };
      std::array<Place, 3> places{{{"translation", "TRANSLATION", 3, {}},
                                   {"rotation", "ROTATION", 4, {}},
                                   {"scale", "SCALE", 3, {}}}};
      std::size_t count = 0;
      for (Place& place : places) {
        const auto accessor = whole(member(member(instances, "attributes"), place.attribute));
        if (!accessor) continue;
        const std::size_t size = number_format(root_, *accessor).count;
        if (size > kMaxInstances - count_)
          throw Unreadable(fmt::format("it has more than {} instances", kMaxInstances));
        place.column = read_numbers(root_, buffers_, *accessor);
        if (place.column.components != place.components || (count > 0 && count != size))
          throw Unreadable("the instance attributes have different sizes or wrong types");
        count = size;
      }
      count_ += count;
      for (std::size_t i = 0; i < count; ++i) {
        json instance = {{"mesh", node["mesh"]}};
        if (node.contains("name"))  // a unique name here avoids a slow search for a free name later
          instance["name"] = fmt::format("{}_{}", node["name"].get<std::string>(), i);
        for (const Place& place : places) {
          if (place.column.components == 0) continue;
          json& list = instance[place.name] = json::array();
          for (std::size_t k = 0; k < place.components; ++k)
            list.push_back(place.column.values[i * place.components + k]);
        }
        children.push_back(made_.nodes.size());
        made_.nodes.push_back(std::move(instance));
      }
      node.erase("mesh");
    } catch (const Unreadable& error) {
      if (made_.left_out.empty()) made_.left_out = error.what();
    }
  }

  const json& root_;
  Buffers& buffers_;
  const json& written_;
  PlainNodes made_;
  std::vector<bool> reached_;
  std::size_t count_ = 0;  ///< number of instances
};

}  // namespace

PlainNodes plain_nodes(const json& root, Buffers& buffers) {
  return NodeMaker(root, buffers).all();
}

}  // namespace oriel::models::gltf
