// SPDX-License-Identifier: Apache-2.0
#include "models/light_units.h"

#include <assimp/commonMetaData.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <cstdio>

#include "base/vec.h"

namespace oriel::models {
namespace {

/// Candela of a Blender light of one watt.
constexpr float kCandelaOfWatt = kLumensOfWatt / (4 * kPi);

bool is_blender_fbx(const std::string& generator, const std::string& suffix) {
  return suffix == ".fbx" && generator.starts_with("Blender (stable FBX IO)");
}

void scale(aiLight& light, float factor) {
  for (aiColor3D* color : {&light.mColorDiffuse, &light.mColorSpecular, &light.mColorAmbient})
    *color = *color * factor;
}

bool is_grey(const aiColor3D& c) { return c.r == c.g && c.g == c.b; }

/// Whether some material of the model emits light.
bool emits(const aiMaterial& material) {
  aiColor3D color;
  return material.Get(AI_MATKEY_COLOR_EMISSIVE, color) == aiReturn_SUCCESS && !color.IsBlack();
}

}  // namespace

LightUnits light_units(const std::string& generator, const std::string& suffix) {
  constexpr LightUnits kWatts{kCandelaOfWatt, kLumensOfWatt, kLumensOfWatt};
  int major = 0, minor = 0;
  const std::string gltf = "Khronos glTF Blender I/O v";
  if (generator.starts_with(gltf) &&
      std::sscanf(generator.c_str() + gltf.size(), "%4d.%4d", &major, &minor) == 2)
    return major > 3 || (major == 3 && minor >= 4) ? LightUnits{1, 1, kLumensOfWatt} : kWatts;
  if (suffix == ".obj" && generator.starts_with("Blender "))
    return {1, 1, kLumensOfWatt};  // it has no lights
  const bool collada = suffix == ".dae" && generator.starts_with("Blender ");
  return collada || is_blender_fbx(generator, suffix) ? kWatts : LightUnits();
}

void mend_light_units(aiScene& model, const std::string& suffix,
                      std::optional<float> emission_scale, Diagnostics& diagnostics) {
  aiString written;
  if (model.mMetaData) model.mMetaData->Get(AI_METADATA_SOURCE_GENERATOR, written);
  const std::string generator = written.C_Str();
  LightUnits units = light_units(generator, suffix);
  const bool converted = units != LightUnits();
  if (emission_scale) units.emission = *emission_scale;
  const bool blender_fbx = is_blender_fbx(generator, suffix);
  bool has_light = model.mNumLights > 0;
  for (unsigned i = 0; i < model.mNumLights; ++i) {
    aiLight& light = *model.mLights[i];
    constexpr float kTemplateGrey = .8f;
    if (blender_fbx && model.mNumCameras > 0 && is_grey(light.mColorDiffuse))
      scale(light, 1 / kTemplateGrey);
    scale(light, light.mType == aiLightSource_DIRECTIONAL ? units.directional : units.point);
  }
  for (unsigned i = 0; i < model.mNumMaterials; ++i) {
    aiMaterial& material = *model.mMaterials[i];
    has_light |= emits(material);
    if (units.emission != 1) material.AddProperty(&units.emission, 1, ORIEL_MATKEY_EMISSION_SCALE);
    float metallic = 0;
    if (blender_fbx && material.Get(AI_MATKEY_REFLECTIVITY, metallic) == aiReturn_SUCCESS)
      material.AddProperty(&metallic, 1, AI_MATKEY_METALLIC_FACTOR);
  }
  if (converted && has_light)
    diagnostics.note(
        "OR-MD-016", {},
        fmt::format(
            "\"{}\" writes watts; to candela, lux and cd/m2: points x {:.6g}, suns x {:.6g}, "
            "emission x {:.6g}",
            generator, units.point, units.directional, units.emission),
        "--emission-scale sets another factor for emission");
}

}  // namespace oriel::models
