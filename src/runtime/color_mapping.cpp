// SPDX-License-Identifier: Apache-2.0
#include "runtime/color_mapping.h"

#include <algorithm>
#include <optional>

namespace oriel {
namespace {

Rgb map_with(const ShaderNode& node, const World& world, Vec2 raster, const Rgb& color,
             RayKind kind) {
  ShadingPoint point;
  point.ray_kind = kind;
  point.raster = raster;
  point.world = &world;
  const Camera::Ray ray = world.camera.ray(raster);
  point.ray_origin = ray.origin;
  point.ray_direction = ray.direction;
  const LensCall lens{ray.cos_to_film, world.camera.orthographic};
  return node.with_params(
      point, [&](const Call& call) { return node.spec().lens.map_color(call, lens, color); });
}

bool fills(const ShaderNode& node, std::string_view channel) {
  const LensTraits traits = lens_traits(node);
  return traits.side_channel_mode > 0 && traits.side_channel == channel;
}

/// The input of the lens shader that fills the channel.
std::optional<Rgb> side_value(const World& world, Vec2 raster, const Rgb& film,
                              std::string_view channel) {
  Rgb color = film;
  for (const ShaderNode* node : world.lens) {
    if (fills(*node, channel)) return color;
    color = map_with(*node, world, raster, color, RayKind::Eye);
  }
  return std::nullopt;
}

}  // namespace

Rgb map_color(const NodeList& shaders, const World& world, Vec2 raster, const Rgb& color) {
  Rgb mapped = color;
  for (const ShaderNode* node : shaders)
    mapped = map_with(*node, world, raster, mapped, RayKind::Eye);
  return mapped;
}

Rgb map_output(const NodeList& shaders, const World& world, Vec2 raster, const Rgb& shown,
               const Rgb& film) {
  Rgb color = shown;
  for (const ShaderNode* node : shaders) {
    const LensTraits traits = lens_traits(*node);
    std::optional<Rgb> side;
    if (traits.side_channel_mode > 0) side = side_value(world, raster, film, traits.side_channel);
    if (side) color = *side;
    if (!side || traits.side_channel_mode == 1)
      color = map_with(*node, world, raster, color, RayKind::Output);
  }
  return color;
}

LensTraits lens_traits(const ShaderNode& node) {
  return node.spec().lens.traits ? node.spec().lens.traits(node) : LensTraits{};
}

bool has_side_channel(const World& world, std::string_view name) {
  return std::any_of(world.lens.begin(), world.lens.end(),
                     [&](const ShaderNode* node) { return fills(*node, name); });
}

void note_preview(const ShaderNode& node, World& world) {
  const TextureNode* preview = lens_traits(node).preview;
  if (preview && !preview->missing() && !world.preview) world.preview = preview;
}

}  // namespace oriel
