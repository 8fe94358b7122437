// SPDX-License-Identifier: Apache-2.0
// Light along a ray that does not come from surfaces: lights with a shape, the environment, and the
// end of limited reflections.
#include "lights/portal_table.h"
#include "runtime/environment_ray.h"
#include "transport/path/path_walk.h"
#include "transport/shadow.h"

namespace oriel {
namespace {

/// Whether a diffuse ray ends at a portal before t. Photons carry the light of portals, so light
/// behind them must not be added again.
bool ends_at_portal(const World& world, const geom::Ray& ray, float t) {
  return portals_on_way(world, ray.org, ray.dir, t, ray.time, true).ends_diffuse;
}

/// The place where a ray was `passed` ago, not on a surface, for lights that the ray hits.
ShadingPoint point_in_air(const World& world, const geom::Ray& ray, float passed) {
  ShadingPoint point;
  point.position = ray.org - ray.dir * passed;
  point.time = ray.time;
  point.world = &world;
  return point;
}

}  // namespace

/// Whether the ray ends at a portal that it hits from inside.
bool Path::ends_at(const Portal& portal) const {
  return way_.kind == RayKind::FinalGather ? portal.blocks_diffuse_rays() : portal.visible;
}

/// Adds light of a light source that a lobe sample hit, with its MIS weight.
void Path::add_found(const LightInReflection& in, float kept, const Rgb& arriving, const Rgb& view,
                     std::size_t layer) {
  if (from_.group == LobeGroup::Reflection) {
    add(aov_.after_vertex(Aov::Reflection), arriving * view * (in.as_reflection * kept), layer);
    add(aov_.after_vertex(Aov::Specular), arriving * in.as_highlight, layer);
  } else {
    // Light sources count as direct light of diffuse lobes for both sampling methods.
    add(aov_.after_vertex(aov_.part == Aov::Indirect ? Aov::Diffuse : aov_.part), arriving * view,
        layer);
  }
}

/// Adds lights with a shape that the ray hits before the surface. A visible light ends rays that
/// see it as an object (camera and mirrors), behind the volume on the way. Rays of glossy and
/// diffuse lobes add its weighted light and continue, since lights cast no shadows on each other.
/// Portals end those rays as well: their light includes everything behind them.
Path::AtLights Path::meet_lights(float t_surface) {
  if (!settings_.finite_lights)
    return way_.kind == RayKind::FinalGather && ends_at_portal(world_, way_.ray, t_surface)
               ? AtLights::Ended
               : AtLights::Passed;
  if (caustics_are_mapped() && way_.kind != RayKind::FinalGather) return AtLights::Passed;
  const bool sees = !from_.weighed;
  float nearest = t_surface;
  Rgb seen(0);
  int seen_light = -1;
  // Visible portals show their own colour to the camera, hidden portals the scene behind them.
  const bool dims = way_.kind != RayKind::FinalGather && !depth_.after_diffuse;
  const auto own_view = [&](const Light& light) {
    return dims && light.portal && light.portal->visible ? light.portal->transparency : Rgb(1);
  };
  const auto view_to = [&](float t) {
    if (!dims || !world_.has_tinted_portals) return Rgb(1);
    return portals_on_way(world_, way_.ray.org, way_.ray.dir, t * kShortOfPortal, way_.ray.time)
        .view;
  };
  const auto end_at = [&](const Light& light) {
    ShadingPoint origin = point_in_air(world_, way_.ray, 0);
    return intersect_light(light, origin, way_.ray.dir, nearest, way_.kind);
  };
  const auto meet = [&](int index) {
    const Light& light = world_.lights[static_cast<std::size_t>(index)];
    if (light.shape == LightShape::Point) return;
    const Portal* portal = light.portal.get();
    // With many portals most are missed, so this test comes before the expensive ones.
    if (portal && !crosses_portal(light, way_.ray.org, way_.ray.dir, t_surface, way_.ray.time))
      return;
    if (sees || portal) {
      const bool ends = portal ? ends_at(*portal) : light.visible;
      const auto hit = ends ? end_at(light) : std::nullopt;
      if (hit) {
        nearest = hit->t;
        seen = sees && !is_mapped_caustic(index) ? hit->radiance * own_view(light) : Rgb(0);
        seen_light = index;
      }
      if (sees) return;
    }
    if (portal && !portal->visible && from_.group == LobeGroup::Refraction) return;
    bool alone = portal && portal->photons_only && portal->visible;  // never sampled
    const float expected = world_.light_sampler->expected_samples(from_.lights, index);
    if ((expected <= 0 && !alone) || is_mapped_caustic(index)) return;
    std::optional<ShadingPoint> unsampled;
    if (!from_.point) unsampled = point_in_air(world_, way_.ray, from_.passed);
    ShadingPoint& from = from_.point ? *from_.point : *unsampled;
    auto hit = intersect_light(light, from, way_.ray.dir, from_.passed + t_surface);
    if (!hit || hit->t < from_.passed) return;
    if (portal && portal->visible && way_.kind != RayKind::FinalGather && is_black(hit->radiance)) {
      // Samples below the threshold are black, but the surface remains visible.
      hit = intersect_light(light, from, way_.ray.dir, from_.passed + t_surface, way_.kind);
      if (!hit) return;
      alone = true;
    }
    if (!alone && (!hit->shadow || !from_.shadows)) return;
    if (shadowed_by_unseen(world_, from, way_.ray.dir, hit->t, counts_)) return;
    const float weight =
        alone ? 1.0f : bsdf_sample_weight(settings_.estimator, from_.pdf, hit->pdf * expected);
    const Rgb arriving = light_.lights * hit->radiance * from_.affected(*hit) *
                         kept_over(hit->t - from_.passed) * weight;
    const Rgb view = own_view(light) * view_to(hit->t - from_.passed);
    add_found(from_.shown(light, *hit), fading_.kept(hit->t), arriving, view,
              layer_of_light(index));
  };
  world_.light_sampler->for_each_on_way(way_.ray.org, way_.ray.dir, t_surface, meet);
  const bool ended = seen_light >= 0;
  const bool dimmed = dims && world_.has_tinted_portals;
  if (!ended && !dimmed) return AtLights::Passed;
  const Rgb view = view_to(nearest);
  if (!ended) {
    dim(view);
    return AtLights::Passed;
  }
  return end_at_light(seen_light, nearest, seen * view);
}

/// Ends a ray at a light at distance t whose radiance it sees, behind the volume on the way.
Path::AtLights Path::end_at_light(int light, float t, const Rgb& radiance) {
  const Rgb seen = radiance * kept_over(t);
  if (eye_hit_.pending) record_->alpha = 1;
  // Through a portal a ray leaves the scene. Visitors are shown surfaces along straight rays.
  if (!visitor_ && !world_.lights[static_cast<std::size_t>(light)].portal &&
      pass_volume(way_.ray.org + way_.ray.dir * t, from_.passed + t)) {
    eye_hit_.pending = eye_hit_.alpha_open = false;
    return AtLights::Scattered;
  }
  const float kept = fading_.kept(t);
  add(aov_.on_way(), light_.throughput * seen * kept, layer_of_light(light));
  if (kept < 1) add(aov_.on_way(), light_.throughput * faded_to() * (1 - kept), layer_of_faded());
  // Final gather rays see a black wall instead of a portal.
  if (eye_hit_.pending && from_.weighed) record_->depth = t;
  return AtLights::Ended;
}

Rgb Path::reflected_environment(const Vec3& direction) {
  const NodeList& shaders = way_.environment ? *way_.environment : world_.environment;
  if (shaders.empty()) return Rgb(0);
  ++counts_.environment;
  return rgb(environment_radiance(shaders, world_,
                                  {way_.ray.org, direction, environment_kind(RayKind::Environment),
                                   raster_, way_.blurred, way_.roughness}));
}

/// The radiance that a limited reflection fades to.
Rgb Path::faded_to() {
  if (fading_.to_color) return fading_.color;
  if (!fading_.single_environment) return reflected_environment(way_.ray.dir);
  if (fading_.looked_up && *fading_.looked_up) return **fading_.looked_up;
  const Rgb found = reflected_environment(fading_.mirrored);
  if (fading_.looked_up) *fading_.looked_up = found;
  return found;
}

std::size_t Path::layer_of_faded() const {
  if (!fading_.to_color) return layer_of_environment();
  return fading_.of_grid ? world_.light_layers.unknown() : layer_of_rest();
}

/// Ambient occlusion with colours: reduces the light of nearby surfaces on diffuse rays.
void Path::darken_near(float t) {
  if (light_.near_distance > 0)
    light_.throughput *= Rgb(1) - light_.near_dark * linear_fade(t, light_.near_distance);
  light_.near_distance = 0;
}

/// Fades a limited reflection at a surface at distance t.
void Path::fade(float t) {
  if (fading_.distance > 0) {
    const float kept = fading_.kept(t);
    add(aov_.on_way(), light_.throughput * (1 - kept) * faded_to(), layer_of_faded());
    dim(Rgb(kept));
  }
  fading_ = {};
}

void Path::meet_environment() {
  if (caustics_are_mapped() && way_.kind != RayKind::FinalGather) return;
  if (fading_.distance > 0 || fading_.single_environment)
    return add(aov_.on_way(), light_.throughput * faded_to(), layer_of_faded());
  const NodeList& shaders = way_.environment ? *way_.environment : world_.environment;
  const bool alpha_counts = eye_hit_.pending || eye_hit_.alpha_open;
  if (shaders.empty()) return alpha_counts ? pass_to_background(0) : void();
  ++counts_.environment;
  const EnvironmentRay ray{.origin = way_.ray.org,
                           .direction = way_.ray.dir,
                           .kind = environment_kind(way_.kind),
                           .raster = raster_,
                           .blurred = way_.blurred,
                           .roughness = way_.roughness};
  // What light sampling sees of it, if this is the environment that it samples.
  const bool own = way_.environment != nullptr;
  const bool gathers = ray.kind == RayKind::FinalGather;
  const bool weighed = from_.weighed && from_.lights.environment.samples > 0 && !own;
  LightSampler::EnvironmentFound seen;
  if (!own && (gathers || weighed))
    seen = world_.light_sampler->find_environment(weighed ? &from_.lights : nullptr, ray);
  Rgb radiance = seen.radiance;
  const EnvironmentTable& table = world_.light_sampler->environment().table();
  const bool evaluated = own || !(gathers || (weighed && table.is_fine_for(from_.pdf)));
  if (evaluated || alpha_counts) {
    const Rgba c = environment_radiance(shaders, world_, ray);
    if (alpha_counts) pass_to_background(clamp01(c.a));
    if (evaluated) radiance = rgb(c);
  }
  if (weighed) {
    // Radiance that light sampling can find gets a MIS weight; the rest is added in full. Nothing
    // was sampled in the shadow of objects that this ray does not see.
    const bool alone = shadowed_by_unseen(world_, *from_.point, ray.direction, kInfinity, counts_);
    const float weight =
        alone ? 1.0f : bsdf_sample_weight(settings_.estimator, from_.pdf, seen.pdf);
    radiance -= seen.radiance * (1 - weight);
  }
  add(aov_.on_way(), light_.throughput * radiance, layer_of_environment());
}

/// The alpha of a camera ray that ends at an environment with that alpha.
void Path::pass_to_background(float alpha) {
  if (eye_hit_.pending)
    record_->alpha = alpha;
  else
    record_->alpha -= (1 - alpha) * mean_of(light_.throughput);
}

}  // namespace oriel
