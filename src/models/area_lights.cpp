// SPDX-License-Identifier: Apache-2.0
#include "models/area_lights.h"

#include <assimp/commonMetaData.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "base/math.h"

namespace oriel::models {
namespace {

/// The number in the first element of that name; unset if there is none.
std::optional<float> number_in(std::string_view xml, std::string_view element) {
  const std::string start = fmt::format("<{} ", element);
  const std::size_t at = xml.find(start), tag = xml.find('>', at);
  if (tag == xml.npos) return std::nullopt;
  const std::size_t first = xml.find_first_not_of(" \t\r\n", tag + 1);
  if (first == xml.npos) return std::nullopt;
  float value = 0;
  const auto read = std::from_chars(xml.data() + first, xml.data() + xml.size(), value);
  if (read.ec != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The value of an attribute in a tag; empty if there is none.
std::string_view attribute(std::string_view tag, std::string_view name) {
  const std::string start = fmt::format(" {}=\"", name);
  const std::size_t at = tag.find(start);
  if (at == tag.npos) return {};
  const std::size_t from = at + start.size();
  return tag.substr(from, tag.find('"', from) - from);
}

/// Width and height as in aiLight::mSize; unset unless Blender wrote an area light.
std::optional<aiVector2D> blender_area(std::string_view light) {
  constexpr float kArea = 4;  // type of an area light
  enum Shape { kSquare = 0, kRectangle = 1, kDisc = 4, kEllipse = 5 };
  const auto width = number_in(light, "area_size");
  if (number_in(light, "type").value_or(0) != kArea || !width || !(*width > 0)) return std::nullopt;
  const float height = number_in(light, "area_sizey").value_or(*width);
  switch (static_cast<int>(number_in(light, "area_shape").value_or(kSquare))) {
    case kRectangle:
      return height > 0 ? aiVector2D(*width, height) : aiVector2D(*width, *width);
    case kDisc:
      return aiVector2D(*width, 0);
    case kEllipse:
      return aiVector2D(std::sqrt(*width * std::max(height, 0.0f)), 0);
    default:
      return aiVector2D(*width, *width);
  }
}

/// Sizes of area lights by the name of the node that has the light, as assimp names it.
std::map<std::string, aiVector2D, std::less<>> collada_areas(std::string_view xml) {
  std::map<std::string, aiVector2D, std::less<>> by_light, by_node;
  constexpr std::string_view kLight = "<light ", kUse = "<instance_light ", kNode = "<node ";
  for (std::size_t at = xml.find(kLight); at != xml.npos; at = xml.find(kLight, at + 1)) {
    const std::size_t end = xml.find("</light>", at);
    if (end == xml.npos) break;
    const std::string_view light = xml.substr(at, end - at);
    if (const auto size = blender_area(light))
      by_light.emplace(attribute(light.substr(0, light.find('>')), "id"), *size);
  }
  for (std::size_t at = xml.find(kUse); at != xml.npos; at = xml.find(kUse, at + 1)) {
    const std::string_view url = attribute(xml.substr(at, xml.find('>', at) - at), "url");
    const std::size_t node = xml.rfind(kNode, at);
    if (url.empty() || node == xml.npos) continue;
    const auto light = by_light.find(url.substr(1));
    const std::string_view tag = xml.substr(node, xml.find('>', node) - node);
    const std::string_view name = attribute(tag, "name");
    if (light != by_light.end())
      by_node.emplace(name.empty() ? attribute(tag, "id") : name, light->second);
  }
  return by_node;
}

}  // namespace

void mend_area_lights(aiScene& model, const std::string& suffix, std::string_view text,
                      Diagnostics& diagnostics) {
  const auto sizes = suffix == ".dae" ? collada_areas(text) : decltype(collada_areas(text))();
  aiString generator;
  if (model.mMetaData) model.mMetaData->Get(AI_METADATA_SOURCE_GENERATOR, generator);
  const bool blender = std::string_view(generator.C_Str()).find("Blender") != std::string::npos;
  int unknown = 0;
  for (unsigned i = 0; i < model.mNumLights; ++i) {
    aiLight& light = *model.mLights[i];
    if (const auto size = sizes.find(std::string_view(light.mName.C_Str())); size != sizes.end()) {
      light.mType = aiLightSource_AREA;
      light.mSize = size->second;
    } else if (suffix == ".fbx" && light.mType == aiLightSource_UNDEFINED) {
      constexpr float kBlenderEdge = 1, kOtherEdge = 2;
      light.mType = aiLightSource_AREA;
      light.mSize = aiVector2D(blender ? kBlenderEdge : kOtherEdge);
      ++unknown;
    }
  }
  if (unknown > 0)
    diagnostics.note("OR-MD-025", {},
                     fmt::format("FBX files have no sizes of area lights; {} become squares of "
                                 "{} units, scaled by their nodes",
                                 unknown, blender ? 1 : 2));
}

}  // namespace oriel::models
