// SPDX-License-Identifier: Apache-2.0
// A texture element of the scene: a file, pixels, or a shader.
#pragma once

#include <memory>

#include "base/diagnostic.h"
#include "image/texture.h"
#include "runtime/shader_node.h"
#include "scene/elements.h"

namespace oriel::scene {
class Scene;
}

namespace oriel {

class TextureNode {
 public:
  /// A procedural texture: the shader is evaluated with the look-up coordinate in texture space 0.
  explicit TextureNode(NodeList procedure) : procedure_(std::move(procedure)) {}

  /// Opens a file, or the pixels in the scene file. A file that cannot be read is reported once
  /// (OR-RT-020) and replaced by magenta. `gamma` applies to colour and scalar textures; vector
  /// textures are not converted. `scene`: for its policy for files and its budgets.
  static std::unique_ptr<TextureNode> open(const scene::Texture& element, const scene::Scene& scene,
                                           TextureSystem& system, float gamma,
                                           Diagnostics& diagnostics);
  /// Opens a file that open() will be called for, without reporting anything. Thread-safe.
  static void open_ahead(const scene::Texture& element, const scene::Scene& scene,
                         TextureSystem& system, float gamma);

  bool missing() const { return procedure_.empty() && !texture_; }
  /// The shaders of a procedural texture; empty for pictures.
  const NodeList& procedure() const { return procedure_; }

  /// Size in pixels; 0 if it is procedural or missing.
  int width() const { return texture_ ? texture_->width() : 0; }
  int height() const { return texture_ ? texture_->height() : 0; }
  /// For pictures of environments: keeps the picture in memory (Texture::keep_pixels()) even if the
  /// budget of textures is used up, unless it is larger than kMostBytes.
  void keep_pixels() {
    constexpr std::uint64_t kMostBytes = std::uint64_t{160} << 20;  // RGB of 4096 x 2048: 128
    if (texture_ && texture_->bytes_to_keep() <= kMostBytes) texture_->keep_pixels();
  }
  /// The texel at uv, unfiltered; outside of the picture, that of its border.
  Rgba texel(const Vec2& uv) const;

  /// Looks up at `uv`, filtered over the ray's footprint in texture space 0, or the nearest texel
  /// if `point` requires it.
  Rgba lookup(const Vec2& uv, ShadingPoint& point, const TextureSampling& how) const;
  /// The same over a given footprint.
  Rgba lookup(const Vec2& uv, const TextureFootprint& footprint, ShadingPoint& point,
              const TextureSampling& how) const;

 private:
  TextureNode() = default;
  NodeList procedure_;
  Texture* texture_ = nullptr;
  std::unique_ptr<Texture> own_;
  float filter_ = 0;  ///< blur factor; 0 = no filtering
};

/// Change of uv of texture space 0 over the footprint of the ray; zero if unknown.
TextureFootprint texture_footprint(const ShadingPoint& point);

}  // namespace oriel
