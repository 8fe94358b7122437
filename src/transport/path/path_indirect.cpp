// SPDX-License-Identifier: Apache-2.0
// Indirect light from caches: gather points and photons.
#include <algorithm>
#include <cmath>

#include "bsdf/ggx.h"
#include "bsdf/oren_nayar.h"
#include "sampling/warp.h"
#include "transport/gather/bounce_reads.h"
#include "transport/path/path_walk.h"

namespace oriel {

Rgb albedo_of(const Lobe& lobe, const Vec3& wo) {
  if (lobe.kind != LobeKind::Diffuse || lobe.roughness == 0 || lobe.inverse_albedo > 0)
    return lobe.weight;
  return lobe.weight * bsdf::OrenNayar(lobe.roughness).albedo(dot(wo, lobe.frame.n));
}

/// Gathered irradiance at a point that the camera sees.
std::optional<Gathered> Path::gathered(const ShadingPoint& point, const Vec3& normal,
                                       bool directional, Rgb* by_light) const {
  const IndirectCaches& maps = *settings_.maps;
  if (depth_.after_diffuse || !maps.gather || !allows(kSendsGatherRays)) return std::nullopt;
  const bool same = looked_up_.valid && !by_light && looked_up_.normal == normal &&
                    looked_up_.position == point.position;
  if (same && (looked_up_.directional || !directional)) return looked_up_.found;
  GatherQuery query = query_at(maps.query, point, normal);
  query.directional = directional || looked_up_.directional;
  query.by_light = by_light;
  query.layers = world_.light_layers.count();
  auto found = maps.gather->interpolate(query);
  if (!by_light) looked_up_ = {true, query.directional, point.position, normal, found};
  return found;
}

/// Irradiance on one side from the caches; empty if they have none.
std::optional<Rgb> Path::mapped_irradiance(const ShadingPoint& point, const Vec3& normal,
                                           LightParts& parts) const {
  const IndirectCaches& maps = *settings_.maps;
  const std::size_t layers = record_->requested.light_layers;
  parts.clear(layers);
  Rgb* by_light = layers > 0 ? parts.data() : nullptr;
  if (!depth_.after_diffuse && maps.gather) {
    const auto found = gathered(point, normal, false, by_light);
    if (found && record_->observer) record_->observer->on_lookup(place_, found->records, 0);
    if (!found) return maps.query.fades() ? std::optional(Rgb(0)) : std::nullopt;
    const Rgb scale = maps.gather_scale * found->fade;
    for (std::size_t i = 0; i < layers; ++i) parts.of[i] *= scale;
    return found->irradiance * scale;
  }
  const bool coarse = reads_bounces();
  int photons = 0;
  if (!coarse && !maps.global) return std::nullopt;
  Rgb sum(0);
  if (coarse && allows(kSendsGatherRays)) {
    GatherQuery query = query_at(maps.bounces_query, point, normal);
    BounceReads::Read read{{}, query.position, query.normal, settings_.further_bounces};
    if (record_->bounce_reads) {
      query.stencil = &read.records;
    } else {
      query.by_light = by_light;
      query.layers = layers;
    }
    auto found = maps.bounces->interpolate(query);
    if (!found) return std::nullopt;
    if (record_->bounce_reads) {
      record_->bounce_reads->of.push_back(read);
      found->irradiance = Rgb(0);
    }
    sum += found->irradiance * settings_.further_bounces;
    for (std::size_t i = 0; i < layers; ++i) parts.of[i] *= settings_.further_bounces;
  }
  if (maps.global && allows(kReceivesGlobillum))
    sum += irradiance_at(*maps.global, point, facing(point.geometric_normal, normal),
                         maps.global_lookup, by_light, world_.light_layers.unknown(), &photons);
  if (record_->observer) record_->observer->on_lookup(place_, 0, photons);
  return sum;
}

/// Glossy reflections without rays: gathered light around the mirror direction.
void Path::emulate(const Closure& closure, const ShadingPoint& point) {
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    if (!lobe.controls.emulated || !lobe.controls.highlights_only || lobe.controls.mirrored)
      continue;
    LightParts parts;
    const std::size_t layers = record_->requested.light_layers;
    parts.clear(layers);
    const auto found = gathered(point, lobe.frame.n, true, layers > 0 ? parts.data() : nullptr);
    if (!found) continue;
    const Vec3 mirrored = bsdf::reflect(point.wo(), lobe.frame.n);
    const float roughness = std::sqrt(lobe.alpha_x * lobe.alpha_y);
    const Rgb blurred = blurred_radiance(found->incoming, mirrored, roughness);
    // Directions are not stored by light layer: each layer gets its share of the total.
    for (int c = 0; c < 3; ++c) {
      const float whole = found->irradiance[c];
      for (std::size_t k = 0; k < layers; ++k)
        parts.of[k][c] = whole > 0 ? blurred[c] * parts.of[k][c] / whole : 0;
      if (layers > 0 && !(whole > 0)) parts.of[world_.light_layers.unknown()][c] = blurred[c];
    }
    add(aov_.at_vertex(Aov::Reflection),
        light_.throughput * lobe.weight * settings_.maps->gather_scale, blurred, parts);
  }
}

/// Adds light of the caches on diffuse lobes. True: no diffuse rays are needed.
bool Path::take_mapped(const Closure& closure, ShadingPoint& point) {
  take_caustics(closure, point);
  Rgb on_side(0), through(0);
  // Light layers, if requested.
  LightParts parts, on_side_parts, through_parts;
  const std::size_t layers = record_->requested.light_layers;
  for (LightParts* p : {&on_side_parts, &through_parts}) p->clear(layers);
  const auto add_to = [&](Rgb& sum, LightParts& sums, const Rgb& factor, const Rgb& light) {
    sum += factor * light;
    for (std::size_t i = 0; i < layers; ++i) sums.of[i] += factor * parts.of[i];
  };
  bool complete = true;
  const Rgb scale = light_.throughput * closure.indirect_scale;
  BounceReads* reads = record_->bounce_reads;
  const std::size_t reads_before = reads ? reads->of.size() : 0;
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    if (!is_diffuse(lobe.kind)) continue;
    const std::size_t first_read = reads ? reads->of.size() : 0;
    const bool passes = lobe.kind == LobeKind::Translucency;
    const Vec3 normal = lit_side(lobe);
    const Rgb albedo = albedo_of(lobe, point.wo()) * kInvPi;
    if (const auto irradiance = mapped_irradiance(point, normal, parts))
      add_to(passes ? through : on_side, passes ? through_parts : on_side_parts, albedo,
             *irradiance);
    else
      complete = false;
    if (reads) reads->scale(first_read, scale * albedo * (passes ? Rgb(1) : light_.occlusion));
  }
  if (reads && !complete) reads->of.resize(reads_before);
  if (!complete) return false;
  if (reads && light_.near_distance > 0) reads->complete = false;
  if (light_.near_distance > 0) with_neighbours(closure, point, on_side, on_side_parts);
  add(aov_.at_vertex(Aov::Indirect), scale * light_.occlusion, on_side, on_side_parts);
  add(aov_.at_vertex(Aov::Translucency), scale, through, through_parts);
  return true;
}

/// Ambient occlusion with colours on gathered light: nearby surfaces occlude it and add their own.
void Path::with_neighbours(const Closure& closure, const ShadingPoint& point, Rgb& smooth,
                           LightParts& parts) {
  /// Stream number; those of lobes start at 0.
  constexpr std::uint32_t kBranch = 2000;
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    if (lobe.kind != LobeKind::Diffuse) continue;
    auto stream = sampler_.split(0, 1, kBranch);
    const Vec3 w = lobe.frame.to_world(sampling::sample_cosine_hemisphere(stream.next_2d()));
    if (dot(w, point.geometric_normal) <= 0) return;
    const std::size_t layers = record_->requested.light_layers;
    PathRecord near({.light_layers = layers}, record_->user_buffers);
    trace_gather_ray(world_, point, w, light_.near_distance, settings_, near, stream, counts_);
    if (near.depth <= 0) return;
    const float share = linear_fade(near.depth, light_.near_distance);
    const Rgb shown = albedo_of(lobe, point.wo()) * (Rgb(1) - light_.near_dark) * share;
    smooth = smooth * (1 - share) + shown * near.radiance;
    for (std::size_t k = 0; k < layers; ++k)
      parts.of[k] = parts.of[k] * (1 - share) + shown * near.by_light.of[k];
    return;
  }
}

}  // namespace oriel
