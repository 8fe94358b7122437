// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/plain_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "base/math.h"
#include "models/import_view.h"

namespace oriel::models::gltf {
namespace {

constexpr float kMaxAngle = 3.1f;  // radians; at pi the tangent is infinite

json plain_camera(const json& written, float aspect) {
  json camera = written;
  const json& lens = member(written, "perspective");
  const float yfov = number(member(lens, "yfov"), 0);
  if (words(member(written, "type")) != "perspective" || !(yfov > 0 && yfov < kMaxAngle))
    return camera;
  const float own = number(member(lens, "aspectRatio"), 0);
  const float shape = aspect > 0 ? aspect : own > 0 ? own : kCameraAspect;
  camera["perspective"]["aspectRatio"] = shape;
  camera["perspective"]["yfov"] = 2 * math::atan(math::tan(yfov / 2) * shape) / shape;
  return camera;
}

/// Names of nodes, and how to make new ones.
class Names {
 public:
  explicit Names(const json& nodes) {
    for (const json& node : nodes) ++count_[words(member(node, "name"))];
  }
  /// Renames the node if another one has the same name or it has none.
  void make_unique(json& node, const char* kind) {
    const std::string written = words(member(node, "name"));
    if (!written.empty() && count_[written] == 1) return;
    const std::string wish = written.empty() ? kind : written;
    for (int& i = next_.try_emplace(wish, 1).first->second;; ++i) {
      const std::string name = fmt::format("{}_{}", wish, i);
      if (count_.contains(name)) continue;
      node["name"] = name;
      count_[name] = 1;
      return;
    }
  }

 private:
  std::map<std::string, int> count_, next_;  ///< nodes of a name; number to try
};

}  // namespace

void make_plain_views(json& file, float aspect) {
  const json cameras = member(file, "cameras");
  const json lights = member(extension(file, "KHR_lights_punctual"), "lights");
  json own_cameras = json::array(), own_lights = json::array();
  Names names(file["nodes"]);
  for (json& node : file["nodes"]) {
    if (const auto index = whole(member(node, "camera"))) {
      const json& camera = at(cameras, *index);
      node.erase("camera");
      if (camera.is_object()) {
        node["camera"] = own_cameras.size();
        own_cameras.push_back(plain_camera(camera, aspect));
        names.make_unique(node, "camera");
      }
    }
    if (const json& used = extension(node, "KHR_lights_punctual"); used.is_object()) {
      const json light = at(lights, whole(member(used, "light"), lights.size()));
      node.erase("extensions");
      if (light.is_object()) {
        node["extensions"]["KHR_lights_punctual"]["light"] = own_lights.size();
        own_lights.push_back(light);
        names.make_unique(node, "light");
      }
    }
  }
  file.erase("cameras");
  file.erase("extensions");
  if (!own_cameras.empty()) file["cameras"] = std::move(own_cameras);
  if (own_lights.empty()) return;
  file["extensions"]["KHR_lights_punctual"]["lights"] = std::move(own_lights);
  file["extensionsUsed"].push_back("KHR_lights_punctual");
}

}  // namespace oriel::models::gltf
