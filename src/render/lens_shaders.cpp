// SPDX-License-Identifier: Apache-2.0
#include "render/lens_shaders.h"

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
  return node.with_params(point,
                          [&](const Call& call) { return node.spec().lens(call, lens, color); });
}

bool fills(const ShaderNode& node, std::string_view channel) {
  const LensTraits traits = lens_traits(node);
  return traits.side_channel_mode > 0 && traits.side_channel == channel;
}

/// What the lens shader that fills the channel was given.
std::optional<Rgb> side_value(const World& world, Vec2 raster, const Rgb& film,
                              std::string_view channel) {
  Rgb color = film;
  for (const ShaderNode* node : world.lens) {
    if (fills(*node, channel)) return color;
    color = map_with(*node, world, raster, color, RayKind::Eye);
  }
  return std::nullopt;
}

/// A path through the lens, and its weight.
PathResult trace_through_lens(const World& world, Vec2 raster, const PathSettings& settings,
                              sampling::Sampler& sampler, RayCounts& counts, Rgb& weight) {
  Camera::Ray ray = world.camera.ray(raster);
  for (const ShaderNode* node : world.lens_rays) {
    ShadingPoint point;
    point.raster = raster;
    point.world = &world;
    point.ray_origin = ray.origin;
    point.ray_direction = ray.direction;
    const Vec2 u = sampler.next_2d();
    weight *= node->with_params(
        point, [&](const Call& call) { return node->spec().lens_ray(call, world.camera, u, ray); });
  }
  return trace_path(world, ray, raster, settings, sampler, counts);
}

void add_outputs(Outputs& sum, const Outputs& part, const Rgb& weight, float share) {
  for (std::size_t i = 0; i < kComponents; ++i) sum.result[i] += part.result[i] * weight * share;
  for (std::size_t i = 0; i < kLevels; ++i) sum.level[i] += part.level[i] * share;
  sum.occlusion += part.occlusion * share;
  sum.opacity += part.opacity * share;
}

}  // namespace

PathResult trace_eye_rays(const World& world, Vec2 raster, const PathSettings& settings,
                          sampling::Sampler& sampler, RayCounts& counts) {
  if (world.lens_rays.empty())
    return trace_path(world, world.camera.ray(raster), raster, settings, sampler, counts);

  int rays = 1;
  for (const ShaderNode* node : world.lens_rays)
    rays = std::clamp(rays * std::clamp(node->spec().lens_rays(*node), 1, kMostLensRays), 1,
                      kMostLensRays);
  const auto n = static_cast<std::uint32_t>(rays);
  const float share = 1 / static_cast<float>(rays);
  PathSettings each = settings;
  each.paths_of_pixel *= static_cast<float>(rays);
  PathResult sum;
  Outputs parts;
  parts.occlusion = Rgb(0), parts.opacity = 0;
  float hits = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    sampling::Sampler own = sampler.split(i, n, 0);
    Outputs part;
    if (settings.outputs) each.outputs = &part;
    Rgb weight(1);
    const PathResult path = trace_through_lens(world, raster, each, own, counts, weight);
    sum.radiance += path.radiance * weight * share;
    sum.alpha += path.alpha * share;
    sum.normal += path.normal * share;
    sum.albedo += path.albedo * share;
    if (path.depth > 0) sum.depth += path.depth, sum.irradiance += path.irradiance, ++hits;
    if (settings.outputs) add_outputs(parts, part, weight, share);
  }
  if (hits > 0) sum.depth /= hits, sum.irradiance /= hits;
  if (settings.outputs) *settings.outputs = parts;
  return sum;
}

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
  return node.spec().lens_traits ? node.spec().lens_traits(node) : LensTraits{};
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
