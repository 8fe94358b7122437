// SPDX-License-Identifier: Apache-2.0
#include "shaders/subsurface/scatter_light.h"

#include <algorithm>
#include <cmath>

#include "base/frame.h"
#include "base/math.h"
#include "bsdf/diffusion_profile.h"
#include "runtime/tracer.h"
#include "runtime/world.h"

namespace oriel {
namespace {

/// Surfaces of one probe ray that are considered.
constexpr int kMaxExits = 8;
/// Relative distance at which a probe ray continues behind a surface.
constexpr float kProbeStep = 1e-4f;

/// Sum over lights and indirect light that arrive at a place on that side, over pi.
Rgb light_at(const ShadingPoint& point, const Vec3& position, const Vec3& normal) {
  ShadingPoint at = point;
  at.position = position;
  at.normal = at.geometric_normal = normal;
  at.ray_direction = -normal;
  at.ray_origin = position + normal;
  at.ray_length = 1;
  Rgb sum(0);
  for (std::size_t i = 0; i < point.world->lights.size(); ++i) {
    const auto arriving = point.tracer->light(static_cast<int>(i), at);
    if (arriving) sum += arriving->colour * std::max(0.0f, dot(arriving->wi, normal));
  }
  return sum + point.tracer->irradiance(at, normal) * kInvPi;
}

/// The side of a surface that faces as the viewer's side does at the point.
Vec3 same_side(const ShadingPoint& point, const Tracer::Met& met) {
  return met.back_side == point.back_side ? met.geometric_normal : -met.geometric_normal;
}

bool is_same_solid(const ShadingPoint& point, const Tracer::Met& met) {
  return met.instance == point.instance && met.material == point.material;
}

/// One of the surfaces of the solid along a probe ray, and how many there are.
struct Exit {
  int count = 0;
  Tracer::Met met;
};
Exit choose_exit(const ShadingPoint& point, Vec3 origin, const Vec3& direction, float reach) {
  Exit exit;
  const float step = kProbeStep * reach;
  for (int i = 0; i < kMaxExits && reach > 0; ++i) {
    const auto met = point.tracer->probe(origin, direction, reach);
    if (!met) break;
    if (is_same_solid(point, *met)) {
      ++exit.count;
      if (exit.count == 1 || point.tracer->next().x * static_cast<float>(exit.count) < 1)
        exit.met = *met;
    }
    origin = met->position + direction * step;
    reach -= met->distance + step;
  }
  return exit;
}

}  // namespace

bool scatters_below(const ShadingPoint& point) {
  const RayKind kind = point.ray_kind;
  return point.tracer && point.world && point.instance >= 0 &&
         (kind == RayKind::Eye || kind == RayKind::Reflect || kind == RayKind::Refract ||
          kind == RayKind::Transparent);
}

Rgb scattered_light(ShadingPoint& point, float radius) {
  constexpr float kChances[3] = {.25f, .25f, .5f};  // tangents, normal
  const bsdf::DiffusionProfile profile(radius);
  const Frame frame(point.geometric_normal);
  const Vec3 axes[3] = {frame.s, frame.t, frame.n};
  const Vec2 u = point.tracer->next(), v = point.tracer->next();
  const int k = u.x < kChances[0] ? 0 : u.x < kChances[0] + kChances[1] ? 1 : 2;
  const float r = profile.sample(v.x), phi = kTwoPi * v.y;
  const Vec3& along = axes[k];
  const Vec3 beside = (axes[(k + 1) % 3] * math::cos(phi) + axes[(k + 2) % 3] * math::sin(phi)) * r;
  const float half = std::sqrt(std::max(0.0f, radius * radius - r * r));
  const Exit exit = choose_exit(point, point.position + beside + along * half, -along, 2 * half);
  if (exit.count == 0) {
    // Materials that ask for light are recognised by it: see lights/emission.h.
    if (point.world->lights.empty()) return Rgb(0);
    point.tracer->light(0, point);
    return Rgb(0);
  }
  const Vec3 off = exit.met.position - point.position;
  float density = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float height = dot(off, axes[axis]);
    const float beside_axis = std::sqrt(std::max(0.0f, dot(off, off) - height * height));
    density += kChances[axis] * std::abs(dot(axes[axis], exit.met.geometric_normal)) *
               profile.eval(beside_axis);
  }
  const float distance = length(off);
  if (!(density > 0) || distance > radius) return Rgb(0);
  const float weight = static_cast<float>(exit.count) * profile.eval(distance) / density;
  return light_at(point, exit.met.position, same_side(point, exit.met)) * weight;
}

Rgb back_scattered_light(ShadingPoint& point, float radius, float depth) {
  const Vec3 inward = -point.geometric_normal;
  const float step = kProbeStep * depth;
  Vec3 origin = point.position + inward * step;
  if (radius > 0) {
    const Frame frame(point.geometric_normal);
    const Vec2 u = point.tracer->next();
    const float r = bsdf::DiffusionProfile(radius).sample(u.x), phi = kTwoPi * u.y;
    origin += (frame.s * math::cos(phi) + frame.t * math::sin(phi)) * r;
  }
  const auto met = point.tracer->probe(origin, inward, depth);
  if (!met || !is_same_solid(point, *met)) return light_at(point, point.position, inward);
  const float fade = std::max(0.0f, 1 - (met->distance + step) / depth);
  return light_at(point, met->position, same_side(point, *met)) * fade;
}

}  // namespace oriel
