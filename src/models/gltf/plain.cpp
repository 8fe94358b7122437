// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/plain.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "models/gltf/buffers.h"
#include "models/gltf/document.h"
#include "models/gltf/plain_file.h"
#include "models/gltf/plain_meshes.h"
#include "models/gltf/plain_nodes.h"
#include "models/gltf/plain_pictures.h"
#include "models/gltf/plain_views.h"
#include "models/gltf/pose.h"

namespace oriel::models::gltf {
namespace {

/// Supported extensions, and extensions of materials, which are reported with the materials if they
/// are unsupported.
bool is_known(const std::string& name) {
  static constexpr std::string_view kKnown[] = {
      "KHR_mesh_quantization",   "EXT_meshopt_compression", "KHR_meshopt_compression",
      "KHR_texture_transform",   "EXT_texture_webp",        "KHR_draco_mesh_compression",
      "EXT_mesh_gpu_instancing", "KHR_lights_punctual",     "KHR_texture_basisu",
      "MSFT_texture_dds",        "EXT_texture_avif"};
  return name.starts_with("KHR_materials_") ||
         std::find(std::begin(kKnown), std::end(kKnown), name) != std::end(kKnown);
}

void report_unsupported(const json& root, Diagnostics& diagnostics) {
  const auto unknown = [&](const char* list) {
    std::set<std::string> names;
    for (const json& written : member(root, list))
      if (const std::string name = words(written); !name.empty() && !is_known(name))
        names.insert(name);
    return names;
  };
  const std::set<std::string> required = unknown("extensionsRequired");
  if (!required.empty())
    diagnostics.warning("OR-MD-021", {},
                        fmt::format("unsupported required extensions: {}; their data is skipped",
                                    fmt::join(required, ", ")),
                        "export the model without them");
  std::set<std::string> optional = unknown("extensionsUsed");
  for (const std::string& name : required) optional.erase(name);
  if (!optional.empty())
    diagnostics.note("OR-MD-024", {},
                     fmt::format("extensions that are not read: {}; their data is skipped",
                                 fmt::join(optional, ", ")),
                     optional.contains("EXT_lights_image_based")
                         ? "light the model by a picture with --sky FILE.hdr"
                         : "");
}

/// Materials are later found by name, so each gets a unique name.
json named_materials(const json& written) {
  json materials = json::array();
  std::set<std::string> taken;
  // next number to try, since many equal names would take quadratic time
  std::map<std::string, int> next;
  for (const json& material : written) {
    json made = material.is_object() ? material : json::object();
    const std::string wish = words(member(made, "name"));
    std::string name = wish.empty() ? fmt::format("material_{}", materials.size()) : wish;
    for (int& i = next.try_emplace(wish, 2).first->second; !taken.insert(name).second; ++i)
      name = fmt::format("{}_{}", wish, i);
    made["name"] = name;
    materials.push_back(std::move(made));
  }
  return materials;
}

void keep_other_parts(const json& root, json& made) {
  made["asset"] = {{"version", "2.0"}};
  if (const std::string generator = words(member(member(root, "asset"), "generator"));
      !generator.empty())
    made["asset"]["generator"] = generator;
  made["materials"] = named_materials(member(root, "materials"));
  if (const json& cameras = member(root, "cameras"); cameras.is_array()) made["cameras"] = cameras;
  if (const json& lights = extension(root, "KHR_lights_punctual"); lights.is_object())
    made["extensions"]["KHR_lights_punctual"] = lights;
  json& used = made["extensionsUsed"] = json::array();
  for (const json& name : member(root, "extensionsUsed"))
    if (name.is_string() && name != "KHR_draco_mesh_compression") used.push_back(name);
  // Some exporters forget to list them, and assimp ignores what is not listed.
  std::set<std::string> of_materials;
  for (const json& material : made["materials"])
    if (const json& extensions = member(material, "extensions"); extensions.is_object())
      for (const auto& [name, content] : extensions.items()) of_materials.insert(name);
  for (const std::string& name : of_materials) used.push_back(name);
}

Plain plain_of(const Document& document, std::size_t content_size, const std::string& folder,
               const PlainOptions& options, Diagnostics& diagnostics) {
  report_unsupported(document.root, diagnostics);
  Buffers buffers(document, folder, content_size, options.files);
  std::optional<json> with_pose;
  try {
    with_pose = posed(document.root, buffers, options.seconds);
  } catch (const Unreadable& error) {
    diagnostics.warning("OR-MD-020", {},
                        fmt::format("skins and animations are skipped: {}", error.what()));
  }
  const json& root = with_pose ? *with_pose : document.root;
  PlainFile file;
  keep_other_parts(root, file.root);
  PlainMeshes meshes = plain_meshes(root, buffers, file);
  PlainNodes nodes = plain_nodes(root, buffers);
  Plain plain;
  if (nodes.roots.empty()) plain.error = "its scene is empty";
  if (meshes.read == 0 && meshes.left_out > 0) plain.error = meshes.why;
  if (!plain.error.empty()) return plain;
  if (meshes.left_out > 0)
    diagnostics.warning(
        "OR-MD-020", {},
        fmt::format("{} mesh primitives are skipped: {}", meshes.left_out, meshes.why),
        "export the model again");
  if (meshes.lost_triangles > 0)
    diagnostics.warning(
        "OR-MD-020", {},
        fmt::format("{} triangles have vertex indices out of range; they are skipped",
                    meshes.lost_triangles));
  if (!nodes.left_out.empty())
    diagnostics.warning("OR-MD-020", {}, "instances are skipped: " + nodes.left_out);
  for (const std::string& words : plain_pictures(root, buffers, folder, file))
    diagnostics.warning("OR-MD-022", {}, words, "export the model with PNG or JPEG pictures");
  file.root["meshes"] = std::move(meshes.meshes);
  file.root["nodes"] = std::move(nodes.nodes);
  make_plain_views(file.root, options.aspect);
  file.root["scene"] = 0;
  file.root["scenes"] = json::array({{{"nodes", std::move(nodes.roots)}}});
  plain.binary = file.binary();
  plain.root = std::move(file.root);
  return plain;
}

}  // namespace

std::optional<Plain> make_plain(const std::string& content, const std::string& folder,
                                const PlainOptions& options, Diagnostics& diagnostics) {
  Plain plain;
  try {
    const auto document = parse(content);
    if (!document) return std::nullopt;
    plain = plain_of(*document, content.size(), folder, options, diagnostics);
  } catch (const Unreadable& error) {
    plain.error = error.what();
  }
  return plain;
}

}  // namespace oriel::models::gltf
