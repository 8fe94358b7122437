// SPDX-License-Identifier: Apache-2.0
// A vertex of a path: direct light, the choice of lobes, splitting.
#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>

#include "base/math.h"
#include "bsdf/ggx.h"
#include "bsdf/glossy_reflection.h"
#include "transport/learned_lights.h"
#include "transport/path/occlusion.h"
#include "transport/path/path_walk.h"
#include "transport/shadow.h"

namespace oriel {
namespace {

/// The survival probability of Russian roulette is this power of the throughput. The throughput
/// itself terminates too many of the paths that light dark corners. Of 1, 1/2, 1/3, 1/5 and 1/10,
/// 1/3 had the smallest product of relative squared error and instructions in rooms: .77 of that of
/// 1 (bench/cycles).
constexpr float kRoulettePower = 1.0f / 3;
/// A path continues with kContinuation times the share of the expected indirect light that it still
/// brings, at least kLeastContinuation. Of .3, .5, .8 and 1.2, 1.2 had the smallest product of
/// squared error and time in a box and in a room lit by the sky.
constexpr float kContinuation = 1.2f, kLeastContinuation = 0.2f;
/// The path splits if two lobes have at least this share of the reflected light: choosing one of
/// them would add noise to the other. A guess; .1 to .3 differ little.
constexpr float kShareOfOwnRay = 0.2f;
/// Spread that a glossy bounce adds to the ray cone, per unit of roughness (radians). An estimate
/// that filters textures less than the lobe would.
constexpr float kSpreadPerRoughness = 0.5f;
/// Larger than any distance, scene units.
constexpr float kFarAway = 1e30f;

bool has_diffuse(const Closure& closure) {
  return closure.any([](const Lobe& lobe) { return lobe.kind == LobeKind::Diffuse; });
}

/// Whether reflection rays have a maximum distance or a single look-up of the environment. Such
/// rays get no MIS weight against samples of the environment.
bool limits_reflections(const Closure& closure) {
  return closure.any([](const Lobe& lobe) {
    return lobe.type == LobeType::Reflection &&
           (lobe.controls.falloff_distance > 0 || lobe.controls.single_environment);
  });
}

float falloff_distance(const Closure& closure) {
  for (int i = 0; i < closure.count; ++i)
    if (closure.lobes[i].type == LobeType::Reflection)
      return closure.lobes[i].controls.falloff_distance;
  return 0;
}

/// The AOV of the first surface for light along a ray of the lobe.
Aov part_of(LobeKind kind) {
  if (kind == LobeKind::Diffuse) return Aov::Indirect;
  if (kind == LobeKind::Translucency) return Aov::Translucency;
  return group_of(kind) == LobeGroup::Reflection ? Aov::Reflection : Aov::Refraction;
}

/// The visibility flag that an instance needs to send rays of a lobe that is not diffuse.
unsigned sending(const Lobe& lobe) {
  if (lobe.type == LobeType::Reflection) return kSendsReflections;
  const bool thin = lobe.kind == LobeKind::ThinTransmission || lobe.kind == LobeKind::GlossyThin;
  return thin ? kSendsTransparency : kSendsRefractions;
}

}  // namespace

bool Path::depth_reached(LobeKind kind) const {
  const scene::TraceDepth& depth = depth_.after_diffuse && settings_.depth_behind
                                       ? *settings_.depth_behind
                                       : world_.options.trace_depth;
  if (depth_.reflections + depth_.refractions >= depth.sum) return true;
  return transmits(kind) ? depth_.refractions >= depth.refraction
                         : depth_.reflections >= depth.reflection;
}

/// Selection weights of the lobes. Reflections that may not send rays keep only their highlights;
/// such refractions become black.
void Path::choose_lobes(Closure& closure, LobeChoice& choice, const ShadingPoint& point,
                        bool diffuse) const {
  // Lights that shine through a translucent solid count as direct light.
  const bool looks_through =
      !settings_.indirect && !closure.thin_walled && !point.back_side && !depth_.after_diffuse;
  for (int i = 0; i < closure.count; ++i) {
    Lobe& lobe = closure.lobes[i];
    if (lobe.controls.highlights_only) continue;
    if (!world_.options.trace) continue;
    if (is_diffuse(lobe.kind) && !diffuse &&
        !(looks_through && lobe.kind == LobeKind::Translucency))
      continue;
    if (!is_diffuse(lobe.kind)) {
      const bool reflection = lobe.type == LobeType::Reflection;
      const bool cut = !depth_.after_diffuse &&
                       depth_.importance * max_component(lobe.weight) < lobe.controls.cutoff;
      // Beyond the material's refraction depth rays are black; beyond the scene's trace depth they
      // see the environment.
      const bool deep =
          lobe.controls.depth > 0 &&
          (reflection ? depth_.reflections : depth_.refractions) >= lobe.controls.depth;
      if (cut || deep || !allows(sending(lobe))) {
        // A reflection beyond its depth behaves as with highlights only, including gathered light.
        if (reflection)
          lobe.controls.highlights_only = true,
          lobe.controls.emulated = deep && allows(kSendsReflections);
        else
          lobe.weight = Rgb(0);
        continue;
      }
    }
    // The sum of channels: with luminance, few rays would pass blue glass.
    choice.rays[i] = std::max(0.0f, lobe.weight.x + lobe.weight.y + lobe.weight.z);
    // Less than one ray reduces the selection weight of diffuse lobes; more rays split the path.
    if (lobe.kind == LobeKind::Diffuse) choice.rays[i] *= clamp(lobe.controls.samples, 0.05f, 1);
  }
  choice.share_one_ray(closure.count);
}

/// How the environment is sampled at this vertex.
EnvironmentChances Path::environment_chances(const Material& material) const {
  if (!indirect() || !material.environment.empty()) return {};
  return world_.light_sampler->environment_chances(from_.lights, depth_.after_diffuse,
                                                   settings_.estimator == Estimator::LightOnly);
}

/// Number of rays of one path at the first surface, if the pixel gets `samples` in all.
int Path::rays_at_first(float samples, float importance) const {
  const float wanted = samples * std::min(importance, 1.0f) / settings_.paths_of_pixel;
  return std::max(1, static_cast<int>(std::ceil(wanted - 1e-3f)));
}

/// Whether the path splits at the first surface into rays of each lobe: if one lobe needs more than
/// one ray, or if two lobes have a large share. Diffuse lobes with less than one ray are chosen.
bool Path::split(const Closure& closure, LobeChoice& choice) const {
  if (!at_eye_surface() || !choice.any) return false;
  float rays[Closure::kMaxLobes] = {};
  int large = 0;
  bool splits = false;
  for (int i = 0; i < closure.count; ++i) {
    if (choice.rays[i] <= 0) continue;
    const Lobe& lobe = closure.lobes[i];
    const bool fewer = lobe.kind == LobeKind::Diffuse && lobe.controls.samples < 1;
    if (choice.rays[i] >= kShareOfOwnRay && !fewer) ++large;
    int n = 1;
    if (lobe.kind == LobeKind::Diffuse)
      n = std::max(choice.rays[i] >= kShareOfOwnRay && !fewer ? settings_.diffuse_rays : 1,
                   static_cast<int>(std::lround(lobe.controls.samples)));  // for every path
    else if (!is_delta(lobe.kind))
      n = rays_at_first(lobe.controls.samples, max_component(lobe.weight));
    rays[i] = static_cast<float>(n);
    splits |= n > 1;
  }
  splits |= large > 1;
  if (splits) std::copy(std::begin(rays), std::end(rays), std::begin(choice.rays));
  return splits;
}

/// Computes ambient occlusion at this vertex, and adds ambient light.
void Path::occlude(const Closure& closure, const ShadingPoint& point) {
  light_.occlusion = Rgb(1);
  light_.near_distance = 0;
  const Occlusion& o = closure.occlusion;
  if (o.samples <= 0 || !has_diffuse(closure)) return;
  const bool dims = o.details > 0 && indirect() && !depth_.after_diffuse;
  if (dims && o.details > 1) {
    light_.near_dark = o.dark;
    light_.near_distance = o.distance > 0 ? o.distance : kFarAway;
  }
  const bool tells = record_->aovs && aov_.at_surface;
  if (is_black(o.ambient) && !tells && !(dims && o.details == 1)) return;
  Rgb level(0);
  Vec3 normal = point.normal;
  for (int i = 0; i < closure.count; ++i)
    if (closure.lobes[i].kind == LobeKind::Diffuse) {
      level += closure.lobes[i].weight;
      normal = closure.lobes[i].frame.n;
    }
  const int rays = at_eye_surface() ? rays_at_first(static_cast<float>(o.samples), 1) : 1;
  const float free = free_share(world_, point, normal, o.distance, rays, sampler_, counts_);
  const Rgb open = Rgb(free) + o.dark * (1 - free);
  add(aov_.at_vertex(Aov::Diffuse), light_.throughput * level * o.ambient * open, layer_of_rest());
  if (record_->observer) record_->observer->on_occlusion(place_, o, free);
  if (dims && o.details == 1) light_.occlusion = open;
  if (!tells) return;
  record_->aovs->occlusion = o.details > 1 ? Rgb(1) - o.dark * (1 - free) : open;
  if (dims) record_->aovs->dimming = record_->aovs->occlusion;
}

/// Adds direct light of lights and environment at this vertex.
void Path::take_direct(const Closure& closure, const LobeChoice& choice, ShadingPoint& point,
                       bool diffuse) {
  const DirectRequest request{.environment_on_diffuse = diffuse,
                              .environment_in_reflections = !limits_reflections(closure),
                              .rays_bend = !depth_.after_diffuse,
                              .for_the_eye = !depth_.after_diffuse,
                              .portals_mapped = reads_photons(),
                              .falloff_distance = falloff_distance(closure),
                              .estimator = settings_.estimator,
                              .observer = depth_.after_diffuse ? nullptr : record_->observer,
                              .place = place_,
                              .beside = beside_lit_surfaces(point),
                              .mapped = caustics_};
  if (record_->has_layers()) return take_direct_of_layers(closure, choice, point, request);
  add_direct(closure,
             direct_light(world_, point, closure, choice, from_.lights, request, sampler_, counts_),
             0);
}

/// The same split by light layers. A function of its own, since the shares are large.
void Path::take_direct_of_layers(const Closure& closure, const LobeChoice& choice,
                                 ShadingPoint& point, const DirectRequest& request) {
  DirectShares shares;
  direct_light(world_, point, closure, choice, from_.lights, request, sampler_, counts_, &shares);
  for (int i = 0; i < shares.count; ++i) {
    const DirectShares::Share& share = shares.of[static_cast<std::size_t>(i)];
    add_direct(closure, share.light, share.layer);
  }
}

void Path::add_direct(const Closure& closure, const DirectLight& light, std::size_t layer) {
  const auto bring = [&](Aov c, const Rgb& radiance) {
    if (!is_black(radiance)) add(aov_.at_vertex(c), light_.throughput * radiance, layer);
  };
  const Rgb indirect = indirect_factor() * closure.indirect_scale;
  bring(Aov::Diffuse, light.diffuse);
  if (!caustics_are_mapped()) {
    bring(Aov::Specular, light.specular);
    bring(Aov::Reflection, light.reflection);
    bring(Aov::Refraction, light.refraction);
  }
  bring(Aov::Translucency, light.translucency + light.environment_translucency * indirect);
  bring(Aov::Indirect, light.environment * light_.occlusion * indirect);
}

void Path::leave_diffusely(float indirect_scale, LobeKind kind) {
  light_.throughput *= indirect_factor();
  way_.kind = RayKind::FinalGather;
  caustics_ = maps_read_here();
  depth_.after_diffuse = true;
  way_.blurred = false;
  depth_.reflections = depth_.refractions = 0;
  if (!straight_rays_fade(world_.options)) way_.medium.ignore();
  way_.cone.spread = std::max(way_.cone.spread, kDiffuseSpread);
  ++depth_.bounces;
  ++depth_.diffuse_bounces;
  light_.throughput *= indirect_scale;
  if (kind == LobeKind::Diffuse)
    light_.throughput *= light_.occlusion;
  else
    light_.near_distance = 0;
  way_.to_far_side = !settings_.indirect;
}

void Path::scatter(const Closure& closure, const Material& material, ShadingPoint& point,
                   const ClosureSample& sample) {
  const Lobe& lobe = closure.lobes[sample.lobe];
  const bool crosses = dot(sample.wi, point.geometric_normal) < 0;
  if (record_->observer) place_ = record_->observer->on_scatter(place_, lobe.kind);
  way_.medium.leave(closure, point, sample.wi);
  if (closure.thin_walled && transmits(lobe.kind)) way_.veil = closure.inside;
  way_.reach = kInfinity;
  light_.lights = light_.throughput = light_.throughput * sample.weight;
  depth_.importance *= max_component(lobe.weight);
  switch (lobe.kind) {
    case LobeKind::Diffuse:
    case LobeKind::Translucency:
      leave_diffusely(closure.indirect_scale, lobe.kind);
      break;
    case LobeKind::Mirror:
    case LobeKind::GlossyReflection:
    case LobeKind::Sheen:
      way_.kind = RayKind::Reflect;
      ++depth_.reflections;
      break;
    case LobeKind::ThinTransmission:
    case LobeKind::GlossyThin:
      way_.kind = RayKind::Transparent;
      ++depth_.refractions;
      break;
    default:
      // Total internal reflection counts as refraction of the material, as its weight does.
      way_.kind = crosses ? RayKind::Refract : RayKind::Reflect;
      ++depth_.refractions;
      break;
  }
  if (!sample.delta && way_.kind != RayKind::FinalGather) {
    way_.blurred = true;
    way_.cone.spread += kSpreadPerRoughness * std::max(lobe.alpha_x, lobe.alpha_y);
    ++depth_.bounces;
  }
  if (way_.kind != RayKind::FinalGather) light_.near_distance = 0;
  eye_hit_.alpha_open &= closure.propagate_alpha && transmits(lobe.kind);
  if (aov_.at_surface) aov_.part = part_of(lobe.kind);
  aov_.leaving = aov_.at_surface;
  aov_.at_surface = false;

  way_.environment = material.environment.empty() ? nullptr : &material.environment;
  const bool glossy = lobe.kind == LobeKind::GlossyReflection;
  const float alpha = glossy ? std::sqrt(lobe.alpha_x * lobe.alpha_y) : 0;
  // At grazing angles a lobe is narrower in one direction; a round lobe of the same area is used.
  way_.roughness = alpha * std::sqrt(std::abs(dot(point.wo(), lobe.frame.n)));
  from_.weighed = !sample.delta;
  const bool casts = sample.delta || group_of(lobe.kind) == LobeGroup::Reflection;
  from_.caster = casts ? point.instance : -1;
  from_.caster_way = sample.delta ? kByMirror : kByGloss;
  from_.pdf = sample.pdf;
  from_.group = group_of(lobe.kind);
  from_.passed = way_.volume_passed = 0;
  const LobeControls& controls = lobe.controls;
  fading_ = {controls.falloff_distance,
             controls.falloff_to_color,
             controls.single_environment,
             grid_ && controls.interpolate && controls.detail_distance > 0,
             controls.falloff_color,
             Vec3(0),
             nullptr};
  if (controls.single_environment)
    fading_.mirrored =
        bsdf::main_direction(bsdf::reflect(point.wo(), lobe.frame.n), lobe.frame.n, alpha);
  follow(point, sample.wi);
}

bool Path::russian_roulette() {
  if (depth_.bounces < kRouletteDepth) return max_component(light_.throughput) > 0;
  const float p = clamp(math::pow(max_component(light_.throughput), kRoulettePower), 0.05f, 0.95f);
  if (sampler_.next_1d() >= p) return false;
  dim(Rgb(1 / p));
  return true;
}

/// Ends the path at random where the light that it would still find is known approximately. The
/// path adds that light in any case; paths that continue subtract it again, such that the mean is
/// that of their own light.
bool Path::end_with_expected(const Rgb& expected) {
  if (is_black(depth_.expected)) {
    depth_.expected = expected;
    return false;
  }
  float share = 0;  // the largest of the channels
  for (int c = 0; c < 3; ++c)
    if (expected[c] > 0) share = std::max(share, expected[c] / depth_.expected[c]);
  const float p = clamp(kContinuation * share, kLeastContinuation, 1);
  const bool ends = sampler_.next_1d() >= p;
  add(aov_.at_vertex(Aov::Indirect), expected * (ends ? 1.0f : 1 - 1 / p), layer_of_rest());
  if (!ends) dim(Rgb(1 / p));
  return ends;
}

/// Lets the diffuse lobes follow the guide if all have the same normal.
void Path::guide(const Closure& closure, LobeChoice& choice, const ShadingPoint& point) const {
  const Lobe* first = nullptr;
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    if (lobe.kind != LobeKind::Diffuse) continue;
    if (first && first->frame.n != lobe.frame.n) return;
    first = &lobe;
  }
  if (first) choice.guide = settings_.guide->at(point.position, first->frame.n);
}

/// Samples a lobe and continues. Without MIS weights the ray sees lights and environment as a
/// mirror ray does. False: the path ends here.
bool Path::continue_path(const Closure& closure, const LobeChoice& choice, const Material& material,
                         ShadingPoint& point, int index, float u_rest, bool weighed) {
  const Lobe& lobe = closure.lobes[index];
  const bool expects = choice.guide && lobe.kind == LobeKind::Diffuse && !record_->has_layers();
  if (expects &&
      end_with_expected(light_.throughput * lobe.weight * choice.guide.light() * light_.occlusion *
                        indirect_factor() * (closure.indirect_scale / choice.rays[index])))
    return false;
  const auto sample =
      sample_lobe(closure, choice, index, point, point.wo(), u_rest, sampler_.next_2d());
  if (!sample) return false;
  const LobeKind kind = closure.lobes[sample->lobe].kind;
  const bool too_deep = !is_diffuse(kind) && depth_reached(kind);
  if (group_of(kind) == LobeGroup::Reflection && limits_reflections(closure))
    from_.lights.environment = {};
  scatter(closure, material, point, *sample);
  from_.weighed &= weighed;
  // A single look-up represents the whole lobe; each of many rays represents its share of the solid
  // angle.
  if (!fading_.single_environment)
    way_.roughness /= std::sqrt(std::max(1.0f, choice.rays[index]) * settings_.paths_of_pixel);
  if (too_deep) {
    AtLights lights = AtLights::Passed;
    if (world_.has_area_lights) lights = meet_lights(kInfinity);
    if (lights == AtLights::Scattered) return russian_roulette();
    way_.kind = RayKind::Environment;  // no ray was traced
    if (lights == AtLights::Passed) meet_environment();
    return false;
  }
  return expects || russian_roulette();
}

/// The lights that this vertex samples.
void Path::place_lit_vertex(const Closure& closure, const ShadingPoint& point) {
  // Constructed in place, since the object is large.
  std::construct_at(&from_.lights, world_, point, closure);
  if (settings_.lights)
    from_.lights.chances = settings_.lights->at(point.position, point.geometric_normal);
}

/// Adds the light at a vertex and continues the path. False: the path ends here.
bool Path::shade_vertex(Closure& closure, const Material& material, ShadingPoint& point) {
  LobeChoice choice;
  make_ready(closure, point.wo());
  occlude(closure, point);
  const bool mapped = reads_maps();
  // The diffuse lobe and emulated reflections share one look-up.
  looked_up_.valid = false;
  looked_up_.directional = mapped && closure.any([](const Lobe& lobe) {
    return lobe.controls.emulated && lobe.controls.highlights_only;
  });
  const bool diffuse = !(mapped && take_mapped(closure, point)) && indirect();
  choose_lobes(closure, choice, point, diffuse);
  if (mapped) emulate(closure, point);
  interpolate(closure, material, point, choice);
  if (diffuse && settings_.guide) guide(closure, choice, point);
  const bool splits = split(closure, choice);
  point.glossiness = closure.glossiness;
  point.importance = std::min(1.0f, depth_.importance);
  if (settings_.finite_lights)
    place_lit_vertex(closure, point);
  else
    std::construct_at(&from_.lights);
  from_.lights.environment = environment_chances(material);
  const bool scatters_light = closure.any([](const Lobe& lobe) { return !is_delta(lobe.kind); });
  if (scatters_light && !eye_hit_.features_seen && !from_.weighed) {
    eye_hit_.features_seen = true;
    record_->normal = point.normal;
    record_->albedo = closure.albedo;
  }
  if (scatters_light && (!from_.lights.empty() || from_.lights.environment.samples > 0))
    take_direct(closure, choice, point, diffuse || (reads_photons() && !reads_bounces()));
  if (scatters_light && choice.any)
    sample_surfaces(closure, choice, point, diffuse,
                    !limits_reflections(closure) && !caustics_are_mapped());
  else
    from_.surfaces_on_diffuse = from_.surfaces_in_reflections = false;
  if (!choice.any) return false;

  from_.point = &point;
  from_.shadows = receives_shadows(world_, point);
  from_.invisible = light_in_reflection(closure, false);
  from_.visible = light_in_reflection(closure, true);
  from_.hidden_portal = hidden_portal_in_reflection(closure);
  if (!splits) {
    float u = 0;
    if (closure.count == 1 && is_diffuse(closure.lobes[0].kind))
      sampler_.skip();  // only one choice
    else
      u = sampler_.next_1d();
    const int lobe = choose_lobe(closure, choice, u);
    return continue_path(closure, choice, material, point, lobe, u);
  }
  for (int i = 0; i < closure.count; ++i) {
    const auto rays = static_cast<std::uint32_t>(choice.rays[i]);
    std::optional<Rgb> looked_up;  // shared by all rays that hit nothing
    for (std::uint32_t j = 0; j < rays; ++j) {
      static_assert(std::is_trivially_copyable_v<Path>, "one copy, not one for each member");
      Path branch = *this;
      branch.sampler_ = sampler_.split(j, rays, static_cast<std::uint32_t>(i));
      if (!branch.continue_path(closure, choice, material, point, i, branch.sampler_.next_1d()))
        continue;
      ++branch.depth_.vertex;
      branch.fading_.looked_up = &looked_up;
      branch.walk();
    }
  }
  return false;
}

}  // namespace oriel
