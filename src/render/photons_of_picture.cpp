// SPDX-License-Identifier: Apache-2.0
#include "render/photons_of_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace oriel {
namespace {

/// Number of stored photons per light, and maximum number of emitted ones.
constexpr std::uint64_t kPhotonsPerLight = 100000, kMaxPhotons = 2000000;
/// For the caustics of path-traced pictures: number of stored photons of all lights together, the
/// minimum and maximum of one light, and the maximum number of emitted photons per stored one.
constexpr std::uint64_t kSharpPhotons = 600000, kFewestSharp = 20000, kMostSharp = 300000;
constexpr std::uint64_t kEmittedForSharp = 20;
/// Emitted photons of all lights for each camera path, so that photons are not more work than the
/// picture: in one of gems they took a third of the time of 32 paths per pixel. With 0.15, glass
/// under a spot takes three times as long to equal error. With few paths, kFewestEmitted photons
/// are emitted.
constexpr double kEmittedForPath = 2, kFewestEmitted = 2e6;
/// Estimates of photons of lights that rays find rarely: of so many, at most this share of the
/// scene's radius away.
constexpr int kPhotonsOfEstimate = 24;
constexpr float kRadiusOfEstimate = 0.03f;

/// Photons for caustics of path-traced pictures; without their number.
PhotonSettings uncounted_sharp_settings(const World& world, const SharpCaustics& sharp,
                                        std::uint32_t seed) {
  PhotonSettings settings;
  settings.globillum = false;
  settings.sharp = &sharp;
  settings.seed = seed;
  settings.most = world.budgets[Budget::Photons];
  return settings;
}

}  // namespace

PhotonSettings photon_settings(const World& world, const IndirectPlan& plan, std::uint32_t seed) {
  const scene::RenderOptions& options = world.options;
  PhotonSettings settings;
  settings.globillum = plan.global;
  settings.caustics = plan.caustic;
  const PhotonCount usual{kPhotonsPerLight, kMaxPhotons};
  const bool none_says = std::none_of(world.lights.begin(), world.lights.end(),
                                      [](const Light& l) { return l.photons.any(); });
  if (plan.by_name || none_says) settings.each.global = settings.each.caustic = usual;
  // Final gathering includes the light of the sky with all its bounces.
  if (plan.by_name && !plan.gather) settings.environment.global = usual;
  if (plan.by_name) settings.environment.caustic = usual;
  settings.depth = options.photon_depth;
  settings.merge_global = options.globillum.merge;
  settings.merge_caustic = options.caustic.merge;
  settings.by_energy = !plan.by_name;
  settings.seed = seed;
  settings.most = world.budgets[Budget::Photons];
  return settings;
}

PhotonSettings sharp_photon_settings(const World& world, const SharpCaustics& sharp, double paths,
                                     std::uint32_t seed) {
  PhotonSettings settings = uncounted_sharp_settings(world, sharp, seed);
  const auto lights = static_cast<std::uint64_t>(sharp.light_count());
  const std::uint64_t stored = std::clamp(kSharpPhotons / lights, kFewestSharp, kMostSharp);
  const auto emitted =
      static_cast<std::uint64_t>(std::max(kFewestEmitted, kEmittedForPath * paths));
  settings.each.caustic = {stored, std::clamp(emitted / lights, kFewestSharp * kEmittedForSharp,
                                              stored * kEmittedForSharp)};
  settings.depth = world.options.photon_depth;
  settings.merge_caustic = world.options.caustic.merge;
  return settings;
}

PhotonLookup lookup_of_found_lights(const World& world, const PhotonMap& map) {
  const float extent = std::min(map.extent(), length(world.accel->bounds().size()));
  return {.count = kPhotonsOfEstimate, .radius = kRadiusOfEstimate * extent / 2};
}

SharpPhotons photons_of_found_lights(const World& world, const IntegratorPreparation& p,
                                     SharpCaustics of, double count) {
  PhotonSettings settings = uncounted_sharp_settings(world, of, p.seed);
  const auto each = static_cast<std::uint64_t>(count) / of.light_count() + 1;
  settings.each.caustic = {each, each * kEmittedForSharp};
  settings.depth = world.options.trace_depth;
  PhotonMap map = trace_photons(world, settings, p.counts, nullptr, p.monitor).caustic;
  const PhotonLookup lookup = lookup_of_found_lights(world, map);
  map.estimate_at_places(lookup);
  return {std::move(of), std::move(map), lookup};
}

void note_lights_without_energy(const World& world, const PhotonSettings& settings,
                                Diagnostics& diagnostics) {
  if (!settings.by_energy || diagnostics.has("OR-RN-067")) return;
  std::string first;
  std::size_t more = 0;
  for (const Light& light : world.lights) {
    if (!light.shader || light.photons.has_energy) continue;
    if (first.empty())
      first = light.name;
    else
      ++more;
  }
  if (first.empty()) return;
  diagnostics.note(
      "OR-RN-067", {},
      fmt::format("light \"{}\"{} no energy and sends no photons", first,
                  more > 0 ? fmt::format(" and {} more have", more) : " has"),
      "give it an energy statement; --gi photons sends photons as strong as the light");
}

void note_photon_budget(const World& world, const PhotonSettings& settings,
                        Diagnostics& diagnostics) {
  const Light* largest = nullptr;
  const std::uint64_t wanted = requested_photons(world, settings, &largest);
  if (wanted <= settings.most) return;
  diagnostics.warning(
      "OR-RN-083", largest ? largest->where : SourceLocation{},
      fmt::format("{}; all lights store fewer{}", world.budgets.excess(Budget::Photons, wanted),
                  largest ? fmt::format(", first of all \"{}\"", largest->name) : std::string()),
      SceneBudgets::hint(Budget::Photons, wanted));
}

std::optional<PhotonMaps> read_photons(const std::string& file, const World& world,
                                       Diagnostics& diagnostics) try {
  return load_photon_maps(file, world.budgets[Budget::MapPoints]);
} catch (const std::exception& e) {
  diagnostics.warning("OR-RN-042", {}, e.what());
  return std::nullopt;
}

void write_photons(const std::string& file, const PhotonMaps& photons,
                   Diagnostics& diagnostics) try {
  save_photon_maps(file, photons);
} catch (const std::exception& e) {
  diagnostics.error("OR-RN-068", {}, e.what());
}

}  // namespace oriel
