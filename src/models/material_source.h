// SPDX-License-Identifier: Apache-2.0
// One material of a model: what it says, and the shaders that are made for it.
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

  // Properties by assimp's macros of key, type and index; unset where they are missing.
  std::optional<float> number(const char* key, unsigned type, unsigned index) const;
  std::optional<Vec3> color(const char* key, unsigned type, unsigned index) const;
  std::optional<int> choice(const char* key, unsigned type, unsigned index) const;
  std::string words(const char* key, unsigned type, unsigned index) const;

  // Pictures by assimp's type and index of their use.
  bool has(aiTextureType type, unsigned index = 0) const;
  /// Path as written; empty: none.
  std::string file(aiTextureType type, unsigned index = 0) const;
  /// Name of a shader that looks the picture up as colours; empty: none.
  std::string texture(aiTextureType type, unsigned index = 0);
  /// The same for numbers, without gamma.
  std::string data(aiTextureType type, unsigned index = 0);
  /// Name of the texture element, of numbers, for a shader that looks it up at the first texture
  /// space: asked before any other, the space is the one of this use.
  std::string picture_at_first_space(aiTextureType type, unsigned index = 0);

  /// Whether the picture of a texture element is a tangent-space normal map: its mean is near
  /// (.5, .5, 1). False if it cannot be read.
  bool shows_normals(const std::string& texture) const;

  /// Name of a shader that multiplies a picture (empty: white) by the colours of the meshes'
  /// corners; the picture where there are none.
  std::string colored(const std::string& picture);
  /// Makes the texture space of the mesh's first coordinates, where there is none yet.
  void need_a_space() {
    if (surface.spaces.empty()) surface.spaces.emplace_back();
  }

  /// Adds a shader under a name of its own, which it returns.
  std::string add(const std::string& suffix, const ShaderCall& call);
  /// A parameter as a texture times a factor; the factor alone where there is no texture.
  void tinted(ShaderCall& call, const std::string& parameter, const std::string& shader,
              const Vec3& factor, const std::string& suffix);
  static ShaderCall multiplied(const std::string& shader, const Vec3& factor);
  /// One channel of a texture (0 red, 1 green, 2 blue) as grey.
  std::string channel(const std::string& shader, int which, const std::string& suffix);
  /// A function of a grey shader's value: straight between eight places from 0 to 1.
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

  SurfaceSpaces surface;              ///< what was asked for so far
  std::vector<std::string> left_out;  ///< in words
  bool needs_own_package = false;     ///< it uses shaders of oriel.mi

 private:
  /// The texture space of a use, a new one where there is none yet.
  unsigned space(aiTextureType type, unsigned index);
  /// Unset where there are as many as there can be.
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
