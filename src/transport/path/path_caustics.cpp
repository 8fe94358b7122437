// SPDX-License-Identifier: Apache-2.0
// Caustics at a vertex: from the map of photons, and by the search for chains.
#include "transport/path/path_walk.h"

namespace oriel {
namespace {

/// Stream number of the search; those of lobes start at 0.
constexpr std::uint32_t kSearchBranch = 2001;

/// Light of one side of the surface.
struct SideLight {
  Rgb sum{0};
  LightParts parts;
};

/// How the estimates of a vertex are combined. The map has all caustics, but blurred. A vertex that
/// searches replaces them by the chains that were found and the rest that was not. A search with
/// less than certainty adds the difference, divided by its probability.
struct CausticWeights {
  float map = 1, searched = 0;
  explicit CausticWeights(float chance, bool searches) {
    if (!searches) return;
    searched = 1 / chance;
    map = 1 - searched;
  }
};

}  // namespace

/// Adds light of caustic photons and chains on diffuse lobes.
void Path::take_caustics(const Closure& closure, ShadingPoint& point) {
  const IndirectCaches& maps = *settings_.maps;
  const PhotonMap* map = allows(kReceivesCaustics) ? maps.caustic : nullptr;
  const SharpPhotons* rarely_found = indirect() ? maps.rarely_found : nullptr;
  if (!map && !rarely_found) return;
  const std::size_t layers = record_->requested.light_layers;
  SideLight front, behind;
  front.parts.clear(layers);
  behind.parts.clear(layers);

  ChainStarts::Found found;
  if (map && maps.chains && !depth_.after_diffuse) found = maps.chains->starts_at(point.position);
  const std::span<const ChainStart> starts = found.starts;
  const float chance = found.chance;
  sampling::Sampler stream;
  if (!starts.empty()) stream = sampler_.split(0, 1, kSearchBranch);
  const bool searches = !starts.empty() && stream.next_1d() < chance;
  const CausticWeights weights(chance, searches);

  LightParts parts;
  bool lit_sides[2] = {false, false};
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    if (!is_diffuse(lobe.kind)) continue;
    const bool passes = lobe.kind == LobeKind::Translucency;
    lit_sides[passes] = true;
    SideLight& side = passes ? behind : front;
    const Vec3 normal = facing(point.geometric_normal, lit_side(lobe));
    const Rgb albedo = albedo_of(lobe, point.wo()) * kInvPi;
    const auto read = [&](const auto& photons, const PhotonLookup& lookup, float weight) {
      if (weight == 0 || photons.empty()) return;
      parts.clear(layers);
      const Rgb light =
          irradiance_at(photons, point, normal, lookup, layers > 0 ? parts.data() : nullptr,
                        world_.light_layers.unknown());
      side.sum += albedo * light * weight;
      for (std::size_t k = 0; k < layers; ++k) side.parts.of[k] += albedo * parts.of[k] * weight;
    };
    if (rarely_found && depth_.after_diffuse && layers == 0)
      side.sum +=
          albedo * coarse_irradiance_at(rarely_found->map, point, normal, rarely_found->lookup);
    else if (rarely_found)
      read(rarely_found->map, rarely_found->lookup, 1);
    if (map) read(*map, maps.caustic_lookup, weights.map);
    if (!searches) continue;
    read(maps.chains->missed(), maps.caustic_lookup, weights.searched);
    read(maps.chains->others(), maps.caustic_lookup, weights.searched);
  }
  const Vec2 u = searches ? stream.next_2d() : Vec2(0);
  for (const bool passes : {false, true}) {
    if (!searches || !lit_sides[passes]) continue;
    SideLight& side = passes ? behind : front;
    const Vec3 normal = passes ? -point.geometric_normal : point.geometric_normal;
    ChainArrivals arrivals;
    search_chains(world_, found, {point.position, normal, point.ray_offset, point.time}, u,
                  arrivals, counts_);
    for (int i = 0; i < arrivals.count; ++i) {
      const ChainArrival& a = arrivals.of[i];
      const Rgb shown = evaluate_closure(closure, {}, point, point.wo(), a.wi).diffuse.value;
      const Rgb light = shown * a.irradiance * maps.caustic_lookup.scale * weights.searched;
      side.sum += light;
      if (layers > 0) side.parts.of[layer_of_light(a.light)] += light;
    }
  }
  const Rgb scale = light_.throughput * closure.indirect_scale;
  add(aov_.at_vertex(Aov::Indirect), scale * light_.occlusion, front.sum, front.parts);
  add(aov_.at_vertex(Aov::Translucency), scale, behind.sum, behind.parts);
}

}  // namespace oriel
