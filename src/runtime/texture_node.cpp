// SPDX-License-Identifier: Apache-2.0
#include "runtime/texture_node.h"

#include <fmt/format.h>

#include "scene/asset_path.h"
#include "scene/scene.h"

namespace oriel {
namespace {

/// Replaces textures that cannot be read.
const Rgba kMissing(1, 0, 1, 1);

/// Vector textures do not contain light.
float gamma_of(const scene::Texture& element, float gamma) {
  return element.type == scene::ParamType::VectorTexture ? 1 : gamma;
}

}  // namespace

std::unique_ptr<TextureNode> TextureNode::open(const scene::Texture& element,
                                               const scene::Scene& scene, TextureSystem& system,
                                               float gamma, Diagnostics& diagnostics) {
  std::unique_ptr<TextureNode> node(new TextureNode);
  // Every texture is filtered: mental ray's `filter` selected a pyramid for speed, and unfiltered
  // look-ups only alias. Its number scales the blur.
  node->filter_ = element.filter.value_or(1.0f);
  gamma = gamma_of(element, gamma);
  std::string why, file, permission;  // file: that does not exist
  if (!element.pixels.empty() && element.size.size() >= 2) {
    const int components = element.size.size() > 2 ? element.size[2] : 3;
    node->own_ =
        make_memory_texture(element.size[0], element.size[1], components, element.pixels, gamma);
    node->texture_ = node->own_.get();
    if (!node->texture_) why = "its pixels do not fill the size written";
  } else {
    const std::string path = scene::find_asset(element.file, element.directory, scene.files);
    const OpenFile source = scene.files.open(path, FileUse::Asset);
    if (!source) {
      why = fmt::format("cannot open texture '{}': {}", path, source.reason());
      permission = source.hint();
      if (source.fault() == OpenFile::Fault::Missing) file = path;
    } else {
      const TextureSystem::Opened opened =
          system.open(source.path(), gamma, scene.budgets[Budget::TextureTile]);
      node->texture_ = opened.texture;
      if (!opened.texture)
        why = opened.message.empty() ? "it could not be opened before" : opened.message;
    }
  }
  if (!why.empty()) {
    std::string hint = "it is shown in magenta";
    if (!permission.empty()) hint = fmt::format("{}; {}", permission, hint);
    if (const std::string near = file.empty() ? "" : nearest_file(file); !near.empty())
      hint = fmt::format("did you mean \"{}\"? {}", near, hint);
    diagnostics.warning("OR-RT-020", element.where,
                        fmt::format("texture \"{}\" cannot be read: {}", element.name, why),
                        std::move(hint));
  }
  return node;
}

void TextureNode::open_ahead(const scene::Texture& element, const scene::Scene& scene,
                             TextureSystem& system, float gamma) {
  const std::string path = scene::find_asset(element.file, element.directory, scene.files);
  if (const OpenFile source = scene.files.open(path, FileUse::Asset))
    system.open_ahead(source.path(), gamma_of(element, gamma), scene.budgets[Budget::TextureTile]);
}

Rgba TextureNode::lookup(const Vec2& uv, ShadingPoint& point, const TextureSampling& how) const {
  const bool filters = texture_ && point.look_up == LookUp::Filtered;
  return lookup(uv, filters ? texture_footprint(point) : TextureFootprint{}, point, how);
}

Rgba TextureNode::lookup(const Vec2& uv, const TextureFootprint& footprint, ShadingPoint& point,
                         const TextureSampling& how) const {
  if (!procedure_.empty()) {
    ShadingPoint at = point;
    at.tex[0] = Vec3(uv.x, uv.y, 0);
    if (at.texture_spaces == 0) {
      at.texture_spaces = 1;
      at.bump_u[0] = at.bump_v[0] = Vec3(0);
    }
    Rgba c(0);
    for (const ShaderNode* node : procedure_) c = node->color(at);
    return c;
  }
  if (!texture_) return kMissing;
  if (point.look_up == LookUp::Nearest) {
    TextureSampling single = how;
    single.interpolation = Interpolation::Nearest;
    return texture_->sample(uv, {}, single);
  }
  if (point.look_up == LookUp::Interpolated) return texture_->sample(uv, {}, how);
  return texture_->sample(uv, {footprint.dx * filter_, footprint.dy * filter_}, how);
}

Rgba TextureNode::texel(const Vec2& uv) const {
  ShadingPoint nowhere;
  nowhere.look_up = LookUp::Nearest;
  return lookup(uv, nowhere, {.wrap_u = Wrap::Clamp, .wrap_v = Wrap::Clamp});
}

TextureFootprint texture_footprint(const ShadingPoint& point) {
  // Solves dP = dpdu du + dpdv dv by least squares for both axes of the footprint.
  const float uu = dot(point.dpdu, point.dpdu), uv = dot(point.dpdu, point.dpdv),
              vv = dot(point.dpdv, point.dpdv);
  const float det = uu * vv - uv * uv;
  if (!(det > 1e-20f * uu * vv)) return {};
  const auto solve = [&](const Vec3& d) {
    const float du = dot(point.dpdu, d), dv = dot(point.dpdv, d);
    return Vec2((vv * du - uv * dv) / det, (uu * dv - uv * du) / det);
  };
  return {solve(point.dpdx), solve(point.dpdy)};
}

}  // namespace oriel
