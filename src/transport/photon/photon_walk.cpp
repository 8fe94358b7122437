// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/photon_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lights/portal_table.h"
#include "runtime/bump.h"
#include "transport/lobes.h"
#include "transport/path/direct.h"
#include "transport/photon/photon_choice.h"
#include "transport/ray_walk.h"
#include "transport/scene_tracer.h"
#include "transport/shadow.h"

namespace oriel {
namespace {

/// Maximum number of surfaces of a photon, including cut-outs.
constexpr int kMaxPhotonVertices = 256;
/// Sample dimensions reserved for each vertex, so that a vertex uses the same dimensions in every
/// photon.
constexpr std::uint32_t kDrawsPerPhotonVertex = 8;
/// Row number of photon streams, which no pixel has.
constexpr int kStreamRow = 0x70686f74;
constexpr float kEndless = std::numeric_limits<float>::infinity();

/// Lower bound of cosines, since photons at grazing angles would otherwise gain without bound where
/// the shading normal faces them.
constexpr float kMinPhotonCosine = 1e-3f;

/// The ray kind of a scattered photon.
RayKind scattered_as(LobeKind kind, bool crosses) {
  if (is_diffuse(kind))
    return crosses ? RayKind::PhotonTransmitDiffuse : RayKind::PhotonReflectDiffuse;
  if (is_delta(kind))
    return crosses ? RayKind::PhotonTransmitSpecular : RayKind::PhotonReflectSpecular;
  return crosses ? RayKind::PhotonTransmitGlossy : RayKind::PhotonReflectGlossy;
}

PhotonBalance::Sum precise(const Rgb& c) { return {c.x, c.y, c.z}; }

class PhotonWalk {
 public:
  PhotonWalk(const World& world, const PhotonSettings& settings, const PhotonSource& source,
             const PhotonAim& aim, int stream, std::uint32_t index, PhotonLog& log)
      : world_(world),
        settings_(settings),
        source_(source),
        aim_(aim),
        index_(index),
        log_(log),
        light_(stream - 1),
        sampler_(stream, kStreamRow, index, settings.seed),
        chain_(settings.chains ? stream - 1 : -1) {}

  void run();

 private:
  bool shade_hit(const geom::Hit& hit);
  unsigned visibility(const ShadingPoint& point) const {
    return photon_bits(world_.instances[static_cast<std::size_t>(point.instance)].visibility,
                       !settings_.globillum);
  }
  /// Whether the photon counts only if a caster scatters it next.
  bool needs_caster() const { return settings_.sharp && !scattered_; }
  /// Whether the lobe may scatter the photon.
  bool is_caster(const Lobe& lobe, const ShadingPoint& point) const {
    if (!needs_caster()) return true;
    if (is_delta(lobe.kind)) return settings_.sharp->bring(light_, point.instance, kByMirror);
    return group_of(lobe.kind) == LobeGroup::Reflection &&
           settings_.sharp->bring(light_, point.instance, kByGloss);
  }
  /// Whether photons pass the transmitting lobes of the surface straight, as shadow rays do.
  bool passes_straight(const Closure& closure, const Material& material) const {
    return material.may_transmit && !material.filters_shadows() &&
           !bends_light(closure, world_.options);
  }
  void stop() {
    log_.balance.stopped += precise(power());
    factor_ = Rgb(0);
  }
  void pass_medium(const Medium& medium, float distance);
  bool pass_volume(const Vec3& end, float length);
  void store(const ShadingPoint& point, const Rgb& power);
  float choose_lobes(const Closure& closure, const Material& material, const ShadingPoint& point,
                     LobeChoice& choice) const;
  bool continue_path(const Closure& closure, const Material& material, const ShadingPoint& point,
                     bool seen);
  bool pass_filter(Closure& closure, const Material& material, ShadingPoint& point);
  bool count_bounce(bool refracts);
  bool ask_shaders(const Closure& closure, const Material& material, ShadingPoint& point,
                   bool seen);
  void follow(const ShadingPoint& point, const Vec3& direction);
  /// The same, unbent.
  void pass(const Closure& closure, const ShadingPoint& point) {
    way_.medium.leave_volume(closure, point, way_.ray.dir);
    way_.kind = RayKind::PhotonTransparent;
    follow(point, way_.ray.dir);
  }
  Rgb as_paths_see(const Material& material, const ShadingPoint& point, const ClosureSample& sample,
                   LobeKind kind) const;
  void absorb() { lose(Rgb(0)); }
  /// Sets the factor; the difference is absorbed.
  void lose(const Rgb& left) {
    log_.balance.absorbed += precise(emitted_) * precise(factor_ - left);
    factor_ = left;
  }
  Rgb power() const { return emitted_ * factor_; }

  const World& world_;
  const PhotonSettings& settings_;
  const PhotonSource& source_;
  const PhotonAim& aim_;
  std::uint32_t index_;
  PhotonLog& log_;
  int light_;  // index into World::lights; -1: the environment
  sampling::Sampler sampler_;

  EmittedPhoton photon_;
  RayWalk way_{.kind = RayKind::PhotonLight};
  Rgb emitted_{0};  // depends on the surface until the photon was scattered
  Rgb factor_{1};
  Vec3 start_{0};
  bool scattered_ = false, specular_ = false, diffuse_ = false;
  int reflections_ = 0, refractions_ = 0;
  ChainRecorder chain_;
};

/// Absorbs in a medium. Instead of weakening, the photon is terminated at random.
void PhotonWalk::pass_medium(const Medium& medium, float distance) {
  const Rgb before = power(), t = transmittance(medium, distance);
  const float most = max_component(before);
  const float kept = most > 0 ? max_component(before * t) / most : max_component(t);
  if (sampler_.next_1d() >= kept)
    absorb();
  else
    lose(factor_ * t / kept);
}

/// Evaluates volume shaders on the segment to `end`. True: the photon was scattered and continues
/// from a point in the volume. The same volumes act on photons and on light rays.
bool PhotonWalk::pass_volume(const Vec3& end, float length) {
  const NodeList& volume = way_.medium.volume ? *way_.medium.volume : world_.light_volume;
  if (volume.empty() || !way_.medium.medium.clear()) return false;
  const bool endless = std::isinf(length);
  ShadingPoint way = way_.volume_segment(world_, way_.left, end, length);
  SceneTracer tracer(world_, sampler_, log_.counts);
  way.tracer = &tracer;
  // If an infinite volume does not act on light of infinite lights, it does not act on their
  // photons.
  if (!way_.medium.volume && !scattered_ && source_.is_endless() && !endless &&
      volume_transmittance_to_light(world_, way, -way_.ray.dir, kEndless) == Rgb(1))
    return false;
  for (const ShaderNode* node : volume) {
    const ShaderSpec& spec = node->spec();
    if (endless && !spec.volume.acts_on_endless_rays) continue;
    if (way_.medium.volume && !(spec.volume.dims_light && spec.volume.dims_light(*node))) continue;
    const VolumeValue value =
        node->with_params(way, [&](const Call& call) { return spec.volume.evaluate(call); });
    const Rgb now = power();
    const float most = max_component(now);
    if (!(most > 0)) return false;
    float turned = max_component(value.scattered * now) / most;
    float kept = max_component(value.transmittance * now) / most;
    if (turned == 0 && kept == 1) continue;
    const float all = std::max(1.0f, turned + kept);
    turned /= all, kept /= all;
    const float u = tracer.next().x;
    if (u >= turned + kept) return absorb(), false;
    if (u >= turned) {
      lose(factor_ * value.transmittance / kept);
      continue;
    }
    lose(factor_ * value.scattered / turned);
    way_.kind = RayKind::PhotonScatterVolume;
    scattered_ = diffuse_ = true;
    chain_.give_up();
    if (!settings_.globillum) stop();
    way_.leave_volume_point(value.place, value.onward, geom::RayMask::FinalGather);
    return true;
  }
  return false;
}

void PhotonWalk::store(const ShadingPoint& point, const Rgb& power) {
  const bool first = !diffuse_ && !specular_ && source_.direct();
  const bool global = (diffuse_ || first) && settings_.globillum;
  const bool caustic = !diffuse_ && specular_ && settings_.caustics;
  if (!global && !caustic) return;
  const MapPlace place = map_place(point, point.geometric_normal);
  (global ? log_.global : log_.caustic)
      .push_back({{place.position, way_.ray.dir, power, place.normal}, index_});
  if (settings_.chains && !global)
    log_.chains.push_back(chain_.to(point.ray_offset, index_,
                                    source_.is_endless() ? -photon_.direction : photon_.origin));
}

/// Probability of each lobe: the share of power that it keeps; before a caster, equal ones except
/// for glass that bends light, since varnish keeps little power. Returns their sum, at most 1.
float PhotonWalk::choose_lobes(const Closure& closure, const Material& material,
                               const ShadingPoint& point, LobeChoice& choice) const {
  const Rgb now = power();
  const float most = max_component(now);
  float total = 0;
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    if (lobe.controls.highlights_only || is_highlight(lobe.kind)) continue;
    const bool straight = transmits(lobe.kind) && passes_straight(closure, material);
    if (!is_caster(lobe, point) && !straight) continue;
    choice.rays[i] = std::max(0.0f, max_component(lobe.weight * now)) / most;
    const bool bends = is_delta(lobe.kind) && bends_light(closure, world_.options);
    if (needs_caster() && choice.rays[i] > 0 && !bends) choice.rays[i] = 1;
    total += choice.rays[i];
  }
  if (total > 1) {
    // Energy conservation of materials can be disabled.
    for (float& chance : choice.rays) chance /= total;
    total = 1;
  }
  choice.any = total > 0;
  return total;
}

/// False: the trace depth is reached.
bool PhotonWalk::count_bounce(bool refracts) {
  const scene::TraceDepth& depth = settings_.depth;
  if (reflections_ + refractions_ >= depth.sum) return false;
  return refracts ? refractions_++ < depth.refraction : reflections_++ < depth.reflection;
}

void PhotonWalk::follow(const ShadingPoint& point, const Vec3& direction) {
  std::uint32_t mask = geom::RayMask::FinalGather;
  if (!scattered_) mask |= geom::RayMask::Shadow | geom::RayMask::ShadowTransparent;
  way_.leave_surface(point, direction, way_.medium.reach(), mask);
}

/// Weight of a sample as seen by a path in the opposite direction. Lobe weights and shading normals
/// depend on the viewer, and the viewer of a photon is where it goes.
/// Source: Veach, "Non-symmetric Scattering in Light Transport Algorithms", 1997, eq. 7 and 18.
Rgb PhotonWalk::as_paths_see(const Material& material, const ShadingPoint& point,
                             const ClosureSample& sample, LobeKind kind) const {
  ShadingPoint seen = point;
  seen.ray_origin = point.position + sample.wi;
  seen.ray_direction = -sample.wi;
  if (dot(sample.wi, point.geometric_normal) < 0) {
    seen.geometric_normal = -point.geometric_normal;
    seen.normal = -point.normal;
    seen.back_side = !point.back_side;
  }
  seen.normal = facing_viewer(seen.normal, seen);
  Closure closure;
  shade_for_photons(material, seen, closure);
  make_ready(closure, sample.wi);
  const Rgb value = evaluate_closure(closure, {}, seen, sample.wi, point.wo()).of(kind).value;
  const float in = std::abs(dot(point.wo(), point.geometric_normal));
  const float out = std::abs(dot(sample.wi, point.geometric_normal));
  return value * (out / (std::max(in, kMinPhotonCosine) * sample.pdf));
}

/// Scatters, transmits straight, or absorbs. False: the photon ends.
bool PhotonWalk::continue_path(const Closure& closure, const Material& material,
                               const ShadingPoint& point, bool seen) {
  LobeChoice choice;
  const float survives = choose_lobes(closure, material, point, choice);
  float u = sampler_.next_1d();
  const Vec2 u2 = sampler_.next_2d();
  if (!choice.any || u >= survives) return absorb(), false;
  const int index = choose_lobe(closure, choice, u);
  const LobeKind kind = closure.lobes[index].kind;

  if (transmits(kind) && passes_straight(closure, material)) {
    Rgb through(0);
    float chance = 0;
    for (int i = 0; i < closure.count; ++i) {
      if (!transmits(closure.lobes[i].kind) || choice.rays[i] <= 0) continue;
      through += closure.lobes[i].weight;
      chance += choice.rays[i];
    }
    lose(factor_ * through / chance);
    way_.medium.pass_straight(closure, closure, point, way_.ray.dir,
                              straight_rays_fade(world_.options));
    pass(closure, point);
    return true;
  }

  if (!seen) return absorb(), false;
  const bool wanted = settings_.globillum || !is_diffuse(kind);
  const bool casts = needs_caster() || (visibility(point) & kCastsCaustics) != 0;
  const bool through = transmits(kind) || kind == LobeKind::Translucency;
  // Paths sample the light at a glossy surface: the way from there has no bounce.
  const bool sampled = needs_caster() && !is_delta(kind);
  if ((!sampled && !count_bounce(through)) || !wanted || !casts) {
    stop();
    return false;
  }
  const auto sample = sample_lobe(closure, choice, index, point, point.wo(), u, u2);
  if (!sample) return absorb(), false;
  // Refraction keeps the power: the radiance factor between media is omitted, as in paths.
  const bool turns = !sample->delta && group_of(kind) != LobeGroup::Refraction;
  Rgb weight = turns ? as_paths_see(material, point, *sample, kind) : sample->weight;
  if (sampled)
    weight *=
        light_in_reflection(closure, world_.lights[static_cast<std::size_t>(light_)].visible).sum();
  if (!is_finite(weight)) return absorb(), false;
  lose(factor_ * weight);
  way_.medium.leave(closure, point, sample->wi);
  chain_.add(closure.lobes[index], point, sample->wi);
  scattered_ = true;
  way_.kind = scattered_as(kind, dot(sample->wi, point.geometric_normal) < 0);
  if (is_diffuse(kind)) {
    diffuse_ = true;
    if (!straight_rays_fade(world_.options)) way_.medium.ignore();
  } else {
    specular_ = true;
  }
  follow(point, sample->wi);
  return max_component(factor_) > 0;
}

/// If shadow shaders other than the surface shader filter light, they determine the straight
/// transmission, as for paths. True: the photon is transmitted. False: the random choice was
/// against it, and the transmitting lobes are removed.
bool PhotonWalk::pass_filter(Closure& closure, const Material& material, ShadingPoint& point) {
  Closure filter;
  const Rgb through = straight_through(material, point, world_.options, filter);
  const Rgb now = power();
  Rgb other(0);
  for (int i = 0; i < closure.count; ++i) {
    Lobe& lobe = closure.lobes[i];
    if (transmits(lobe.kind)) lobe.weight = Rgb(0);
    if (!is_caster(lobe, point)) continue;
    if (!lobe.controls.highlights_only) other += lobe.weight * closure.opacity;
  }
  const float share = max_component(through * now) / max_component(now);
  float p = share / std::max(1.0f, share + max_component(other * now) / max_component(now));
  if (needs_caster() && share > 0) p = is_black(other) ? 1 : 0.5f;
  if (sampler_.next_1d() >= p) {
    lose(factor_ / (1 - p));
    return false;
  }
  lose(factor_ * through / p);
  way_.medium.pass_straight(filter, closure, point, way_.ray.dir,
                            straight_rays_fade(world_.options));
  pass(closure, point);
  return true;
}

/// Evaluates the photon shaders of the material. False: the photon ends here.
bool PhotonWalk::ask_shaders(const Closure& closure, const Material& material, ShadingPoint& point,
                             bool seen) {
  const Rgb arriving = power();
  PhotonChoice choice(sampler_, settings_.globillum);
  for (const ShaderNode* node : material.photon)
    node->with_params(
        point, [&](const Call& call) { node->spec().photon.scatter(call, arriving, choice); });
  if (choice.stored && seen && visibility(point) & kReceivesCaustics) store(point, *choice.stored);
  const PhotonChoice::Scattering& chosen = choice.scattering;
  if (choice.requests == 0) return absorb(), false;
  const bool refracts = chosen.kind >= RayKind::PhotonTransmitSpecular &&
                        chosen.kind <= RayKind::PhotonTransmitDiffuse;
  const bool straight = chosen.kind == RayKind::PhotonTransparent;
  const Rgb energy = chosen.energy * static_cast<float>(choice.requests);
  Rgb left(0);
  for (int i = 0; i < 3; ++i) left[i] = emitted_[i] > 0 ? energy[i] / emitted_[i] : 0;
  lose(left);
  if (straight) {
    pass(closure, point);
    return true;
  }
  if (!count_bounce(refracts) || !(visibility(point) & kCastsCaustics)) {
    stop();
    return false;
  }
  scattered_ = true;
  chain_.give_up();
  way_.kind = chosen.kind;
  const bool diffuse =
      way_.kind == RayKind::PhotonReflectDiffuse || way_.kind == RayKind::PhotonTransmitDiffuse;
  (diffuse ? diffuse_ : specular_) = true;
  way_.medium.ignore();  // photon shaders compute absorption themselves
  way_.medium.leave_volume(closure, point, chosen.direction);
  follow(point, chosen.direction);
  return max_component(factor_) > 0;
}

/// Handles a hit. False: the photon ends here.
bool PhotonWalk::shade_hit(const geom::Hit& hit) {
  ShadingPoint point;
  fill_point(world_, way_.ray, hit, {}, way_.kind, point);
  point.unbent = true;
  if (!(visibility(point) & kMeetsCaustics)) {
    const Vec3 left = way_.left;
    follow(point, way_.ray.dir);
    way_.left = left;  // the medium continues
    return true;
  }
  const Material& material = material_of(world_, hit);
  Closure closure;
  shade_for_photons(material, point, closure);
  if (!scattered_)
    emitted_ = source_.power(photon_, length(point.position - start_)) * aim_.share();
  if (max_component(power()) <= 0) return absorb(), false;
  if (needs_caster() && !material.may_transmit &&
      !(settings_.sharp->ways_of(light_) & settings_.sharp->ways_by(point.instance)))
    return stop(), false;
  if (source_.is_environment() && !diffuse_ &&
      is_behind_portal(world_, point.position, -way_.ray.dir, hit.t, way_.ray.time))
    return absorb(), false;

  way_.medium.meet_surface(closure, point);
  if (way_.medium.medium.clear())
    sampler_.skip();
  else
    pass_medium(way_.medium.medium, length(point.position - way_.left));
  const bool turned = pass_volume(point.position, length(point.position - way_.left));
  if (max_component(factor_) <= 0) return false;
  if (turned) return true;
  if (!material.photon.empty() && !needs_caster()) {
    const bool seen = world_.accel->instance(hit.instance).mask & geom::RayMask::FinalGather;
    return ask_shaders(closure, material, point, seen);
  }
  const bool filtered = material.may_transmit && material.filters_shadows();
  if (filtered && pass_filter(closure, material, point)) return true;
  if (sampler_.next_1d() >= closure.opacity) {
    if (filtered) return absorb(), false;
    pass(closure, point);
    return true;
  }

  // Objects that only cast shadows neither store nor scatter light.
  const bool seen = world_.accel->instance(hit.instance).mask & geom::RayMask::FinalGather;
  make_ready(closure, point.wo());
  const bool receives = seen && visibility(point) & kReceivesCaustics;
  for (int i = 0; receives && i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    if (lobe.kind != LobeKind::Diffuse && lobe.kind != LobeKind::Translucency) continue;
    if (max_component(lobe.weight) <= 0) continue;
    store(point, power());
    break;
  }
  return continue_path(closure, material, point, seen);
}

void PhotonWalk::run() {
  Vec2 u_place = sampler_.next_2d(), u_direction = sampler_.next_2d();
  aim_.aim(u_place, u_direction);
  photon_ =
      source_.emit(u_place, u_direction,
                   settings_.globillum ? RayKind::PhotonEmitGlobillum : RayKind::PhotonEmitCaustic);
  way_.ray = source_.first_ray(photon_, sampler_);
  start_ = way_.ray.org;
  way_.begin(world_);
  for (int vertex = 0; vertex < kMaxPhotonVertices; ++vertex) {
    sampler_.set_dimension(kDrawsPerPhotonVertex * static_cast<std::uint32_t>(vertex + 1));
    geom::Hit hit;
    ++log_.counts.gather;
    if (!world_.accel->intersect(way_.ray, hit)) {
      if (!scattered_) emitted_ = source_.power_unmet(photon_) * aim_.share();
      if (std::isinf(way_.ray.tfar)) {
        const bool turned = pass_volume(way_.ray.org, kEndless);
        if (max_component(factor_) <= 0) break;
        if (turned) continue;
      }
      // A ray that ends within a medium that becomes black is absorbed.
      if (std::isinf(way_.ray.tfar))
        log_.balance.escaped += precise(power());
      else
        absorb();
      break;
    }
    if (!shade_hit(hit)) break;
    if (vertex == kMaxPhotonVertices - 1) log_.balance.stopped += precise(power());
  }
  log_.balance.emitted += precise(emitted_);
  ++log_.balance.photons;
}

}  // namespace

void walk_photon(const World& world, const PhotonSettings& settings, const PhotonSource& source,
                 const PhotonAim& aim, int stream, std::uint32_t index, PhotonLog& log) {
  if (!(world.photons_part_ways && settings.globillum && settings.caustics)) {
    PhotonWalk(world, settings, source, aim, stream, index, log).run();
    return;
  }
  // The flags of the two maps differ: each map gets its own photons. The global ones are counted.
  PhotonSettings alone = settings;
  alone.caustics = false;
  PhotonWalk(world, alone, source, aim, stream, index, log).run();
  std::swap(alone.globillum, alone.caustics);
  PhotonLog other;
  PhotonWalk(world, alone, source, aim, stream, index, other).run();
  log.caustic.insert(log.caustic.end(), other.caustic.begin(), other.caustic.end());
  log.counts += other.counts;
}

}  // namespace oriel
