// SPDX-License-Identifier: Apache-2.0
#include "lights/light_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/frame.h"
#include "base/math.h"
#include "geom/shapes.h"
#include "sampling/rectangle.h"
#include "sampling/sphere.h"
#include "sampling/warp.h"

namespace oriel {
namespace {

/// Flat and round surfaces seen more nearly edge-on than this emit nothing.
constexpr float kMinFacing = 1e-6f;

Vec3 corner_of(const Light& light) {
  return light.position - light.edge_u * 0.5f - light.edge_v * 0.5f;
}

std::optional<ShapeSample> sample_flat(const Light& light, const Vec3& from, Vec2 u) {
  ShapeSample s;
  if (!(dot(from - light.position, light.direction) > 0)) return std::nullopt;  // at its back
  if (light.shape == LightShape::Rectangle && light.axes.square_corners) {
    const sampling::SphericalRectangle rectangle(from, corner_of(light), light.axes);
    const auto r = rectangle.sample(u);
    s = {r.point, r.wi, r.distance, -dot(r.wi, light.direction), r.pdf};
  } else {
    s.position = point_on_shape(light, u).position;
    const Vec3 to = s.position - from;
    s.distance = length(to);
    s.wi = normalize(to);
    s.cosine = -dot(s.wi, light.direction);
    s.pdf = s.cosine > 0 ? sqr(s.distance) / (light.area * s.cosine) : 0;
  }
  if (!(s.cosine > kMinFacing) || !(s.pdf > 0) || !std::isfinite(s.pdf)) return std::nullopt;
  return s;
}

std::optional<ShapeSample> sample_sphere(const Light& light, const Vec3& from, Vec2 u) {
  ShapeSample s;
  const sampling::SphereCone cone(from, light.position, light.radius);
  if (!(cone.pdf() > 0)) return std::nullopt;
  s.wi = cone.sample(u);
  s.pdf = cone.pdf();
  const auto hit = geom::intersect(geom::Sphere{light.position, light.radius}, from, s.wi, 0.0f,
                                   std::numeric_limits<float>::infinity());
  // A ray at the very rim may miss by rounding: take the closest point there.
  s.distance = hit ? hit->t : std::max(0.0f, dot(light.position - from, s.wi));
  s.position = from + s.wi * s.distance;
  s.cosine = 1;
  return s;
}

std::optional<ShapeSample> sample_cylinder(const Light& light, const Vec3& from, Vec2 u) {
  ShapeSample s;
  const float half = length(light.edge_u);
  const Frame frame(light.edge_u * (1 / half));
  const float phi = kTwoPi * u.x;
  const Vec3 radial = frame.s * math::cos(phi) + frame.t * math::sin(phi);
  s.position = light.position + frame.n * (half * (2 * u.y - 1)) + radial * light.radius;
  const Vec3 to = s.position - from;
  s.distance = length(to);
  s.wi = normalize(to);
  const float facing = -dot(s.wi, radial);
  if (!(facing > kMinFacing)) return std::nullopt;
  s.pdf = sqr(s.distance) / (kTwoPi * light.radius * 2 * half * facing);
  s.cosine = 1;
  return s;
}

}  // namespace

std::optional<ShapeSample> sample_shape(const Light& light, const Vec3& from, Vec2 u) {
  if (is_flat(light.shape)) return sample_flat(light, from, u);
  return light.shape == LightShape::Sphere ? sample_sphere(light, from, u)
                                           : sample_cylinder(light, from, u);
}

std::optional<LightShapeHit> intersect_shape(const Light& light, const Vec3& from,
                                             const Vec3& direction, float t_most) {
  std::optional<geom::ShapeHit> hit;
  float facing = 1;
  switch (light.shape) {
    case LightShape::Point:
    case LightShape::Directional:
      return std::nullopt;
    case LightShape::Rectangle:
    case LightShape::Disc:
      facing = -dot(direction, light.direction);
      if (!(facing > kMinFacing)) return std::nullopt;
      if (light.shape == LightShape::Rectangle)
        hit = geom::intersect(
            geom::Rectangle{light.position, light.edge_u * 0.5f, light.edge_v * 0.5f}, from,
            direction, 0.0f, t_most);
      else
        hit = geom::intersect(
            geom::Disc{light.position, light.edge_u * light.radius, light.edge_v * light.radius},
            from, direction, 0.0f, t_most);
      break;
    case LightShape::Sphere:
      hit = geom::intersect(geom::Sphere{light.position, light.radius}, from, direction, 0.0f,
                            t_most);
      break;
    case LightShape::Cylinder:
      hit = geom::intersect(geom::Cylinder{light.position, light.edge_u, light.radius}, from,
                            direction, 0.0f, t_most);
      if (!hit) return std::nullopt;
      facing = -dot(direction, hit->n);
      if (!(facing > kMinFacing)) return std::nullopt;
      break;
  }
  if (!hit) return std::nullopt;
  return LightShapeHit{hit->t, facing};
}

float shape_pdf(const Light& light, const Vec3& from, const Vec3& direction,
                const LightShapeHit& hit) {
  switch (light.shape) {
    case LightShape::Rectangle:
      if (light.axes.square_corners)
        return sampling::SphericalRectangle(from, corner_of(light), light.axes)
            .pdf(direction, hit.t);
      return sqr(hit.t) / (light.area * hit.facing);
    case LightShape::Disc:
      return sqr(hit.t) / (light.area * hit.facing);
    case LightShape::Sphere:
      return sampling::SphereCone(from, light.position, light.radius).pdf();
    case LightShape::Cylinder:
      return sqr(hit.t) / (kTwoPi * light.radius * 2 * length(light.edge_u) * hit.facing);
    default:
      return 0;
  }
}

Vec3 half_size(const Light& light) {
  Vec3 half(0);
  for (int k = 0; k < 3; ++k) {
    const float u = std::abs(light.edge_u[k]), v = std::abs(light.edge_v[k]);
    switch (light.shape) {
      case LightShape::Rectangle:
        half[k] = (u + v) / 2;
        break;
      case LightShape::Disc:
        half[k] = light.radius * math::hypot(u, v);
        break;
      case LightShape::Cylinder:
        half[k] = u + light.radius;
        break;
      default:
        half[k] = light.radius;
    }
    // Rays must not miss the box by rounding.
    half[k] += 1e-5f * (std::abs(light.position[k]) + light.radius + u + v);
  }
  return half;
}

ShapePoint point_on_shape(const Light& light, Vec2 u) {
  if (light.shape == LightShape::Rectangle)
    return {light.position + light.edge_u * (u.x - 0.5f) + light.edge_v * (u.y - 0.5f),
            light.direction, light.area};
  if (light.shape == LightShape::Disc) {
    const Vec2 d = sampling::sample_disc(u) * light.radius;
    return {light.position + light.edge_u * d.x + light.edge_v * d.y, light.direction, light.area};
  }
  if (light.shape == LightShape::Sphere) {
    const Vec3 normal = sampling::sample_uniform_sphere(u);
    return {light.position + normal * light.radius, normal, 4 * kPi * sqr(light.radius)};
  }
  const float half = length(light.edge_u);
  const Frame axis(light.edge_u * (1 / half));
  const float phi = kTwoPi * u.x;
  const Vec3 normal = axis.s * math::cos(phi) + axis.t * math::sin(phi);
  return {light.position + light.edge_u * (2 * u.y - 1) + normal * light.radius, normal,
          kTwoPi * light.radius * 2 * half};
}

std::optional<SeenPoint> point_seen_along(const Light& light, const Vec3& direction, Vec2 u) {
  switch (light.shape) {
    case LightShape::Rectangle:
    case LightShape::Disc: {
      const Vec2 d = light.shape == LightShape::Rectangle ? u - Vec2(0.5f)
                                                          : sampling::sample_disc(u) * light.radius;
      return SeenPoint{light.position + (light.edge_u * d.x + light.edge_v * d.y),
                       light.area * std::max(0.0f, dot(direction, light.direction))};
    }
    case LightShape::Sphere: {
      const Frame frame(direction);
      const Vec2 d = sampling::sample_disc(u);
      const float height = std::sqrt(std::max(0.0f, 1 - d.x * d.x - d.y * d.y));
      return SeenPoint{
          light.position + (frame.s * d.x + frame.t * d.y + frame.n * height) * light.radius,
          light.area};
    }
    case LightShape::Cylinder: {
      const float half = length(light.edge_u);
      const Vec3 axis = light.edge_u / half;
      const Vec3 across = direction - axis * dot(direction, axis);
      const float sine = length(across);
      if (!(sine > 1e-6f)) return std::nullopt;
      const float x = 2 * u.x - 1;
      return SeenPoint{
          light.position + (light.edge_u * (2 * u.y - 1) + (cross(axis, across / sine) * x +
                                                            across / sine * std::sqrt(1 - x * x)) *
                                                               light.radius),
          4 * half * light.radius * sine};
    }
    default:
      return SeenPoint{light.position, 1};
  }
}

}  // namespace oriel
