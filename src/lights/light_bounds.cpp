// SPDX-License-Identifier: Apache-2.0
#include "lights/light_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/math.h"
#include "color/luminance.h"
#include "lights/light_shape.h"
#include "lights/portal_table.h"
#include "lights/sample_light.h"
#include "runtime/world.h"

namespace oriel {
namespace {

/// Distances at which a light shader is evaluated, as shares of the scene's radius; an estimate.
constexpr float kNear = 1 / 30.0f, kFar = 1 / 3.0f;
/// Cosine of the directions outside a cone that are tested, as a share of that of its rim: a few
/// degrees.
constexpr float kBeyondRim = 0.05f;

constexpr std::array<Vec3, 6> kAllSides = {Vec3(1, 0, 0),  Vec3(-1, 0, 0), Vec3(0, 1, 0),
                                           Vec3(0, -1, 0), Vec3(0, 0, 1),  Vec3(0, 0, -1)};

float brightness(const Light& light, const World& world, const Vec3& direction, float distance) {
  ShadingPoint point;
  point.world = &world;
  point.position = light.position + direction * distance;
  point.ray_kind = RayKind::Light;
  const float cosine = is_flat(light.shape) ? dot(direction, light.direction) : 1;
  const Rgb c = ask_light_shader(light, point, light.position, direction, distance, cosine).colour;
  const float l = luminance(c);
  return std::isfinite(l) ? std::max(0.0f, l) : 0;
}

/// Whether a spot light is black outside its cone, tested in a few directions.
bool keeps_to_cone(const Light& light, const World& world, float distance) {
  const float cosine = light.spread - kBeyondRim * (1 - light.spread) - kBeyondRim;
  if (cosine <= -1) return false;
  const Frame frame(light.direction);
  const float sine = std::sqrt(1 - sqr(cosine));
  for (const Vec3& side : kAllSides) {
    const Vec3 local = side.z == 0 ? side * sine + Vec3(0, 0, cosine) : Vec3(0, 0, -1);
    if (brightness(light, world, frame.to_world(local), distance) > 0) return false;
  }
  return true;
}

Opening opening_of(const Light& light) {
  const PortalTable* table = light.portal->table.get();
  if (!table || !table->uneven() || !light.path.empty()) return {};
  const float x = dot(light.position, table->x()), y = dot(light.position, table->y());
  return {.table = table,
          .x0 = x - light.portal->half_u,
          .x1 = x + light.portal->half_u,
          .y0 = y - light.portal->half_v,
          .y1 = y + light.portal->half_v,
          .z = dot(light.position, table->z()),
          .scale = luminance(light.portal->scale)};
}

}  // namespace

LightBounds bounds_of(const Light& light, const World& world, float reach, float environment) {
  LightBounds bounds;
  const Vec3 half = half_size(light);
  bounds.box = {light.position - half, light.position + half};
  if (!light.path.empty()) {
    // At all positions and rotations of a moving light.
    const geom::Box3 rest = std::exchange(bounds.box, {});
    for (const Mat4& m : light.path)
      for (int corner = 0; corner < 8; ++corner)
        bounds.box.extendBy(transform_point(
            Vec3((corner & 1 ? rest.max : rest.min).x, (corner & 2 ? rest.max : rest.min).y,
                 (corner & 4 ? rest.max : rest.min).z),
            m));
  } else if (light.portal || is_flat(light.shape)) {
    bounds.normals = {light.direction, 1};
    bounds.cos_reach = 0;
  } else if (light.shape == LightShape::Point && light.spread >= -1 &&
             keeps_to_cone(light, world, reach * kNear)) {
    bounds.normals = {light.direction, 1};
    bounds.cos_reach = light.spread - kBeyondRim;
  }
  if (!gives_direct_light(light)) return bounds;
  if (light.portal) {
    bounds.falling = mean_luminance(*light.portal, environment) * light.area;
    bounds.opening = opening_of(light);
    return bounds;
  }
  const float near = reach * kNear, far = reach * kFar;
  float at_near = 0, at_far = 0;
  if (light.profile_placement) {
    // The axes rarely hit the beam, so the profile's mean over all directions is used.
    const photometry::LightProfile& profile = *light.profile_placement.profile;
    const Vec3 beam = light.profile_placement.to_world(profile.peak_direction());
    const float mean = profile.flux() / (4 * kPi * std::max(profile.peak(), 1e-20f));
    at_near = brightness(light, world, beam, near) * mean;
    at_far = brightness(light, world, beam, far) * mean;
  } else if (bounds.normals.all()) {
    for (const Vec3& side : kAllSides) {
      at_near += brightness(light, world, side, near) / kAllSides.size();
      at_far += brightness(light, world, side, far) / kAllSides.size();
    }
  } else {
    at_near = brightness(light, world, light.direction, near);
    at_far = brightness(light, world, light.direction, far);
  }
  // even + falling / d^2 through both values; lights with faster falloff use the value nearby.
  bounds.falling = std::max(0.0f, (at_near - at_far) / (1 / sqr(near) - 1 / sqr(far)));
  bounds.even = std::max(0.0f, at_far - bounds.falling / sqr(far));
  return bounds;
}

}  // namespace oriel
