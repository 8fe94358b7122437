// SPDX-License-Identifier: Apache-2.0
#include "models/import_material.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "models/import_texture.h"
#include "models/shader_call.h"

namespace oriel::models {
namespace {

/// Reflectance at normal incidence of glass of index 1.5, which is what glTF takes without one.
constexpr float kDielectric = .04f;
/// As Schlick's formula has it, and as mia_material's brdf_curve does by default.
constexpr float kCurve = 5;

Vec3 vec(const aiColor3D& c) { return Vec3(c.r, c.g, c.b); }

/// Reads properties of one material and makes its shaders.
class MaterialMaker {
 public:
  MaterialMaker(const aiScene& model, const aiMaterial& material, std::string name,
                TextureMaker& textures, scene::Scene& scene, Diagnostics& diagnostics)
      : model_(model),
        m_(material),
        name_(std::move(name)),
        textures_(textures),
        scene_(scene),
        diagnostics_(diagnostics) {}

  scene::ShaderUse make() {
    float metallic = 0;
    const bool pbr = m_.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == aiReturn_SUCCESS ||
                     number(AI_MATKEY_ROUGHNESS_FACTOR).has_value();
    pbr ? metallic_roughness(metallic) : classic();
    transmission();
    emission();
    leave_out();
    return call_.use();
  }

 private:
  std::optional<float> number(const char* key, unsigned type, unsigned index) const {
    float value = 0;
    if (m_.Get(key, type, index, value) != aiReturn_SUCCESS || !std::isfinite(value))
      return std::nullopt;
    return value;
  }
  std::optional<Vec3> color(const char* key, unsigned type, unsigned index) const {
    aiColor3D value;
    if (m_.Get(key, type, index, value) != aiReturn_SUCCESS) return std::nullopt;
    return vec(value);
  }

  /// Texture of a use as a colour shader; empty: none.
  std::string texture(aiTextureType type, unsigned index = 0) {
    aiString file;
    if (m_.GetTexture(type, index, &file) != aiReturn_SUCCESS) return {};
    return textures_.lookup(model_, file.C_Str(), name_);
  }

  std::string add(const std::string& suffix, const ShaderCall& call) {
    scene::ShaderElement shader;
    shader.name = unique_name(scene_, name_ + "_" + suffix);
    shader.functions = {call.use()};
    std::string name = shader.name;
    scene_.add(std::move(shader));
    return name;
  }

  /// The texture times a factor; the factor alone where there is no texture.
  void tinted(const std::string& parameter, const std::string& shader, const Vec3& factor,
              const std::string& suffix) {
    if (shader.empty()) {
      call_.set(parameter, factor);
    } else if (factor == Vec3(1)) {
      call_.connect(parameter, shader);
    } else {
      call_.connect(parameter, add(suffix, multiplied(shader, factor)));
    }
  }

  static ShaderCall multiplied(const std::string& shader, const Vec3& factor) {
    ShaderCall mix("mib_color_mix");
    mix.set("num", 1).set("mode_0", 4).set("weight_0", 1.0f).set("color_0", factor);
    return mix.connect("color_base", shader);
  }

  /// One channel of a texture (0 red, 1 green, 2 blue) as grey.
  std::string channel(const std::string& shader, int which, const std::string& suffix) {
    Vec3 mask(0);
    mask[which] = 1;
    const std::string masked = add(suffix + "_mask", multiplied(shader, mask));
    ShaderCall average("mib_color_average");
    average.connect("input", masked).set("factor", 3.0f);  // the mean of one channel of three
    return add(suffix, average);
  }

  /// A function of a grey shader's value, at eight places between 0 and 1.
  template <class F>
  std::string curve(const std::string& shader, const std::string& suffix, F&& f) {
    ShaderCall map("mib_color_interpolate");
    map.connect("input", shader).set("num", 8);
    for (int i = 0; i < 8; ++i) {
      const float x = static_cast<float>(i) / 7;
      // The texel was raised to the gamma of pictures, which it is not.
      if (i > 0 && i < 7) map.set(fmt::format("weight_{}", i), std::pow(x, kTextureGamma));
      map.set(fmt::format("color_{}", i), Vec3(f(x)));
    }
    return add(suffix, map);
  }

  void metallic_roughness(float metallic) {
    const Vec3 base = color(AI_MATKEY_BASE_COLOR).value_or(Vec3(1));
    const float roughness = number(AI_MATKEY_ROUGHNESS_FACTOR).value_or(1);
    const std::string base_map = texture(aiTextureType_BASE_COLOR).empty()
                                     ? texture(aiTextureType_DIFFUSE)
                                     : texture(aiTextureType_BASE_COLOR);
    const std::string both = texture(AI_MATKEY_GLTF_PBRMETALLICROUGHNESS_METALLICROUGHNESS_TEXTURE);
    const float ior = number(AI_MATKEY_REFRACTI).value_or(1.5f);
    const float f0 = number(AI_MATKEY_REFRACTI) ? sqr((ior - 1) / (ior + 1)) : kDielectric;
    tinted("diffuse", base_map, base, "base");
    call_.set("reflectivity", 1.0f).set("brdf_fresnel", false).set("brdf_90_degree_refl", 1.0f);
    call_.set("brdf_curve", kCurve).set("refr_ior", std::max(ior, 1.0f));
    if (both.empty()) {
      call_.set("diffuse_weight", 1 - metallic);
      call_.set("refl_gloss", gloss_of_roughness(roughness));
      call_.set("brdf_0_degree_refl", f0 + (1 - f0) * metallic);
      // White as far as it is no metal.
      if (metallic <= 0 || (base_map.empty() && base == Vec3(1)))
        call_.set("refl_color", Vec3(1));
      else if (base_map.empty())
        call_.set("refl_color", Vec3(1) * (1 - metallic) + base * metallic);
      else
        call_.connect("refl_color", add("tint", blended(base_map, base, metallic)));
      return;
    }
    const std::string metal = channel(both, 2, "metallic"), rough = channel(both, 1, "roughness");
    call_.connect("diffuse_weight",
                  curve(metal, "diffuse_weight", [&](float x) { return 1 - metallic * x; }));
    call_.connect("brdf_0_degree_refl",
                  curve(metal, "f0", [&](float x) { return f0 + (1 - f0) * metallic * x; }));
    call_.connect("refl_gloss", curve(rough, "gloss",
                                      [&](float x) { return gloss_of_roughness(roughness * x); }));
    ShaderCall tint = blended(base_map, base, 1);
    tint.connect("weight_0", curve(metal, "metal", [&](float x) { return metallic * x; }));
    call_.connect("refl_color", add("tint", tint));
  }

  /// White, and over it the base colour with a weight.
  ShaderCall blended(const std::string& base_map, const Vec3& base, float weight) {
    ShaderCall mix("mib_color_mix");
    mix.set("num", 1).set("mode_0", 1).set("color_base", Vec3(1));
    if (weight < 1) mix.set("weight_0", weight);
    if (base_map.empty())
      mix.set("color_0", base);
    else if (base == Vec3(1))
      mix.connect("color_0", base_map);
    else
      mix.connect("color_0", add("tinted", multiplied(base_map, base)));
    return mix;
  }

  void classic() {
    const std::string map = texture(aiTextureType_DIFFUSE);
    tinted("diffuse", map, color(AI_MATKEY_COLOR_DIFFUSE).value_or(Vec3(.6f)), "diffuse");
    call_.set("diffuse_weight", 1.0f);
    const Vec3 specular = color(AI_MATKEY_COLOR_SPECULAR).value_or(Vec3(0));
    const float strength = number(AI_MATKEY_SHININESS_STRENGTH).value_or(1);
    const float exponent = number(AI_MATKEY_SHININESS).value_or(0);
    const float ior = std::max(number(AI_MATKEY_REFRACTI).value_or(1), 1.0f);
    const bool shines = max_component(specular) > 0 && exponent > 0;
    // Seen straight it reflects what its colour says; the colour keeps its hue.
    const float f0 = shines ? clamp01(max_component(specular) * strength) : 0;
    call_.set("reflectivity", shines ? 1.0f : 0.0f);
    if (shines) {
      call_.set("refl_color", specular / max_component(specular));
      // alpha = roughness squared on the other side of gloss_of_roughness.
      call_.set("refl_gloss", gloss_of_roughness(std::sqrt(std::sqrt(2 / (exponent + 2)))));
      call_.set("brdf_fresnel", false).set("brdf_0_degree_refl", f0);
      call_.set("brdf_90_degree_refl", std::max(f0, 1.0f)).set("brdf_curve", kCurve);
    }
    if (ior > 1) call_.set("refr_ior", ior);
    const float opacity = clamp01(number(AI_MATKEY_OPACITY).value_or(1));
    if (const std::string mask = texture(aiTextureType_OPACITY); !mask.empty())
      call_.connect("cutout_opacity", mask);
    if (opacity >= 1) return;
    call_.set("transparency", 1 - opacity).set("refr_color", Vec3(1));
    call_.set("thin_walled", ior <= 1);
  }

  void transmission() {
    const float through = number(AI_MATKEY_TRANSMISSION_FACTOR).value_or(0);
    if (through <= 0) return;
    const float thickness = number(AI_MATKEY_VOLUME_THICKNESS_FACTOR).value_or(0);
    const float roughness = number(AI_MATKEY_ROUGHNESS_FACTOR).value_or(0);
    call_.set("transparency", clamp01(through)).set("thin_walled", thickness <= 0);
    call_.set("refr_color", color(AI_MATKEY_BASE_COLOR).value_or(Vec3(1)));
    call_.set("refr_gloss", gloss_of_roughness(roughness));
    const float distance = number(AI_MATKEY_VOLUME_ATTENUATION_DISTANCE).value_or(0);
    if (thickness <= 0 || !(distance > 0)) return;
    const Vec3 tint = color(AI_MATKEY_VOLUME_ATTENUATION_COLOR).value_or(Vec3(1));
    call_.set("refr_falloff_on", true).set("refr_falloff_dist", distance);
    call_.set("refr_falloff_color_on", true).set("refr_falloff_color", tint);
  }

  void emission() {
    const Vec3 emissive = color(AI_MATKEY_COLOR_EMISSIVE).value_or(Vec3(0));
    const float strength = number(AI_MATKEY_EMISSIVE_INTENSITY).value_or(1);
    if (max_component(emissive) > 0)
      tinted("additional_color", texture(aiTextureType_EMISSIVE), emissive * strength, "emission");
    aiString mode;
    if (m_.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) != aiReturn_SUCCESS) return;
    if (std::string_view(mode.C_Str()) == "OPAQUE") return;
    const float alpha = clamp01(number(AI_MATKEY_OPACITY).value_or(1));
    const std::string map = texture(aiTextureType_BASE_COLOR);
    if (map.empty()) {
      if (alpha < 1) call_.set("cutout_opacity", alpha);
      return;
    }
    ShaderCall coverage("mib_color_alpha");
    coverage.connect("input", map).set("factor", alpha);
    call_.connect("cutout_opacity", add("coverage", coverage));
  }

  void leave_out() {
    std::vector<std::string> parts;
    if (number(AI_MATKEY_CLEARCOAT_FACTOR).value_or(0) > 0) parts.emplace_back("clear coat");
    if (max_component(color(AI_MATKEY_SHEEN_COLOR_FACTOR).value_or(Vec3(0))) > 0)
      parts.emplace_back("sheen");
    if (m_.GetTextureCount(aiTextureType_NORMALS) > 0) parts.emplace_back("normal map");
    if (!parts.empty())
      diagnostics_.note("OR-MD-003", {},
                        fmt::format("material \"{}\": {} left out", name_, fmt::join(parts, ", ")));
  }

  const aiScene& model_;
  const aiMaterial& m_;
  std::string name_;
  TextureMaker& textures_;
  scene::Scene& scene_;
  Diagnostics& diagnostics_;
  ShaderCall call_{"mia_material_x"};
};

}  // namespace

std::string unique_name(const scene::Scene& scene, const std::string& wish) {
  constexpr std::size_t kLongestName = 200;
  std::string name;
  for (const char c : wish.substr(0, kLongestName))
    name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0]))) name = "_" + name;
  if (!scene.find(name)) return name;
  for (int i = 2;; ++i)
    if (std::string numbered = fmt::format("{}_{}", name, i); !scene.find(numbered))
      return numbered;
}

float gloss_of_roughness(float roughness) {
  // The inverse of bsdf::gloss_to_alpha, alpha = 2^(-1.5 - 7 g).
  const float alpha = sqr(clamp01(roughness));
  if (alpha < 1e-5f) return 1;
  return clamp01(-(std::log2(alpha) + 1.5f) / 7);
}

std::string add_material(const aiScene& model, unsigned index, TextureMaker& textures,
                         scene::Scene& scene, Diagnostics& diagnostics) {
  const aiMaterial& source = *model.mMaterials[index];
  const aiString written = const_cast<aiMaterial&>(source).GetName();
  scene::Material material;
  material.name =
      unique_name(scene, written.length > 0 ? written.C_Str() : fmt::format("material_{}", index));
  std::string name = material.name;
  scene.add(material);  // the name is taken before its shaders get theirs
  MaterialMaker maker(model, source, name, textures, scene, diagnostics);
  material.shaders = {maker.make()};
  // Behind the shaders that it names.
  scene.remove(name);
  scene.add(std::move(material));
  return name;
}

}  // namespace oriel::models
