// SPDX-License-Identifier: Apache-2.0
// Properties of one imported material, and the shaders made for it.
#pragma once

#include <assimp/material.h>
#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "models/gltf/extras.h"
#include "models/import_texture.h"
#include "models/shader_call.h"
#include "models/texture_space.h"
#include "models/vertex_colors.h"

namespace oriel::models {

class MaterialSource {
 public:
  /// Inputs:  extras: of a glTF file, null for other formats.
  MaterialSource(const aiScene& model, const aiMaterial& material, const GltfExtras* extras,
                 const VertexColors& colors, std::string name, TextureMaker& textures,
                 scene::Scene& scene)
      : model_(model),
        m_(material),
        extras_(extras),
        colors_(colors),
        name_(std::move(name)),
        textures_(textures),
        scene_(scene) {}

  const std::string& name() const { return name_; }
  GltfExtras extras() const { return extras_ ? *extras_ : GltfExtras(); }
  const VertexColors& colors() const { return colors_; }

  // Properties by assimp's macros of key, type and index; unset if missing.
  std::optional<float> number(const char* key, unsigned type, unsigned index) const;
  std::optional<Vec3> color(const char* key, unsigned type, unsigned index) const;
  std::optional<int> choice(const char* key, unsigned type, unsigned index) const;
  std::string words(const char* key, unsigned type, unsigned index) const;

  // Textures by assimp's type and index.
  bool has(aiTextureType type, unsigned index = 0) const;
  /// Path as written; empty if there is none.
  std::string file(aiTextureType type, unsigned index = 0) const;
  /// Name of a shader that looks up the texture as colour; empty if there is none.
  std::string texture(aiTextureType type, unsigned index = 0);
  /// Same for numbers, without gamma.
  std::string data(aiTextureType type, unsigned index = 0);
  /// Name of the texture element (numbers) for a shader that uses the first texture space. Has to
  /// be called before other texture functions, so that the first space is that of this texture.
  std::string picture_at_first_space(aiTextureType type, unsigned index = 0);

  /// Whether the picture of a texture element is a tangent-space normal map: its mean is near
  /// (.5, .5, 1). False if it cannot be read.
  bool shows_normals(const std::string& texture) const;

  /// Name of a shader that multiplies a picture (empty: white) by the colours of the meshes'
  /// corners; the picture where there are none.
  std::string colored(const std::string& picture);
  /// Creates the texture space of the first coordinates if there is none yet.
  void need_a_space() {
    if (surface.spaces.empty()) surface.spaces.emplace_back();
  }

  /// Adds a shader with a unique name, which it returns.
  std::string add(const std::string& suffix, const ShaderCall& call);
  /// Sets a parameter to a texture times a factor, or to the factor if there is no texture.
  void tinted(ShaderCall& call, const std::string& parameter, const std::string& shader,
              const Vec3& factor, const std::string& suffix);
  static ShaderCall multiplied(const std::string& shader, const Vec3& factor);
  /// Name of a shader that multiplies two others.
  std::string product(const std::string& a, const std::string& b, const std::string& suffix);
  /// The alpha of a texture as grey.
  std::string alpha(const std::string& shader, const std::string& suffix);
  /// One channel of a texture (0 red, 1 green, 2 blue) as grey.
  std::string channel(const std::string& shader, int which, const std::string& suffix);
  /// A function of the value of a grey shader, interpolated linearly between eight points from 0 to
  /// 1.
  template <class F>
  std::string curve(const std::string& shader, const std::string& suffix, F&& f) {
    ShaderCall map("mib_color_interpolate");
    map.connect("input", shader).set("num", 8);
    for (int i = 0; i < 8; ++i) {
      const float x = static_cast<float>(i) / 7;
      if (i > 0 && i < 7) map.set(fmt::format("weight_{}", i), x);
      map.set(fmt::format("color_{}", i), Vec3(f(x)));
    }
    return add(suffix, map);
  }

  SurfaceSpaces surface;              ///< texture spaces requested so far
  std::vector<std::string> left_out;  ///< descriptions of unsupported properties
  bool needs_own_package = false;     ///< it uses shaders of oriel.mi

 private:
  /// Index of the texture space of a texture; created if it does not exist.
  unsigned space(aiTextureType type, unsigned index);
  /// Unset if the maximum number of texture spaces is reached.
  std::optional<unsigned> space(const TextureSpace& wanted);
  std::string lookup(aiTextureType type, unsigned index, TextureMaker::Holds holds);

  const aiScene& model_;
  const aiMaterial& m_;
  const GltfExtras* extras_;
  VertexColors colors_;
  std::string name_;
  TextureMaker& textures_;
  scene::Scene& scene_;
};

}  // namespace oriel::models
