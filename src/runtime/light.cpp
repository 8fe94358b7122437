// SPDX-License-Identifier: Apache-2.0
#include "runtime/light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/math.h"
#include "color/luminance.h"
#include "geom/shapes.h"
#include "runtime/moved_light.h"
#include "runtime/world.h"
#include "sampling/rectangle.h"
#include "sampling/sphere.h"
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

std::optional<ShapeSample> sample_flat(const Light& light, const Vec3& from, Vec2 u) {
  ShapeSample s;
  if (light.shape == LightShape::Rectangle && has_square_corners(light)) {
    const Vec3 corner = light.position - light.edge_u * 0.5f - light.edge_v * 0.5f;
    const sampling::SphericalRectangle rectangle(from, corner, light.edge_u, light.edge_v);
    const auto r = rectangle.sample(u);
    s = {r.point, r.wi, r.distance, -dot(r.wi, light.direction), r.pdf};
  } else {
    const Vec2 d = light.shape == LightShape::Rectangle ? u - Vec2(0.5f)
                                                        : sampling::sample_disc(u) * light.radius;
    s.position = light.position + light.edge_u * d.x + light.edge_v * d.y;
    const Vec3 to = s.position - from;
    s.distance = length(to);
    s.wi = normalize(to);
    s.cosine = -dot(s.wi, light.direction);
    s.pdf = s.cosine > 0 ? sqr(s.distance) / (light.area * s.cosine) : 0;
  }
  if (!(s.cosine > 1e-6f) || !(s.pdf > 0) || !std::isfinite(s.pdf)) return std::nullopt;
  return s;
}

std::optional<ShapeSample> sample_round(const Light& light, const Vec3& from, Vec2 u) {
  ShapeSample s;
  if (light.shape == LightShape::Sphere) {
    const sampling::SphereCone cone(from, light.position, light.radius);
    if (!(cone.pdf() > 0)) return std::nullopt;
    s.wi = cone.sample(u);
    s.pdf = cone.pdf();
    const auto hit =
        geom::intersect(geom::Sphere{light.position, light.radius}, from, s.wi, 0.0f, kInfinity);
    // A ray at the very rim may miss by rounding: take the closest point there.
    s.distance = hit ? hit->t : std::max(0.0f, dot(light.position - from, s.wi));
    s.position = from + s.wi * s.distance;
  } else {
    const float half = length(light.edge_u);
    const Frame frame(light.edge_u * (1 / half));
    const float phi = kTwoPi * u.x;
    const Vec3 radial = frame.s * math::cos(phi) + frame.t * math::sin(phi);
    s.position = light.position + frame.n * (half * (2 * u.y - 1)) + radial * light.radius;
    const Vec3 to = s.position - from;
    s.distance = length(to);
    s.wi = normalize(to);
    const float cosine = -dot(s.wi, radial);
    if (!(cosine > 1e-6f)) return std::nullopt;
    s.pdf = sqr(s.distance) / (kTwoPi * light.radius * 2 * half * cosine);
  }
  s.cosine = 1;
  return s;
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
  const auto s = portal.table ? sample_through(light, from, u) : sample_flat(light, from, u);
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
    if (light.emitter && !light.emitter->spec().emit)
      shader = light.emitter;
    else
      kind = RayKind::Light;
  }
  if (!shader) return {};
  const LightCall call{light, position, direction, distance, emitter_cos};
  const ShaderSpec& spec = shader->spec();
  const RayKind before = std::exchange(point.ray_kind, kind);
  LightValue value;
  if (spec.light)
    value = shader->with_params(point, [&](const Call& c) { return spec.light(c, call); });
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
    if (const ShaderSpec& spec = node->spec(); spec.dims_light && spec.dims_light(*node))
      kept *= node->with_params(way, [&](const Call& call) { return spec.volume(call); }).kept;
  return kept;
}

bool has_square_corners(const Light& light) {
  const float uu = dot(light.edge_u, light.edge_u), vv = dot(light.edge_v, light.edge_v);
  return sqr(dot(light.edge_u, light.edge_v)) <= 1e-6f * uu * vv;
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

/// Of a light at rest; the air is left out. `moved`: where it is in truth, null: there.
std::optional<LightSample> sample_still(const Light& light, ShadingPoint& point, Vec2 u,
                                        RayKind kind, const MovedLight* moved = nullptr) {
  const Vec3& p = point.position;
  if (light.portal) return sample_portal(light, p, u, moved);
  LightSample sample;
  if (light.shape == LightShape::Directional || light.shape == LightShape::Point) {
    if (light.shape == LightShape::Directional) {
      Vec3 direction = light.direction;
      if (light.cone_angle > 0)
        direction = Frame(light.direction)
                        .to_world(sampling::sample_cone(
                            u, sampling::one_minus_cos(sqr(math::sin(light.cone_angle)))));
      sample.wi = -direction;
      sample.distance = kInfinity;
    } else {
      const Vec3 to = light.position - p;
      sample.distance = length(to);
      if (!(sample.distance > 0)) return std::nullopt;
      sample.wi = to * (1 / sample.distance);
    }
    const LightValue value =
        ask_light_shader(light, point, light.position, -sample.wi, sample.distance, 1, kind);
    if (light.placed_by_shader && value.origin) {
      const Vec3 to = *value.origin - p;
      sample.distance = length(to);
      if (!(sample.distance > 0)) return std::nullopt;
      sample.wi = to * (1 / sample.distance);
    }
    sample.irradiance = value.colour * kPi;
    sample.shadow = value.shadow;
    sample.shadow_factor = value.shadow_factor;
    sample.affects_diffuse = value.affects_diffuse;
    sample.affects_specular = value.affects_specular;
    sample.force_specular = value.force_specular;
    sample.is_sun = value.is_sun;
  } else {
    const auto s = is_flat(light.shape) ? sample_flat(light, p, u) : sample_round(light, p, u);
    if (!s || !(s->distance > 0)) return std::nullopt;
    const LightValue value =
        ask_light_shader(light, point, s->position, -s->wi, s->distance, s->cosine, kind);
    sample.wi = s->wi;
    sample.distance = s->distance;
    sample.pdf = s->pdf;
    sample.irradiance = radiance_of(light, value.colour, s->wi, s->distance, s->cosine) / s->pdf;
    sample.shadow = value.shadow;
    sample.shadow_factor = value.shadow_factor;
    sample.affects_diffuse = value.affects_diffuse;
    sample.affects_specular = value.affects_specular;
    sample.force_specular = value.force_specular;
    sample.is_sun = value.is_sun;
  }
  if (is_black(sample.irradiance)) return std::nullopt;
  sample.reach = sample.distance;
  return sample;
}

std::optional<LightHit> intersect_still(const Light& light, ShadingPoint& from,
                                        const Vec3& direction, float t_most, RayKind kind,
                                        const MovedLight* moved = nullptr) {
  const Vec3& o = from.position;
  std::optional<geom::ShapeHit> hit;
  LightHit result;
  float cosine = 1;
  switch (light.shape) {
    case LightShape::Point:
    case LightShape::Directional:
      return std::nullopt;
    case LightShape::Rectangle: {
      cosine = -dot(direction, light.direction);
      if (!(cosine > 1e-6f)) return std::nullopt;
      const Vec3 corner = light.position - light.edge_u * 0.5f - light.edge_v * 0.5f;
      hit =
          geom::intersect(geom::Rectangle{light.position, light.edge_u * 0.5f, light.edge_v * 0.5f},
                          o, direction, 0.0f, t_most);
      if (!hit) return std::nullopt;
      if (light.portal && light.portal->table)
        result.pdf = pdf_through(light, o, direction);
      else
        result.pdf = has_square_corners(light)
                         ? sampling::SphericalRectangle(o, corner, light.edge_u, light.edge_v)
                               .pdf(direction, hit->t)
                         : sqr(hit->t) / (light.area * cosine);
      break;
    }
    case LightShape::Disc:
      cosine = -dot(direction, light.direction);
      if (!(cosine > 1e-6f)) return std::nullopt;
      hit = geom::intersect(
          geom::Disc{light.position, light.edge_u * light.radius, light.edge_v * light.radius}, o,
          direction, 0.0f, t_most);
      if (!hit) return std::nullopt;
      result.pdf = sqr(hit->t) / (light.area * cosine);
      break;
    case LightShape::Sphere:
      hit = geom::intersect(geom::Sphere{light.position, light.radius}, o, direction, 0.0f, t_most);
      if (!hit) return std::nullopt;
      result.pdf = sampling::SphereCone(o, light.position, light.radius).pdf();
      break;
    case LightShape::Cylinder: {
      const float half = length(light.edge_u);
      hit = geom::intersect(geom::Cylinder{light.position, light.edge_u, light.radius}, o,
                            direction, 0.0f, t_most);
      if (!hit) return std::nullopt;
      const float facing = -dot(direction, hit->n);
      if (!(facing > 1e-6f)) return std::nullopt;
      result.pdf = sqr(hit->t) / (kTwoPi * light.radius * 2 * half * facing);
      break;
    }
  }
  result.t = hit->t;
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
