// SPDX-License-Identifier: Apache-2.0
#include "models/import_layers.h"

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>

#include <algorithm>
#include <cctype>

namespace oriel::models {
namespace {

bool is_named_normal(std::string file) {
  file.erase(0, file.find_last_of("/\\") + 1);
  std::transform(file.begin(), file.end(), file.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return file.find("normal") != std::string::npos;
}

/// Strength of a bump or normal map.
float strength(const MaterialSource& source, aiTextureType type) {
  if (const auto scale = source.number(AI_MATKEY_GLTF_TEXTURE_SCALE(type, 0))) return *scale;
  if (const auto factor = source.number(AI_MATKEY_OBJ_BUMPMULT(type, 0))) return *factor;
  return source.number(AI_MATKEY_BUMPSCALING).value_or(1);
}

}  // namespace

bool add_bump(MaterialSource& source, ShaderCall& material) {
  aiTextureType type = aiTextureType_NONE;
  for (const aiTextureType wish :
       {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA, aiTextureType_HEIGHT})
    if (type == aiTextureType_NONE && source.has(wish)) type = wish;
  if (type == aiTextureType_NONE) return false;
  const std::string picture = source.picture_at_first_space(type);
  if (picture.empty()) return false;
  const float factor = strength(source, type);
  if (type == aiTextureType_HEIGHT && !source.shows_normals(picture) &&
      !is_named_normal(source.file(type))) {
    ShaderCall bump("mib_bump_map2");
    // The shader inverts the sign: brighter would be lower.
    bump.set("tex", picture.c_str()).set("factor", -factor);
    if (factor != 0) material.set("bump_mode", 0).set("bump", source.add("bump", bump).c_str());
    return false;
  }
  ShaderCall normals("oriel_normal_map");
  normals.set("tex", picture.c_str()).set("factor", factor).set("bump_mode", 5);
  material.set("bump_mode", 5).connect("overall_bump", source.add("normals", normals));
  source.surface.tangents = !source.surface.spaces[0].turns();
  return true;
}

ShaderCall sheened(MaterialSource& source, ShaderCall material) {
  const Vec3 color = source.color(AI_MATKEY_SHEEN_COLOR_FACTOR).value_or(Vec3(0));
  if (max_component(color) <= 0) return material;
  const float roughness = source.number(AI_MATKEY_SHEEN_ROUGHNESS_FACTOR).value_or(0);
  ShaderCall layer("oriel_sheen");
  layer.set("base_material", source.add("under_sheen", material).c_str());
  source.tinted(layer, "color", source.texture(AI_MATKEY_SHEEN_COLOR_TEXTURE), color, "sheen");
  if (const std::string map = source.data(AI_MATKEY_SHEEN_ROUGHNESS_TEXTURE); map.empty())
    layer.set("roughness", roughness);
  else
    layer.connect("roughness", source.curve(source.alpha(map, "sheen_alpha"), "sheen_rough",
                                            [&](float x) { return roughness * x; }));
  source.needs_own_package = true;
  return layer;
}

ShaderCall coated(MaterialSource& source, ShaderCall material) {
  const float coat = clamp01(source.number(AI_MATKEY_CLEARCOAT_FACTOR).value_or(0));
  if (coat <= 0) return material;
  const float roughness = source.number(AI_MATKEY_CLEARCOAT_ROUGHNESS_FACTOR).value_or(0);
  constexpr float kFacing = .04f, kEdge = 1, kCurve = 5;
  ShaderCall layer("mib_glossy_reflection");
  layer.set("base_material", source.add("base", material).c_str());
  layer.set("reflection_color", Vec3(1)).set("edge_factor", kCurve);
  layer.set("single_env_sample", false);
  const std::string much = source.data(AI_MATKEY_CLEARCOAT_TEXTURE);
  if (much.empty()) {
    layer.set("reflection_base_weight", kFacing * coat);
    layer.set("reflection_edge_weight", kEdge * coat);
  } else {
    const std::string red = source.channel(much, 0, "coat");
    layer.connect("reflection_base_weight",
                  source.curve(red, "coat_facing", [&](float x) { return kFacing * coat * x; }));
    layer.connect("reflection_edge_weight",
                  source.curve(red, "coat_edge", [&](float x) { return kEdge * coat * x; }));
  }
  const std::string rough = source.data(AI_MATKEY_CLEARCOAT_ROUGHNESS_TEXTURE);
  if (rough.empty()) {
    layer.set("u_spread", sqr(roughness)).set("v_spread", sqr(roughness));
  } else {
    const std::string spread = source.curve(source.channel(rough, 1, "coat_rough"), "coat_spread",
                                            [&](float x) { return sqr(roughness * x); });
    layer.connect("u_spread", spread).connect("v_spread", spread);
  }
  if (source.has(AI_MATKEY_CLEARCOAT_NORMAL_TEXTURE))
    source.left_out.emplace_back("normal map of the clear coat");
  return layer;
}

}  // namespace oriel::models
