// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/extras.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace oriel::models {
namespace {

using gltf::extension;
using gltf::json;
using gltf::member;
using gltf::number;
using gltf::number_at;
using gltf::whole;
using gltf::words;

TextureSpace space_of(const json& texture) {
  TextureSpace space;
  const json& moved = extension(texture, "KHR_texture_transform");
  const float channel = number(member(moved, "texCoord"), number(member(texture, "texCoord"), 0));
  constexpr float kMaxChannels = 8;
  if (channel > 0 && channel < kMaxChannels) space.channel = static_cast<unsigned>(channel);
  if (!moved.is_object()) return space;
  const json &offset = member(moved, "offset"), &scale = member(moved, "scale");
  const float turn = number(member(moved, "rotation"), 0);
  const float c = math::cos(turn), s = math::sin(turn);
  const float sx = number_at(scale, 0, 1), sy = number_at(scale, 1, 1);
  // Includes v = 1 - v of the file, before and after the transform.
  space.move = {c * sx, -s * sy, s * sy + number_at(offset, 0, 0),
                s * sx, c * sy,  1 - c * sy - number_at(offset, 1, 0)};
  return space;
}

/// The image of a texture as assimp names it; empty if there is none.
std::string image_of(const json& root, const json& use) {
  const auto texture = whole(member(use, "index"));
  const json &textures = member(root, "textures"), &images = member(root, "images");
  if (!texture || !textures.is_array() || *texture >= textures.size()) return {};
  const auto image = whole(member(textures[*texture], "source"));
  if (!image || !images.is_array() || *image >= images.size()) return {};
  if (!member(images[*image], "bufferView").is_number())
    return words(member(images[*image], "uri"));
  const auto embedded = [](const json& i) { return member(i, "bufferView").is_number(); };
  const auto end = images.begin() + static_cast<std::ptrdiff_t>(*image);
  return "*" + std::to_string(std::count_if(images.begin(), end, embedded));
}

GltfExtras extras_of(const json& root, const json& material) {
  GltfExtras extras;
  const json& pbr = member(material, "pbrMetallicRoughness");
  const json& coat = extension(material, "KHR_materials_clearcoat");
  const auto use = [&](const json& object, const char* name, int type, unsigned index) {
    if (const json& texture = member(object, name); texture.is_object())
      extras.spaces[{type, index}] = space_of(texture);
  };
  use(pbr, "baseColorTexture", aiTextureType_BASE_COLOR, 0);
  use(pbr, "metallicRoughnessTexture",
      AI_MATKEY_GLTF_PBRMETALLICROUGHNESS_METALLICROUGHNESS_TEXTURE);
  use(extension(material, "KHR_materials_pbrSpecularGlossiness"), "diffuseTexture",
      aiTextureType_DIFFUSE, 0);
  use(material, "normalTexture", aiTextureType_NORMALS, 0);
  use(material, "emissiveTexture", aiTextureType_EMISSIVE, 0);
  use(coat, "clearcoatTexture", AI_MATKEY_CLEARCOAT_TEXTURE);
  use(coat, "clearcoatRoughnessTexture", AI_MATKEY_CLEARCOAT_ROUGHNESS_TEXTURE);
  use(extension(material, "KHR_materials_transmission"), "transmissionTexture",
      AI_MATKEY_TRANSMISSION_TEXTURE);
  const json& sheen = extension(material, "KHR_materials_sheen");
  use(sheen, "sheenColorTexture", AI_MATKEY_SHEEN_COLOR_TEXTURE);
  use(sheen, "sheenRoughnessTexture", AI_MATKEY_SHEEN_ROUGHNESS_TEXTURE);
  const auto use_extra = [&](const json& object, const char* name, ExtraTexture index) {
    const json& texture = member(object, name);
    if (std::string image = image_of(root, texture); !image.empty()) {
      use(object, name, aiTextureType_UNKNOWN, index);
      extras.files[index] = std::move(image);
    }
  };
  extras.emissive_strength =
      number(member(extension(material, "KHR_materials_emissive_strength"), "emissiveStrength"), 1);
  const json& specular = extension(material, "KHR_materials_specular");
  extras.specular = clamp01(number(member(specular, "specularFactor"), 1));
  for (int k = 0; k < 3; ++k)
    extras.specular_color[k] = std::max(
        0.0f, number_at(member(specular, "specularColorFactor"), static_cast<std::size_t>(k), 1));
  const json& brushed = extension(material, "KHR_materials_anisotropy");
  extras.anisotropy = clamp01(number(member(brushed, "anisotropyStrength"), 0));
  extras.anisotropy_turn = number(member(brushed, "anisotropyRotation"), 0);
  use_extra(brushed, "anisotropyTexture", kAnisotropyTexture);
  use_extra(specular, "specularTexture", kSpecularTexture);
  use_extra(specular, "specularColorTexture", kSpecularColorTexture);
  const json& film = extension(material, "KHR_materials_iridescence");
  extras.iridescence = clamp01(number(member(film, "iridescenceFactor"), 0));
  extras.film_ior = std::max(1.0f, number(member(film, "iridescenceIor"), 1.3f));
  extras.film_thickness = std::max(0.0f, number(member(film, "iridescenceThicknessMaximum"), 400));
  extras.film_least = std::max(0.0f, number(member(film, "iridescenceThicknessMinimum"), 100));
  use_extra(film, "iridescenceTexture", kIridescenceTexture);
  use_extra(film, "iridescenceThicknessTexture", kIridescenceThicknessTexture);
  if (extension(material, "KHR_materials_dispersion").is_object())
    extras.left_out.emplace_back("dispersion");
  return extras;
}

}  // namespace

std::map<std::string, GltfExtras> gltf_extras(const json& root) {
  std::map<std::string, GltfExtras> by_name;
  const json& materials = member(root, "materials");
  if (!materials.is_array()) return by_name;
  std::map<std::string, int> count;
  for (const json& material : materials) {
    const json& written = member(material, "name");
    const std::string name = written.is_string() ? written.get<std::string>() : "";
    if (materials.size() > 1 && (name.empty() || ++count[name] > 1)) {
      by_name.erase(name);
      continue;
    }
    by_name[name] = extras_of(root, material);
    if (materials.size() == 1) by_name[""] = by_name[name];
  }
  return by_name;
}

}  // namespace oriel::models
