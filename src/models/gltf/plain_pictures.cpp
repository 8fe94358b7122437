// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/plain_pictures.h"

#include <fmt/format.h>

#include "models/gltf/uri.h"

namespace oriel::models::gltf {
namespace {

json plain_image(const json& written, Buffers& buffers, const std::string& folder,
                 PlainFile& file) {
  json made = json::object();
  if (const std::string name = words(member(written, "name")); !name.empty()) made["name"] = name;
  const std::string uri = words(member(written, "uri"));
  std::string type = words(member(written, "mimeType"));
  if (uri.substr(0, 5) == "data:") {
    const auto data = data_of(uri);
    if (!data) throw Unreadable("the data of an image is not valid base64");
    made["bufferView"] = file.add_view(data->bytes);
    if (type.empty()) type = data->media_type;
  } else if (!uri.empty()) {
    const std::string name = file_name(uri, folder, buffers.files());
    made["uri"] = name.substr(0, 5) == "data:" ? uri : name;
    return made;
  } else if (const auto view = whole(member(written, "bufferView"))) {
    const std::string_view content = buffers.view(*view);
    buffers.spend(content.size());
    made["bufferView"] = file.add_view(content);
  } else {
    throw Unreadable("an image has neither a file nor data");
  }
  made["mimeType"] = type.empty() ? "image/png" : type;
  return made;
}

}  // namespace

Complaints plain_pictures(const json& root, Buffers& buffers, const std::string& folder,
                          PlainFile& file) {
  Complaints complaints;
  std::vector<bool> is_there;
  json images = json::array(), textures = json::array();
  for (const json& written : member(root, "images")) {
    try {
      images.push_back(plain_image(written, buffers, folder, file));
      is_there.push_back(true);
    } catch (const Unreadable& error) {
      images.push_back({{"uri", "missing"}});
      is_there.push_back(false);
      complaints.emplace_back(error.what());
    }
  }
  std::size_t basis = 0, bare = 0;
  for (const json& written : member(root, "textures")) {
    json made = json::object();
    if (const auto sampler = whole(member(written, "sampler"))) made["sampler"] = *sampler;
    auto source = whole(member(written, "source"));
    for (const char* name : {"EXT_texture_webp", "MSFT_texture_dds", "EXT_texture_avif"})
      if (const auto other = whole(member(extension(written, name), "source")))
        if (!source || std::string(name) == "EXT_texture_webp") source = other;
    if (extension(written, "KHR_texture_basisu").is_object()) ++(source ? basis : bare);
    if (source && *source < is_there.size() && is_there[*source]) made["source"] = *source;
    textures.push_back(std::move(made));
  }
  if (basis + bare > 0)
    complaints.push_back(
        fmt::format("{} textures use Basis Universal (KHR_texture_basisu), which is unsupported;"
                    " {} of them have a fallback image, which is used",
                    basis + bare, basis));
  file.root["images"] = std::move(images);
  file.root["textures"] = std::move(textures);
  if (const json& samplers = member(root, "samplers"); samplers.is_array())
    file.root["samplers"] = samplers;
  return complaints;
}

}  // namespace oriel::models::gltf
