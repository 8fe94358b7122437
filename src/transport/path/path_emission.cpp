// SPDX-License-Identifier: Apache-2.0
// Surfaces sampled as lights, with MIS against rays of lobes: emissive triangles, and surfaces that
// directional lights illuminate.
#include <cmath>

#include "transport/learned_lights.h"
#include "transport/path/path_walk.h"
#include "transport/scene_tracer.h"
#include "transport/shadow.h"

namespace oriel {
namespace {

/// Stream numbers; those of lobes start at 0.
constexpr std::uint32_t kEmissionBranch = 4000, kLitBranch = 4001;
/// Surfaces seen more nearly edge-on are left to rays.
constexpr float kMinCosine = 1e-5f;
/// Maximum number of transparent surfaces on a shadow ray; beyond it the light is lost.
constexpr int kMaxBlockers = 128;
/// A hit of the same instance beyond this share of the distance counts as the sampled triangle.
constexpr float kSamePlace = 1e-4f;

/// Whether lobes scatter light from behind the surface.
bool is_translucent(const Closure& closure) {
  return closure.any([](const Lobe& lobe) { return lobe.kind == LobeKind::Translucency; });
}

bool has_rays(const Closure& closure, const LobeChoice& choice, LobeGroup group) {
  for (int i = 0; i < closure.count; ++i)
    if (choice.rays[i] > 0 && !is_delta(closure.lobes[i].kind) &&
        group_of(closure.lobes[i].kind) == group)
      return true;
  return false;
}

float brightness(const Rgb& c) { return c.x + c.y + c.z; }

}  // namespace

/// Samples surfaces as lights, for the lobes whose rays also find them.
void Path::sample_surfaces(const Closure& closure, const LobeChoice& choice,
                           const ShadingPoint& point, bool on_diffuse, bool in_reflections) {
  from_.surfaces_on_diffuse = from_.surfaces_in_reflections = false;
  // Not in volumes: their shaders act on whole rays.
  if (settings_.estimator == Estimator::BsdfOnly || !world_.camera_volume.empty()) return;
  const bool emission = settings_.mesh_lights && !world_.light_sampler->mesh_lights().empty();
  if (!emission && !settings_.lit) return;
  on_diffuse = on_diffuse && has_rays(closure, choice, LobeGroup::Diffuse);
  in_reflections = in_reflections && !depth_reached(LobeKind::GlossyReflection) &&
                   has_rays(closure, choice, LobeGroup::Reflection);
  if (!on_diffuse && !in_reflections) return;
  from_.surfaces_on_diffuse = on_diffuse;
  from_.surfaces_in_reflections = in_reflections;
  if (emission) sample_emission(closure, choice, point);
  if (settings_.lit) sample_lit(closure, choice, point);
}

/// Adds one sample of the emissive triangles.
void Path::sample_emission(const Closure& closure, const LobeChoice& choice,
                           const ShadingPoint& point) {
  from_.lit = {point.position, is_translucent(closure) ? Vec3(0) : point.geometric_normal};
  from_.emitters = settings_.emitters
                       ? settings_.emitters->at(point.position, point.geometric_normal)
                       : LightChances();
  sampling::Sampler stream = sampler_.split(0, 1, kEmissionBranch);
  const Vec2 u_choice = stream.next_2d(), u_place = stream.next_2d();
  const float u_group = stream.next_1d();
  const auto sample = world_.light_sampler->sample_triangle(from_.lit, from_.emitters, point.time,
                                                            u_choice, u_place);
  if (!sample) return;
  const int instance = static_cast<int>(world_.accel->instance(sample->instance).user);
  connect(closure, choice, point, {*sample}, u_group, layer_of_instance(instance));
}

/// Adds one sample of the surfaces that directional lights illuminate.
void Path::sample_lit(const Closure& closure, const LobeChoice& choice, const ShadingPoint& point) {
  sampling::Sampler stream = sampler_.split(0, 1, kLitBranch);
  const float u_beam = stream.next_1d();
  const Vec2 u_cell = stream.next_2d(), u_light = stream.next_2d();
  ++counts_.shadow;
  const auto sample = settings_.lit->sample(point.time, u_beam, u_cell, u_light);
  if (!sample) return;
  SurfaceTarget target;
  const Vec3 to = sample->position - point.position;
  const float d2 = to.length2();
  target.distance = std::sqrt(d2);
  target.wi = to * (1 / target.distance);
  const float seen = -dot(sample->normal, target.wi), lit = dot(sample->normal, sample->to_light);
  if (!(seen * lit > 0)) return;  // the other side is lit
  target.pdf = sample->density * std::abs(lit) * area_per_angle(d2, seen);
  if (!(target.pdf > 0) || !std::isfinite(target.pdf)) return;
  target.instance = sample->instance;
  target.primitive = sample->primitive;
  target.light = sample->light;
  target.u_light = u_light;
  connect(closure, choice, point, target, stream.next_1d(), layer_of_light(target.light));
}

/// Area of a surface per solid angle; 0 if it is seen edge-on, for sampling and its weights alike.
float Path::area_per_angle(float distance2, float cosine) {
  return std::abs(cosine) > kMinCosine ? distance2 / std::abs(cosine) : 0;
}

/// The weights of directional lights at this surface, which sample_lit() may have found as well.
BesideLitSurfaces Path::beside_lit_surfaces(const ShadingPoint& point) const {
  if (!settings_.lit || !from_.sampled_surfaces() || point.instance < 0 ||
      !can_be_found(world_, static_cast<std::uint32_t>(point.instance)))
    return {};
  const float distance = from_.passed + point.ray_length;
  return {settings_.lit, from_.pdf,
          area_per_angle(distance * distance, dot(point.geometric_normal, point.ray_direction))};
}

/// Adds the light that a sampled surface sends to this vertex. It has the value that a ray of a
/// lobe would return.
void Path::connect(const Closure& closure, const LobeChoice& choice, const ShadingPoint& point,
                   const SurfaceTarget& target, float u_group, std::size_t layer) {
  const Vec3& wi = target.wi;
  const bool on_diffuse = from_.surfaces_on_diffuse;
  const bool in_reflections = from_.surfaces_in_reflections;
  const Response r = evaluate_closure(closure, choice, point, point.wo(), wi);
  const float diffuse = on_diffuse ? brightness(r.diffuse.value) : 0;
  const float reflection = in_reflections ? brightness(r.reflection.value) : 0;
  if (!(diffuse + reflection > 0)) return;
  // One ray, for one of the two groups.
  const float share = diffuse / (diffuse + reflection);
  const bool of_diffuse = u_group < share;
  const Response::Part& part = of_diffuse ? r.diffuse : r.reflection;
  const Rgb seen =
      seen_of(target, closure, point, of_diffuse ? RayKind::FinalGather : RayKind::Reflect);
  if (is_black(seen)) return;
  const float weight = light_sample_weight(settings_.estimator, target.pdf, part.pdf);
  Rgb radiance = part.value * seen * (weight / (target.pdf * (of_diffuse ? share : 1 - share)));
  Aov component = Aov::Reflection;
  if (of_diffuse) {
    radiance *= indirect_factor() * closure.indirect_scale;
    component = Aov::Translucency;
    if (dot(wi, point.geometric_normal) > 0) {
      component = Aov::Indirect;
      radiance *= light_.occlusion;
      if (light_.near_distance > 0)
        radiance *= Rgb(1) - light_.near_dark * linear_fade(target.distance, light_.near_distance);
    }
  }
  add(aov_.at_vertex(component), light_.throughput * radiance, layer);
}

/// Light of a surface that a ray of that kind would return: as walk() and pass_straight(), with
/// expected values instead of random choices.
Rgb Path::seen_of(const SurfaceTarget& target, const Closure& closure, const ShadingPoint& point,
                  RayKind kind) {
  const Vec3& wi = target.wi;
  const float distance = target.distance;
  const bool gathers = kind == RayKind::FinalGather;
  const bool straight = gathers || depth_.after_diffuse;
  MediumOnWay way = way_.medium;
  way.leave(closure, point, wi);
  if (gathers && !straight_rays_fade(world_.options)) way.ignore();
  RayCone cone = way_.cone;
  if (gathers) cone.spread = std::max(cone.spread, kDiffuseSpread);
  const std::uint32_t mask = gathers ? geom::RayMask::FinalGather : geom::RayMask::Reflection;
  // Surfaces beyond the target are not needed.
  const float reach = distance * 1.001f + 2 * point.ray_offset;
  geom::Ray ray = leave(point, wi, std::min(reach, way.reach()), mask);
  Vec3 left = point.position;
  float from_start = 0;
  Rgb kept(1);
  for (int i = 0; i < kMaxBlockers; ++i) {
    geom::Hit hit;
    ++counts_.shadow;
    if (!world_.accel->intersect(ray, hit)) return Rgb(0);
    // At the edge of a triangle rounding may hit its neighbour.
    const bool arrived =
        hit.instance == target.instance &&
        (hit.primitive == target.primitive ||
         std::abs(from_start + hit.t - distance) <= kSamePlace * distance + point.ray_offset);
    const Material& material = material_of(world_, hit);
    if (!arrived && !material.may_transmit) return Rgb(0);
    if (arrived && target.light < 0 && material.even_emission && way.medium.clear())
      return kept * *material.even_emission;
    ShadingPoint met;
    fill_point(world_, ray, hit, cone, kind, met);
    met.raster = raster_;
    met.blurred = !gathers;
    met.unbent = straight;
    cone.width = cone.width_at(hit.t);
    Closure its;
    SceneTracer tracer(world_, sampler_, counts_);
    met.tracer = &tracer;
    shade(material, met, its);
    met.tracer = nullptr;
    way.meet_surface(its, met);
    if (!way.medium.clear()) kept *= transmittance(way.medium, length(met.position - left));
    if (arrived) {
      if (target.light < 0) return kept * its.emission * its.opacity;
      if (straight) met.glossiness = its.glossiness;
      make_ready(its, met.wo());
      return kept * its.opacity *
             light_of(world_, met, its, target.light, target.u_light, !straight,
                      gathers ? maps_read_here() : caustics_, counts_);
    }

    Closure filter;
    const Closure* passed = &its;
    if (material.filters_shadows()) {
      if (!straight) return Rgb(0);
      kept *= straight_through(material, met, world_.options, filter);
      passed = &filter;
    } else {
      const Transmittance open = straight_transmission(its, world_.options);
      kept *= straight ? open.all : open.cut_outs;
    }
    if (!(max_component(kept) > 0)) return Rgb(0);
    if (straight) way.pass_straight(*passed, *passed, met, wi, straight_rays_fade(world_.options));
    const float rest = ray.tfar - hit.t;
    if (!(rest > 0)) return Rgb(0);
    ray = leave(met, wi, std::min(rest, way.reach()), mask);
    left = met.position;
    from_start += hit.t;
  }
  return Rgb(0);
}

/// MIS weight of emission that a ray hit.
float Path::emission_weight(const geom::Hit& hit, const ShadingPoint& point) const {
  if (!settings_.mesh_lights || !from_.sampled_surfaces() ||
      world_.light_sampler->mesh_lights().empty())
    return 1;
  const float pdf =
      world_.light_sampler->triangle_pdf(from_.lit, from_.emitters, hit.time, hit.instance,
                                         hit.primitive, point.position, way_.ray.dir);
  if (!(pdf > 0)) return 1;
  return bsdf_sample_weight(settings_.estimator, from_.pdf, pdf);
}

}  // namespace oriel
