// SPDX-License-Identifier: Apache-2.0
// Rays cast by user shaders.
#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/environment.h"
#include "sdk/call.h"
#include "sdk/host.h"

namespace oriel::sdk {
namespace {

/// Whether another reflection or refraction is within the trace depths of the options.
bool within_depth(const miState& state, bool reflection) {
  const miOptions& o = *state.options;
  if (state.reflection_level + state.refraction_level >= o.trace_depth) return false;
  return reflection ? state.reflection_level < o.reflection_depth
                    : state.refraction_level < o.refraction_depth;
}

/// Stores the state of a ray as child of the state that cast it.
void keep_child(miState* state, const miState& child) {
  auto& children = context(state).children;
  auto found = std::find_if(children.begin(), children.end(),
                            [&](const auto& c) { return c->owner == state; });
  if (found == children.end()) {
    children.push_back(std::make_unique<OwnedChild>());
    found = children.end() - 1;
  }
  OwnedChild& own = **found;
  own = {state, child};
  own.child.child = nullptr;
  own.child.parent = state;
  state->child = &own.child;
}

/// A child state: inherited members, no hit yet.
miState child_of(const miState& state, miRay_type type) {
  miState child = state;
  child.type = type;
  inherit(state, child);
  return child;
}

/// Child state of a ray that was not cast.
void keep_missing_child(miState* state, miRay_type type) {
  miState child = child_of(*state, type);
  child.dist = 0;
  child.pri = nullptr;
  child.material = child.instance = miNULLTAG;
  keep_child(state, child);
}

/// The final state of the material at the hit. Pointers that have become invalid are replaced.
miState child_of(const miState& state, const Answer& answer) {
  miState child = answer.state;
  child.cache = state.cache;
  child.tex_list = state.tex_list;
  child.bump_x_list = state.bump_x_list;
  child.bump_y_list = state.bump_y_list;
  child.derivs = state.derivs;
  return child;
}

void describe_hit(const std::optional<Tracer::Met>& met, Host& host, miState& child) {
  child.dist = met ? met->distance : 0;
  child.pri = met ? handle_of(met->instance, met->primitive) : nullptr;
  child.material = met ? host.tag_of(met->material) : miNULLTAG;
  child.instance = met && met->instance >= 0
                       ? make_tag(TagKind::Instance, static_cast<std::size_t>(met->instance))
                       : miNULLTAG;
  if (!met) return;
  child.point = as_c(met->position);
  child.normal = as_c(met->normal);
  child.normal_geom = as_c(met->geometric_normal);
  child.inv_normal = met->back_side;
  child.dot_nd = dot(met->normal, vec(child.dir));
}

/// The environment in a direction; unset if the scene has none.
std::optional<Rgba> environment_of(miState& state, const Vec3& direction) {
  const Context& c = context(&state);
  const Material* material = c.host->material(state.material);
  const NodeList& shaders =
      material && !material->environment.empty() ? material->environment : c.world->environment;
  if (shaders.empty()) return std::nullopt;
  const CallerScope caller(Caller::of_ray(&state));
  return environment_radiance(shaders, *c.world, vec(state.point), direction, RayKind::Environment);
}

/// mi_ray_falloff: hits fade to the environment linearly from `start` to `stop`.
void fade(Tracer::Seen& seen, miState& state, const Vec3& direction) {
  const Context& c = context(&state);
  if (!seen.met || c.falloff_stop <= c.falloff_start || seen.met->distance <= c.falloff_start)
    return;
  const auto start = static_cast<float>(c.falloff_start), stop = static_cast<float>(c.falloff_stop);
  const float share = clamp01((seen.met->distance - start) / (stop - start));
  const Rgba far = environment_of(state, direction).value_or(Rgba(0, 0, 0, 0));
  seen.colour = seen.colour * (1 - share) + far * share;
}

/// Traces a ray with the settings of the state.
bool cast(miColor* result, miState* state, RayKind kind, const Vec3& direction,
          const Tracer::Depth& depth) {
  Context& c = context(state);
  *result = {0, 0, 0, 0};
  if (!c.tracer()) {
    keep_missing_child(state, static_cast<miRay_type>(kind));
    return false;
  }
  const ShadingPoint point = point_of(state);
  Tracer::SubRay ray{kind, normalize(direction), state->pri != nullptr, point.position, depth};
  if (c.falloff_stop > 0) ray.reach = static_cast<float>(c.falloff_stop);
  if (c.ray_offset > 0) {
    ray.origin = point.position + ray.direction * static_cast<float>(c.ray_offset);
    ray.from_surface = false;
  }
  leave_overdue_shader();
  std::optional<Answer> answer;
  Tracer::Seen seen;
  {
    const CallerScope caller(Caller::of_ray(state, &answer));
    seen = c.tracer()->trace(point, ray);
  }
  fade(seen, *state, ray.direction);

  // Behind a built-in material the ray may run a user material that is not at the first hit.
  const bool answered = answer && seen.met && answer->position == seen.met->position;
  miState child =
      answered ? child_of(*state, *answer) : child_of(*state, static_cast<miRay_type>(kind));
  child.org = as_c(ray.from_surface ? point.position : ray.origin);
  child.dir = as_c(ray.direction);
  child.reflection_level = depth.reflections;
  child.refraction_level = depth.refractions;
  describe_hit(seen.met, *c.host, child);
  keep_child(state, child);
  *result = as_c(seen.colour);
  return seen.met || seen.colour != Rgba(0, 0, 0, 0);
}

/// Traces a reflection or refraction ray with increased depth; transparency counts as refraction.
miBoolean cast_deeper(miColor* result, miState* state, RayKind kind, const Vec3& direction) {
  const bool reflection = kind == RayKind::Reflect;
  if (!within_depth(*state, reflection)) {
    *result = {0, 0, 0, 0};
    keep_missing_child(state, static_cast<miRay_type>(kind));
    return miFALSE;
  }
  const Tracer::Depth depth = {state->reflection_level + (reflection ? 1 : 0),
                               state->refraction_level + (reflection ? 0 : 1), state->importance};
  return cast(result, state, kind, direction, depth) ? miTRUE : miFALSE;
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miBoolean mi_trace_environment(miColor* result, miState* state, const miVector* direction) {
  const std::optional<Rgba> seen = environment_of(*state, normalize(vec(*direction)));
  *result = seen ? as_c(*seen) : miColor{0, 0, 0, 0};
  return seen ? miTRUE : miFALSE;
}

miBoolean mi_trace_reflection(miColor* result, miState* state, const miVector* direction) {
  if (state->options->trace) return cast_deeper(result, state, RayKind::Reflect, vec(*direction));
  *result = {0, 0, 0, 0};
  keep_missing_child(state, miRAY_REFLECT);
  return miFALSE;
}

miBoolean mi_trace_transparent(miColor* result, miState* state) {
  return cast_deeper(result, state, RayKind::Transparent, vec(state->dir));
}

miBoolean mi_trace_refraction(miColor* result, miState* state, const miVector* direction) {
  if (!state->options->trace) return mi_trace_transparent(result, state);
  return cast_deeper(result, state, RayKind::Refract, vec(*direction));
}

miBoolean mi_trace_continue(miColor* result, miState* state) {
  return cast(result, state, context(state).point->ray_kind, vec(state->dir),
              {state->reflection_level, state->refraction_level, state->importance})
             ? miTRUE
             : miFALSE;
}

miBoolean mi_trace_eye(miColor* result, miState* state, const miVector* origin,
                       const miVector* direction) {
  Context& c = context(state);
  state->org = *origin;
  state->dir = *direction;
  *result = {0, 0, 0, 0};
  if (!c.lens) return miFALSE;
  const Vec3 along = normalize(vec(*direction));
  LensNext::Seen seen;
  {
    const CallerScope caller(Caller::of_ray(state));
    seen = c.lens->trace(vec(*origin), along);
  }
  *result = as_c(seen.colour);
  state->dist = seen.distance;
  state->point = as_c(vec(*origin) + along * seen.distance);
  state->normal = as_c(seen.normal);
  keep_child(state, child_of(*state, miRAY_EYE));
  return seen.distance > 0 || seen.colour != Rgba(0, 0, 0, 0) ? miTRUE : miFALSE;
}

miBoolean mi_trace_probe(miState* state, const miVector* direction, const miVector* origin) {
  Context& c = context(state);
  if (!c.tracer()) {
    keep_missing_child(state, miRAY_PROBE);
    return miFALSE;
  }
  const Vec3 d = normalize(vec(*direction));
  // A probe that starts at the hit of the previous probe continues from there.
  const miState* const last = state->child;
  const bool goes_on = last && last->pri && vec(*origin) == vec(last->point);
  const ShadingPoint point = point_of(goes_on ? last : state);
  const float reach = std::numeric_limits<float>::infinity();
  // From the shading point itself, the ray needs the offset from its surface.
  const bool here = goes_on || (vec(*origin) == point.position && state->pri);
  std::optional<Tracer::Met> met;
  {
    const CallerScope caller(Caller::of_ray(state));
    met =
        here ? c.tracer()->probe_from(point, d, reach) : c.tracer()->probe(vec(*origin), d, reach);
  }
  miState child = child_of(*state, miRAY_PROBE);
  child.org = *origin;
  child.dir = as_c(d);
  describe_hit(met, *c.host, child);
  keep_child(state, child);
  return met ? miTRUE : miFALSE;
}

miBoolean mi_trace_shadow(miColor* result, miState* state) {
  // The renderer traces shadow rays itself. The call only records that the light has shadows; a
  // second call of the light shader with black shadows determines the unshadowed part of its light.
  Context& c = context(state);
  c.shadow_asked = true;
  if (!c.shadow_is_black) return miTRUE;
  *result = {0, 0, 0, result->a};
  return miFALSE;
}

// The renderer iterates over shadow segments in all shadow modes and passes each shader the
// remaining light, so these functions have nothing to do.
miBoolean mi_trace_shadow_seg(miColor*, miState*) { return miTRUE; }
miBoolean mi_continue_shadow_seg(miColor*, miState*) { return miTRUE; }

void mi_ray_offset(const miState* state, double* offset) {
  std::swap(context(state).ray_offset, *offset);
}

void mi_ray_falloff(const miState* state, double* start, double* stop) {
  std::swap(context(state).falloff_start, *start);
  std::swap(context(state).falloff_stop, *stop);
}

miBoolean mi_opacity_set(miState* state, const miColor* opacity) {
  Context& c = context(state);
  c.opacity = *opacity;
  c.opacity_known = true;
  return miTRUE;
}

miBoolean mi_opacity_get(miState* state, miColor* opacity) {
  const Context& c = context(state);
  if (!c.opacity_known) return miFALSE;
  *opacity = c.opacity;
  return miTRUE;
}

void mi_ray_differential_transform(const miState*, ...) {}

}  // extern "C"
