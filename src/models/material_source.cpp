// SPDX-License-Identifier: Apache-2.0
#include "models/material_source.h"

#include <assimp/GltfMaterial.h>

#include <algorithm>
#include <cmath>

#include "models/import_material.h"

namespace oriel::models {

using Holds = TextureMaker::Holds;

std::optional<float> MaterialSource::number(const char* key, unsigned type, unsigned index) const {
  float value = 0;
  if (m_.Get(key, type, index, value) != aiReturn_SUCCESS || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::optional<Vec3> MaterialSource::color(const char* key, unsigned type, unsigned index) const {
  aiColor3D value;
  if (m_.Get(key, type, index, value) != aiReturn_SUCCESS) return std::nullopt;
  return Vec3(value.r, value.g, value.b);
}

std::optional<int> MaterialSource::choice(const char* key, unsigned type, unsigned index) const {
  int value = 0;
  if (m_.Get(key, type, index, value) != aiReturn_SUCCESS) return std::nullopt;
  return value;
}

std::string MaterialSource::words(const char* key, unsigned type, unsigned index) const {
  aiString value;
  return m_.Get(key, type, index, value) == aiReturn_SUCCESS ? value.C_Str() : "";
}

bool MaterialSource::has(aiTextureType type, unsigned index) const {
  return !file(type, index).empty();
}

std::string MaterialSource::file(aiTextureType type, unsigned index) const {
  if (extras_ && type == aiTextureType_UNKNOWN)
    if (const auto extra = extras_->files.find(index); extra != extras_->files.end())
      return extra->second;
  return words(_AI_MATKEY_TEXTURE_BASE, type, index);
}

unsigned MaterialSource::space(aiTextureType type, unsigned index) {
  TextureSpace wanted;
  if (const int channel = choice(_AI_MATKEY_UVWSRC_BASE, type, index).value_or(0); channel > 0)
    wanted.channel = static_cast<unsigned>(channel);
  if (extras_)
    if (const auto found = extras_->spaces.find({type, index}); found != extras_->spaces.end())
      wanted = found->second;
  return space(wanted).value_or(0);
}

std::optional<unsigned> MaterialSource::space(const TextureSpace& wanted) {
  std::vector<TextureSpace>& spaces = surface.spaces;
  auto at = std::find(spaces.begin(), spaces.end(), wanted);
  if (at == spaces.end() && spaces.size() >= kMaxTextureSpaces) return std::nullopt;
  if (at == spaces.end()) at = spaces.insert(at, wanted);
  return static_cast<unsigned>(at - spaces.begin());
}

std::string MaterialSource::colored(const std::string& picture) {
  if (colors_.are == ColorsAre::Unknown) return picture;
  const auto color = space({.channel = kColorChannel});
  if (!color) return picture;
  surface.color_gamma = colors_.are == ColorsAre::Pictures ? kTextureGamma : 1;
  ShaderCall call("oriel_vertex_color");
  if (!picture.empty()) call.connect("color", picture);
  call.set("space", static_cast<int>(*color));
  const std::string mode = words(AI_MATKEY_GLTF_ALPHAMODE);
  const bool covers = colors_.transparent && (mode == "MASK" || mode == "BLEND");
  const auto alpha = covers ? space({.channel = kAlphaChannel}) : std::optional<unsigned>();
  if (alpha) call.set("alpha_space", static_cast<int>(*alpha));
  needs_own_package = true;
  return add("colors", call);
}

std::string MaterialSource::texture(aiTextureType type, unsigned index) {
  return lookup(type, index, Holds::Colors);
}

std::string MaterialSource::data(aiTextureType type, unsigned index) {
  return lookup(type, index, Holds::Numbers);
}

std::string MaterialSource::lookup(aiTextureType type, unsigned index, Holds holds) {
  if (!has(type, index)) return {};
  const std::string picture = textures_.picture(model_, file(type, index), holds, name_);
  return textures_.lookup(picture, space(type, index));
}

std::string MaterialSource::picture_at_first_space(aiTextureType type, unsigned index) {
  if (!has(type, index)) return {};
  std::string picture = textures_.picture(model_, file(type, index), Holds::Numbers, name_);
  if (!picture.empty()) space(type, index);
  return picture;
}

bool MaterialSource::shows_normals(const std::string& texture) const {
  const std::optional<Vec3> mean = textures_.mean_color(texture);
  // Slopes cancel out over a picture; a bluish height map has less green or red.
  constexpr float kMiddle = .5f, kOff = .1f, kBlue = .7f;
  return mean && std::fabs(mean->x - kMiddle) < kOff && std::fabs(mean->y - kMiddle) < kOff &&
         mean->z > kBlue;
}

std::string MaterialSource::add(const std::string& suffix, const ShaderCall& call) {
  return add_shader(scene_, name_ + "_" + suffix, call);
}

void MaterialSource::tinted(ShaderCall& call, const std::string& parameter,
                            const std::string& shader, const Vec3& factor,
                            const std::string& suffix) {
  if (shader.empty()) {
    call.set(parameter, factor);
  } else if (factor == Vec3(1)) {
    call.connect(parameter, shader);
  } else {
    call.connect(parameter, add(suffix, multiplied(shader, factor)));
  }
}

ShaderCall MaterialSource::multiplied(const std::string& shader, const Vec3& factor) {
  ShaderCall mix("mib_color_mix");
  mix.set("num", 1).set("mode_0", 4).set("weight_0", 1.0f).set("color_0", factor);
  return mix.connect("color_base", shader);
}

std::string MaterialSource::product(const std::string& a, const std::string& b,
                                    const std::string& suffix) {
  ShaderCall mix("mib_color_mix");
  mix.set("num", 1).set("mode_0", 4).set("weight_0", 1.0f);
  return add(suffix, mix.connect("color_0", a).connect("color_base", b));
}

std::string MaterialSource::alpha(const std::string& shader, const std::string& suffix) {
  ShaderCall alpha("mib_color_alpha");
  alpha.connect("input", shader).set("factor", 1.0f);
  return add(suffix, alpha);
}

std::string MaterialSource::channel(const std::string& shader, int which,
                                    const std::string& suffix) {
  Vec3 mask(0);
  mask[which] = 1;
  const std::string masked = add(suffix + "_mask", multiplied(shader, mask));
  ShaderCall average("mib_color_average");
  // the mean of three channels, of which two are masked
  average.connect("input", masked).set("factor", 3.0f);
  return add(suffix, average);
}

}  // namespace oriel::models
