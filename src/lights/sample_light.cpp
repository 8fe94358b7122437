// SPDX-License-Identifier: Apache-2.0
#include "lights/sample_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/math.h"
#include "lights/moved_light.h"
#include "lights/portal_table.h"
#include "runtime/world.h"
#include "sampling/warp.h"

namespace oriel {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The area over which a light spreads what it sends along wi's opposite. What a profile measured
/// is for the cylinder as seen from there, else cylinders send as their shader says on the mean.
float sending_area(const Light& light, const Vec3& wi) {
  if (light.shape != LightShape::Cylinder || !light.profile_placement) return light.area;
  const float half = length(light.edge_u);
  return 4 * light.radius * half * std::max(1e-3f, length(cross(wi, light.edge_u)) / half);
}

/// Radiance of a shape toward a point at `distance` in the direction -wi, from the shader's colour
/// there: the mean of pi * colour over the shape must be the irradiance.
Rgb radiance_of(const Light& light, const Rgb& colour, const Vec3& wi, float distance,
                float emitter_cos) {
  return colour * (kPi * sqr(distance) / (sending_area(light, wi) * std::max(emitter_cos, 1e-6f)));
}

/// The environment does not move with a portal: `moved` as below.
Rgb radiance_behind(const Light& light, const MovedLight* moved, const Vec3& from, const Vec3& wi,
                    float distance, float cosine, RayKind kind) {
  if (!moved) return portal_radiance(light, from, wi, distance, cosine, kind);
  return portal_radiance(light, moved->place(from), moved->direction(wi), distance, cosine, kind);
}

std::optional<LightSample> sample_portal(const Light& light, const Vec3& from, Vec2 u,
                                         const MovedLight* moved) {
  const Portal& portal = *light.portal;
  const auto s =
      is_sampled_by_table(portal) ? sample_through(light, from, u) : sample_shape(light, from, u);
  if (!s || !(s->distance > 0)) return std::nullopt;
  const Rgb radiance =
      radiance_behind(light, moved, from, s->wi, s->distance, s->cosine, RayKind::Light);
  if (is_black(radiance)) return std::nullopt;
  LightSample sample;
  sample.wi = s->wi;
  sample.distance = s->distance;
  sample.reach = std::max(0.0f, s->distance + portal.shadow_extension);
  sample.irradiance = radiance / s->pdf;
  // A ray meets other blockers than those that count.
  sample.pdf = portal.shadow_extension == 0 ? s->pdf : 0;
  sample.shadow = portal.shadows;
  return sample;
}

}  // namespace

LightValue ask_light_shader(const Light& light, ShadingPoint& point, const Vec3& position,
                            const Vec3& direction, float distance, float emitter_cos,
                            RayKind kind) {
  const ShaderNode* shader = light.shader;
  if (is_photon(kind)) {
    // The shader of direct light tells of photons what it tells of that.
    if (light.emitter && !light.emitter->spec().photon.emit)
      shader = light.emitter;
    else
      kind = RayKind::Light;
  }
  if (!shader) return {};
  const LightCall call{light, position, direction, distance, emitter_cos};
  const ShaderSpec& spec = shader->spec();
  const RayKind before = std::exchange(point.ray_kind, kind);
  LightValue value;
  if (spec.light.evaluate)
    value = shader->with_params(point, [&](const Call& c) { return spec.light.evaluate(c, call); });
  else if (spec.value)
    value.colour = rgb(shader->color(point));
  point.ray_kind = before;
  return value;
}

Rgb volume_transmittance_to_light(const World& world, const ShadingPoint& point, const Vec3& wi,
                                  float distance) {
  if (world.light_volume.empty()) return Rgb(1);
  return volume_transmittance(world, world.light_volume, point.position, wi, distance);
}

Rgb volume_transmittance(const World& world, const NodeList& volume, const Vec3& at, const Vec3& wi,
                         float distance) {
  Rgb kept(1);
  ShadingPoint way;
  way.ray_kind = RayKind::Light;
  way.position = at;
  way.normal = way.geometric_normal = wi;
  way.ray_origin = std::isinf(distance) ? at : at + wi * distance;
  way.ray_direction = -wi;
  way.ray_length = distance;
  way.world = &world;
  for (const ShaderNode* node : volume)
    if (const ShaderSpec& spec = node->spec();
        spec.volume.dims_light && spec.volume.dims_light(*node))
      kept *= node->with_params(way, [&](const Call& call) { return spec.volume.evaluate(call); })
                  .transmittance;
  return kept;
}

namespace {

/// What a light that moves lights, as the light has it at rest.
ShadingPoint at_rest(const MovedLight& moved, const ShadingPoint& point) {
  ShadingPoint rest(point);
  rest.position = moved.place_at_rest(point.position);
  rest.ray_origin = moved.place_at_rest(point.ray_origin);
  rest.ray_direction = moved.direction_at_rest(point.ray_direction);
  rest.normal = moved.normal_at_rest(point.normal);
  rest.geometric_normal = moved.normal_at_rest(point.geometric_normal);
  return rest;
}

/// What a sample has of the shader's value.
void take_value(const LightValue& value, LightSample& sample) {
  sample.shadow = value.shadow;
  sample.shadow_factor = value.shadow_factor;
  sample.affects_diffuse = value.affects_diffuse;
  sample.affects_specular = value.affects_specular;
  sample.force_specular = value.force_specular;
  sample.is_sun = value.is_sun;
}

}  // namespace

Vec3 direction_to(const Light& light, Vec2 u) {
  if (!(light.cone_angle > 0)) return -light.direction;
  const float width = sampling::one_minus_cos(sqr(math::sin(light.cone_angle)));
  return -Frame(light.direction).to_world(sampling::sample_cone(u, width));
}

namespace {

/// Lights without extent. Returns false where the light does not reach the point.
bool sample_sharp(const Light& light, ShadingPoint& point, Vec2 u, RayKind kind,
                  LightSample& sample) {
  const auto place = [&](const Vec3& origin) {
    const Vec3 to = origin - point.position;
    sample.distance = length(to);
    if (!(sample.distance > 0)) return false;
    sample.wi = to * (1 / sample.distance);
    return true;
  };
  if (light.shape == LightShape::Directional) {
    sample.wi = direction_to(light, u);
    sample.distance = kInfinity;
  } else if (!place(light.position)) {
    return false;
  }
  const LightValue value =
      ask_light_shader(light, point, light.position, -sample.wi, sample.distance, 1, kind);
  if (value.origin && !place(*value.origin)) return false;
  sample.irradiance = value.colour * kPi;
  take_value(value, sample);
  return true;
}

/// Lights with an extent. Returns false where the light does not reach the point.
bool sample_extended(const Light& light, ShadingPoint& point, Vec2 u, RayKind kind,
                     LightSample& sample) {
  const auto s = sample_shape(light, point.position, u);
  if (!s || !(s->distance > 0)) return false;
  const LightValue value =
      ask_light_shader(light, point, s->position, -s->wi, s->distance, s->cosine, kind);
  sample.wi = s->wi;
  sample.distance = s->distance;
  sample.pdf = s->pdf;
  sample.irradiance = radiance_of(light, value.colour, s->wi, s->distance, s->cosine) / s->pdf;
  take_value(value, sample);
  return true;
}

/// Samples a light at its written placement, without volumes. `moved`: its actual placement; null:
/// the same.
std::optional<LightSample> sample_still(const Light& light, ShadingPoint& point, Vec2 u,
                                        RayKind kind, const MovedLight* moved = nullptr) {
  if (light.portal) return sample_portal(light, point.position, u, moved);
  LightSample sample;
  if (!(has_extent(light.shape) ? sample_extended(light, point, u, kind, sample)
                                : sample_sharp(light, point, u, kind, sample)) ||
      is_black(sample.irradiance))
    return std::nullopt;
  sample.reach = sample.distance;
  return sample;
}

std::optional<LightHit> intersect_still(const Light& light, ShadingPoint& from,
                                        const Vec3& direction, float t_most, RayKind kind,
                                        const MovedLight* moved = nullptr) {
  const Vec3& o = from.position;
  const auto hit = intersect_shape(light, o, direction, t_most);
  if (!hit) return std::nullopt;
  const float cosine = is_flat(light.shape) ? hit->facing : 1;
  LightHit result;
  result.t = hit->t;
  result.pdf = light.portal && is_sampled_by_table(*light.portal)
                   ? pdf_through(light, o, direction)
                   : shape_pdf(light, o, direction, *hit);
  if (light.portal) {
    result.radiance = radiance_behind(light, moved, o, direction, hit->t, cosine, kind);
    result.shadow = light.portal->shadows && light.portal->shadow_extension == 0;
    return result;
  }
  const LightValue value =
      ask_light_shader(light, from, o + direction * hit->t, -direction, hit->t, cosine, kind);
  result.radiance = radiance_of(light, value.colour, direction, hit->t, cosine);
  result.shadow = value.shadow;
  result.affects_diffuse = value.affects_diffuse;
  result.affects_specular = value.affects_specular;
  result.force_specular = value.force_specular;
  return result;
}

}  // namespace

std::optional<LightSample> sample_light(const Light& light, ShadingPoint& point, Vec2 u,
                                        RayKind kind) {
  std::optional<LightSample> sample;
  if (is_at_rest(light, point.time)) {
    sample = sample_still(light, point, u, kind);
    if (!sample) return sample;
  } else {
    const MovedLight moved(light, point.time);
    ShadingPoint rest = at_rest(moved, point);
    sample = sample_still(light, rest, u, kind, &moved);
    if (!sample) return sample;
    if (std::isfinite(sample->distance)) {
      const float beyond = sample->reach - sample->distance;
      sample->distance *= moved.stretch(sample->wi);
      sample->reach = std::max(0.0f, sample->distance + beyond);
    }
    if (has_extent(light.shape)) {
      const float crowding = moved.crowding(sample->wi);
      sample->pdf *= crowding;
      sample->irradiance /= crowding;
    }
    sample->wi = moved.direction(sample->wi);
  }
  if (kind == RayKind::Light && point.world && !light.portal)
    sample->irradiance *=
        volume_transmittance_to_light(*point.world, point, sample->wi, sample->distance);
  return sample;
}

std::optional<LightHit> intersect_light(const Light& light, ShadingPoint& from,
                                        const Vec3& direction, float t_most, RayKind kind) {
  std::optional<LightHit> hit;
  if (is_at_rest(light, from.time)) {
    hit = intersect_still(light, from, direction, t_most, kind);
    if (!hit) return hit;
  } else {
    const MovedLight moved(light, from.time);
    ShadingPoint rest = at_rest(moved, from);
    const Vec3 at_rest = moved.direction_at_rest(direction);
    const float stretch = moved.stretch(at_rest);
    hit = intersect_still(light, rest, at_rest, t_most / stretch, kind, &moved);
    if (!hit) return hit;
    hit->t *= stretch;
    hit->pdf *= moved.crowding(at_rest);
  }
  if (kind == RayKind::Light && from.world && !light.portal)
    hit->radiance *= volume_transmittance_to_light(*from.world, from, direction, hit->t);
  return hit;
}

}  // namespace oriel
