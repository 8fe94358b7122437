// SPDX-License-Identifier: Apache-2.0
#include "transport/manifold/manifold_caustics.h"

#include <algorithm>
#include <utility>

namespace oriel {
namespace {

/// Difference of unit directions up to which two solutions are the same.
constexpr float kSameSolution = 2e-3f;

bool is_same(const Vec3& a, const Vec3& b) { return (a - b).length2() < sqr(kSameSolution); }

}  // namespace

float finds_chain(const World& world, std::span<const ChainStart> starts, const ChainPhoton& p,
                  RayCounts& counts) {
  const ChainReceiver from{p.photon.position, p.photon.normal, p.chain.offset, 0};
  const ChainKind& kind = p.chain.kind;
  const bool endless =
      world.lights[static_cast<std::size_t>(kind.light)].shape == LightShape::Directional;
  const ChainTarget target{p.chain.origin, endless};
  for (const ChainStart& start : starts) {
    if (!(start.kind == kind)) continue;
    const Vec3 first = normalize(start.towards - from.position);
    if (!(dot(first, from.normal) > 0)) continue;
    const auto chain = find_chain(world, from, kind, first, target, counts);
    if (chain && is_same(chain->first, -p.photon.direction))
      return passed_by_chain(world, from, kind, *chain, target, counts)
                 ? concentration(kind, *chain, target)
                 : 0.0f;
  }
  return 0;
}

void search_chains(const World& world, const ChainStarts::Found& at, const ChainReceiver& from,
                   const Vec2& u, ChainArrivals& arrivals, RayCounts& counts) {
  const ChainKind* kinds[ChainStarts::kMostStarts];
  Vec3 solutions[ChainStarts::kMostStarts];
  int solved = 0, light = -1;
  ChainLight end;
  for (const ChainStart& start : at.starts) {
    const Vec3 first = normalize(start.towards - from.position);
    if (!(dot(first, from.normal) > 0)) continue;
    const Light& source = world.lights[static_cast<std::size_t>(start.kind.light)];
    if (start.kind.light != light) end = place_on_light(source, u), light = start.kind.light;
    const auto chain = find_chain(world, from, start.kind, first, end.target, counts);
    if (!chain) continue;
    bool known = false;
    for (int i = 0; i < solved; ++i)
      known |= *kinds[i] == start.kind && is_same(solutions[i], chain->first);
    if (known) continue;
    kinds[solved] = &start.kind;
    solutions[solved++] = chain->first;
    const float factor = concentration(start.kind, *chain, end.target);
    if (!(factor <= at.limit)) continue;
    const auto passed = passed_by_chain(world, from, start.kind, *chain, end.target, counts);
    if (!passed) continue;
    const Rgb irradiance = light_of_chain(world, source, end, *chain) * *passed * factor;
    if (is_black(irradiance) || !is_finite(irradiance)) continue;
    arrivals.of[arrivals.count++] = {chain->first, irradiance, light};
  }
}

bool ManifoldCaustics::is_valid(const World& world) const {
  return missed_.is_valid() && others_.is_valid() &&
         starts_.is_valid(world.lights.size(), world.instances.size());
}

}  // namespace oriel
