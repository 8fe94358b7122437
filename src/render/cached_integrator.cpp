// SPDX-License-Identifier: Apache-2.0
#include "render/cached_integrator.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/byte_stream.h"
#include "base/checkpoint_file.h"
#include "render/cache_state.h"
#include "render/learn_light.h"
#include "render/photons_of_picture.h"
#include "transport/gather/gather_map.h"
#include "transport/manifold/manifold_build.h"
#include "transport/photon/photon_edges.h"
#include "transport/photon/photon_trace.h"

namespace oriel {
namespace {

/// Maximum error of a record for it to cover a point (GatherQuery::accuracy) when points are
/// placed. With 1, a room lit through a window is a few percent too bright near the window; an
/// estimate.
constexpr float kGatherError = 0.5f;
/// Length of a ray, in radii of a coarse record, up to which a path does not end at the record:
/// near an edge it is too coarse. A guess.
constexpr float kRetrace = 2;
/// With fewer camera paths, the search for lit surfaces costs too much: it takes 460 000 rays, as
/// many as 20 000 paths of the interior.
constexpr double kLeastPathsForLit = 1 << 17;
/// Lights that rays find rarely store one photon for so many camera paths, all together and within
/// limits. Pilot paths decide with a share of these photons. Of 20 000, 30 000, 60 000 and 300 000
/// photons for 1.4 million paths, 30 000 had the smallest product of squared error and time (glass
/// balls).
constexpr double kPathsOfPhoton = 40, kFewestOfLights = 20000, kMostOfLights = 300000;
constexpr double kDecidingShare = 0.25;

/// Whether rays that leave surfaces and photons that arrive there may find the same caustics.
bool all_cast_and_receive(const World& world) {
  constexpr unsigned kAll = kMeetsCaustics | kCastsCaustics | kReceivesCaustics;
  return std::all_of(world.instances.begin(), world.instances.end(),
                     [](const InstanceData& i) { return photon_bits(i.visibility, true) == kAll; });
}

}  // namespace

CachedIntegrator::CachedIntegrator(const World& world)
    : world_(world), plan_(plan_indirect(world.options)) {}

bool CachedIntegrator::caches_only() const {
  const scene::RenderOptions& o = world_.options;
  return (plan_.gather && o.finalgather.only) ||
         ((plan_.global || plan_.caustic) && o.photonmap_only);
}

PathSettings CachedIntegrator::path_settings() const {
  PathSettings settings = paths_;
  settings.indirect = plan_.indirect;
  // Points without records are lit by rays, with the bounces that gather rays would have had.
  if (plan_.gather && settings.diffuse_bounces < PathSettings::kAllBounces)
    ++settings.diffuse_bounces;
  // Without photons of the sky and without gathering, the sky gives no indirect light.
  if (plan_.global && !plan_.gather && !plan_.by_name) settings.diffuse_bounces = 0;
  settings.maps = plan_.maps() || maps_.caustic || maps_.rarely_found ? &maps_ : nullptr;
  return settings;
}

void CachedIntegrator::trace(const Camera::Ray& eye, Vec2 raster, float paths_of_pixel,
                             PathRecord& record, sampling::Sampler& sampler,
                             RayCounts& counts) const {
  PathSettings settings = path_settings();
  settings.paths_of_pixel = paths_of_pixel;
  settings.grid = reads_grid() ? &*grid_ : nullptr;
  settings.lit = lit_.empty() ? nullptr : &lit_;
  settings.guide = learned_.guide.empty() ? nullptr : &learned_.guide;
  settings.diffuse_rays = learned_.diffuse_rays;
  settings.lights = learned_.lights.empty() ? nullptr : &learned_.lights;
  settings.emitters = learned_.emitters.empty() ? nullptr : &learned_.emitters;
  trace_path(world_, eye, raster, settings, record, sampler, counts);
}

void CachedIntegrator::prepare(const IntegratorPreparation& given) {
  IntegratorPreparation p = given;
  if (learns()) p.paths = needed_paths(world_, given, path_settings());
  maps_.rarely_found = nullptr;  // of an earlier preparation
  if (plan_.sharp_caustics) trace_sharp_caustics(p);
  if (plan_.global || plan_.caustic) trace_photon_maps(p);
  try_rarely_found(p);
  if (plan_.gather) gather(p);
  if (plan_.bounces) cache_bounces(gather_passes(p.seed), p);
  if (p.share && !std::exchange(helped_, true)) p.share->from_leader({});
  BestSettings best(world_, p, path_settings());
  find_lit_surfaces(p, best);
  if (learns()) {
    IndirectCaches without = maps_;
    without.rarely_found = nullptr;
    learned_ = learn_light(world_, p, std::move(best), maps_.rarely_found ? &without : nullptr);
    settle_rarely_found(p);
  }
  if (!caches_only() && !p.monitor.cancelled())
    grid_.emplace(world_, path_settings(), p.seed, p.counts);
  prepared_ = !p.monitor.cancelled();
}

/// Caches hold the light of lit surfaces already.
void CachedIntegrator::find_lit_surfaces(const IntegratorPreparation& p, BestSettings& best) {
  if (!plan_.indirect || plan_.maps() || caches_only() || p.monitor.cancelled()) return;
  if (p.paths < kLeastPathsForLit) return;
  lit_ = LitSurfaces(world_, p.picture, p.seed, p.counts);
  if (lit_.empty() || p.monitor.cancelled()) return;
  PathSettings sampled = best.settings();
  sampled.lit = &lit_;
  if (!best.improve(sampled)) lit_ = {};
}

/// Only paths that trace diffuse bounces learn.
bool CachedIntegrator::learns() const {
  return plan_.indirect && !plan_.gather && !plan_.global && !caches_only();
}

bool CachedIntegrator::prepares_long(double paths) const {
  return has_caches() || (learns() && may_learn(world_, paths));
}

void CachedIntegrator::trace_photon_maps(const IntegratorPreparation& p) {
  const scene::RenderOptions& options = world_.options;
  const std::string& file = p.files.photons;
  std::optional<PhotonMaps> stored;
  if (!file.empty() && !options.photonmap_rebuild && std::filesystem::exists(file))
    stored = read_photons(file, world_, p.diagnostics);
  read_files_ |= stored.has_value();
  if (stored) {
    photons_ = std::move(*stored);
  } else {
    const PhotonSettings settings = photon_settings(world_, plan_, p.seed);
    note_lights_without_energy(world_, settings, p.diagnostics);
    note_photon_budget(world_, settings, p.diagnostics);
    photons_ = trace_photons(world_, settings, p.counts, nullptr, p.monitor);
    if (!file.empty() && !p.files.read_only && !p.monitor.cancelled())
      write_photons(file, photons_, p.diagnostics);
  }
  use_photon_maps();
  if (plan_.global) keep_light_at_edges(photons_.global, world_, maps_.global_lookup);
}

/// Nothing where no light belongs to photons, or no object casts caustics.
void CachedIntegrator::trace_sharp_caustics(const IntegratorPreparation& p) {
  sharp_ = SharpCaustics(world_);
  if (sharp_.empty()) return;
  ChainLog log;
  PhotonSettings settings = sharp_photon_settings(world_, sharp_, p.paths, p.seed);
  settings.chains = &log;
  photons_ = trace_photons(world_, settings, p.counts, nullptr, p.monitor);
  use_photon_maps();
  if (p.monitor.cancelled()) return;
  chains_ = build_manifold_caustics(world_, log, maps_.caustic_lookup.radius,
                                    settings.merge_caustic, p.counts, p.monitor);
  use_chains();
}

void CachedIntegrator::use_chains() {
  if (!chains_.empty()) maps_.chains = &chains_;
}

/// A few photons of light that rays find rarely, by which pilot paths decide. None where paths do
/// not learn.
void CachedIntegrator::try_rarely_found(const IntegratorPreparation& p) {
  if (!learns() || !may_learn(world_, p.paths) || p.monitor.cancelled()) return;
  if (path_settings().further_bounces != Rgb(1) || !all_cast_and_receive(world_)) return;
  SharpCaustics lights(world_, CausticLights::RarelyFound);
  if (lights.empty()) return;
  trace_rarely_found(p, std::move(lights), kDecidingShare);
  if (!rarely_found_.map.empty()) maps_.rarely_found = &rarely_found_;
}

void CachedIntegrator::trace_rarely_found(const IntegratorPreparation& p, SharpCaustics lights,
                                          double share) {
  const double photons = std::clamp(p.paths / kPathsOfPhoton, kFewestOfLights, kMostOfLights);
  rarely_found_ = photons_of_found_lights(world_, p, std::move(lights), share * photons);
}

/// Replaces the few photons by all of them, or by none if paths need none.
void CachedIntegrator::settle_rarely_found(const IntegratorPreparation& p) {
  if (!maps_.rarely_found) return;
  if (learned_.needs_photons && !p.monitor.cancelled()) {
    trace_rarely_found(p, std::move(rarely_found_.of), 1);
    return;
  }
  rarely_found_ = {};
  maps_.rarely_found = nullptr;
}

void CachedIntegrator::use_photon_maps() {
  const scene::RenderOptions& options = world_.options;
  const geom::Box3 box = world_.accel->bounds();
  if (plan_.global) maps_.global = &photons_.global;
  if (plan_.caustic || plan_.sharp_caustics) maps_.caustic = &photons_.caustic;
  if (plan_.sharp_caustics) maps_.sharp = &sharp_;
  maps_.global_lookup = photon_lookup(options.globillum, box, PhotonKind::Global);
  maps_.global_lookup.walls_of = &world_;
  maps_.caustic_lookup = photon_lookup(options.caustic, box, PhotonKind::Caustic);
}

GatherPasses CachedIntegrator::gather_passes(std::uint32_t seed) {
  GatherPasses passes;
  passes.records = gather_settings(world_.options, world_.accel->bounds());
  passes.density = world_.options.finalgather.presample_density;
  passes.seed = seed;
  // Photons bring all further bounces of finite lights. Those of the sky and of emissive surfaces
  // are gathered, except in scenes whose own statements enable both, where the manual omits them.
  if (plan_.global)
    passes.records.path.diffuse_bounces = plan_.by_name ? PathSettings::kAllBounces : 0;
  paths_ = passes.records.path;
  passes.covered.accuracy = kGatherError;
  passes.covered.radii = passes.records.radii;
  return passes;
}

void CachedIntegrator::use_bounces() {
  maps_.bounces = &bounces_.cache;
  maps_.bounces_query = bounces_.query;
  maps_.bounces_held = bounces_.held;
  maps_.retrace = kRetrace * bounces_.query.radii.min;
}

void CachedIntegrator::use_gather_points(const GatherPasses& passes) {
  maps_.gather = &cache_;
  maps_.query = gather_query(world_.options.finalgather, passes.records.radii);
  maps_.gather_scale = rgb(world_.options.finalgather.scale);
}

void CachedIntegrator::cache_bounces(const GatherPasses& passes, const IntegratorPreparation& p) {
  if (paths_.diffuse_bounces <= 0) return;
  GatherSettings behind = passes.records;
  behind.path.finite_lights = !plan_.global;
  const IndirectCaches caustics = maps_;
  if ((maps_.caustic || maps_.rarely_found) && !plan_.global) behind.path.maps = &caustics;
  bounces_ = gather_bounces(world_, first_gather_points(world_, p.window, passes, p.counts), behind,
                            p.seed, p.counts, p.monitor);
  use_bounces();
}

void CachedIntegrator::gather(const IntegratorPreparation& p) {
  const scene::FinalGatherOptions& options = world_.options.finalgather;
  const GatherPasses passes = gather_passes(p.seed);
  cache_bounces(passes, p);

  using Rebuild = scene::FinalGatherOptions::Rebuild;
  if (options.rebuild != Rebuild::On)
    for (const std::string& file : p.files.gather)
      if (std::filesystem::exists(file))
        if (const auto records =
                load_gather_map(file, p.diagnostics, world_.budgets[Budget::MapPoints]))
          read_files_ |= cache_.insert(*records) > 0;
  cache_.settle_radii();

  use_gather_points(passes);
  if (options.rebuild == Rebuild::Freeze && !p.files.gather.empty()) return;
  const std::size_t before = cache_.records().size();
  if (p.share) start_helpers(p);
  gather_in_passes(passes, p);
  const bool changed = cache_.records().size() > before || options.rebuild == Rebuild::On;
  if (!p.files.gather.empty() && !p.files.read_only && changed && !p.monitor.cancelled())
    save_gather_map(cache_.records(), p.files.gather.front(), p.diagnostics);
}

/// Sends what the other processes need to gather the points of the picture.
void CachedIntegrator::start_helpers(const IntegratorPreparation& p) {
  ByteWriter state;
  save_maps(state);
  p.share->from_leader(state.take());
  helped_ = true;
}

void CachedIntegrator::help(const IntegratorPreparation& p) {
  const std::string state = p.share->from_leader({});
  if (state.empty()) return;
  ByteReader in(state);
  restore_maps(in, p);
  gather_in_passes(gather_passes(p.seed), p);
}

/// Gathers the points of the picture; behind them all caches but theirs are read.
void CachedIntegrator::gather_in_passes(GatherPasses passes, const IntegratorPreparation& p) {
  IndirectCaches behind = maps_;
  behind.gather = nullptr;
  if (plan_.global || plan_.caustic || maps_.bounces) passes.records.path.maps = &behind;
  gather_for_picture(world_, p.window, passes, cache_, p.counts, p.monitor, p.after_pass, p.share);
}

template <class Out>
void CachedIntegrator::save_maps(Out& out) {
  out.value(static_cast<std::uint8_t>(read_files_));
  photons_.global.visit_state(out);
  photons_.caustic.visit_state(out);
  chains_.visit_state(out);
  rarely_found_.map.visit_state(out);
  save_cache(out, bounces_.cache);
  out.value(static_cast<std::int32_t>(bounces_.held));
  out.value(bounces_.query.radii.min);
  out.value(bounces_.query.radii.max);
  save_cache(out, cache_);
}

void CachedIntegrator::save(CheckpointWriter& out) {
  save_maps(out);
  lit_.save(out);
  learned_.visit_state(out);
  out.value(static_cast<std::uint8_t>(grid_.has_value()));
  if (grid_) grid_->save(out, world_);
}

template <class In>
void CachedIntegrator::restore_rarely_found(In& in) {
  PhotonMap map;
  map.visit_state(in);
  if (!map.is_valid()) throw CheckpointError("its photons are invalid");
  if (map.empty()) return;
  const PhotonLookup lookup = lookup_of_found_lights(world_, map);
  map.estimate_at_places(lookup);
  rarely_found_ = {SharpCaustics(world_, CausticLights::RarelyFound), std::move(map), lookup};
  maps_.rarely_found = &rarely_found_;
}

template <class In>
void CachedIntegrator::restore_maps(In& in, const IntegratorPreparation& p) {
  std::uint8_t read_files = 0;
  in.value(read_files);
  read_files_ = read_files != 0;
  for (PhotonMap* map : {&photons_.global, &photons_.caustic}) {
    map->visit_state(in);
    if (!map->is_valid()) throw CheckpointError("its photons are invalid");
  }
  chains_.visit_state(in);
  if (!chains_.is_valid(world_)) throw CheckpointError("its caustics are invalid");
  restore_rarely_found(in);
  bounces_.cache = restore_cache(in);
  std::int32_t held = 0;
  in.value(held);
  if (held < 0 || held > PathSettings::kAllBounces)
    throw CheckpointError("its gather points are invalid");
  bounces_.held = held;
  GatherRadii radii;
  in.value(radii.min);
  in.value(radii.max);
  if (!(radii.min >= 0 && radii.max >= radii.min))
    throw CheckpointError("its gather points are invalid");
  bounces_.query = bounces_query(radii);
  cache_ = restore_cache(in);
  if (plan_.sharp_caustics) sharp_ = SharpCaustics(world_);
  if (plan_.global || plan_.caustic || !sharp_.empty()) use_photon_maps();
  use_chains();
  if (plan_.gather) {
    const GatherPasses passes = gather_passes(p.seed);
    if (paths_.diffuse_bounces > 0) use_bounces();
    use_gather_points(passes);
  }
  if (plan_.bounces) {
    gather_passes(p.seed);
    if (paths_.diffuse_bounces > 0) use_bounces();
  }
}

void CachedIntegrator::restore(CheckpointReader& in, const IntegratorPreparation& p) {
  restore_maps(in, p);
  lit_.restore(in, world_);
  learned_.visit_state(in);
  if (!learned_.is_valid(world_)) throw CheckpointError("its learned light is invalid");
  std::uint8_t has_grid = 0;
  in.value(has_grid);
  if (has_grid != 0) grid_.emplace().restore(in, world_);
}

}  // namespace oriel
