// SPDX-License-Identifier: Apache-2.0
#include "transport/shadow.h"

#include <cmath>
#include <limits>

#include "transport/surface.h"

namespace oriel {
namespace {

/// Transparent blockers on one shadow ray before the rest counts as dark.
constexpr int kMostBlockers = 128;
/// Light samples are approached to this share of their distance, so that a light's own housing at
/// the sample does not block it.
constexpr float kShortOfLight = 1 - 1e-4f;

}  // namespace

Rgb transmittance(const Medium& medium, float distance) {
  Rgb t(std::exp(-medium.absorption.x * distance), std::exp(-medium.absorption.y * distance),
        std::exp(-medium.absorption.z * distance));
  if (medium.black_distance > 0) t *= clamp01(1 - distance / medium.black_distance);
  return t;
}

Rgb straight_transmission(const Closure& closure, const scene::RenderOptions& options) {
  Rgb sum(0);
  const bool refracts = closure.refractive_caustics && options.caustic.on;
  if (!refracts)
    for (int i = 0; i < closure.count; ++i)
      if (transmits(closure.lobes[i].kind)) sum += closure.lobes[i].level;
  return Rgb(1 - closure.opacity) + sum * closure.opacity;
}

Rgb shadow_transmittance(const World& world, const ShadingPoint& point, const Vec3& wi,
                         float distance, RayCounts& counts) {
  if (world.options.shadow == scene::ShadowMode::Off) return Rgb(1);
  if (point.instance >= 0 &&
      !world.instances[static_cast<std::size_t>(point.instance)].receives_shadow)
    return Rgb(1);
  const float tfar =
      std::isinf(distance) ? std::numeric_limits<float>::infinity() : distance * kShortOfLight;
  geom::Ray ray = leave(point, wi, tfar, geom::RayMask::Shadow);
  ++counts.shadow;
  if (world.accel->occluded(ray)) return Rgb(0);
  if (!world.has_transparent_blockers) return Rgb(1);

  // Walk the transparent ones from the point to the light.
  const bool segments = world.options.shadow == scene::ShadowMode::Segments;
  ray.mask = geom::RayMask::ShadowTransparent;
  Rgb open(1);
  Medium medium;
  bool medium_known = false;
  for (int i = 0; i < kMostBlockers; ++i) {
    geom::Hit hit;
    ++counts.shadow;
    if (!world.accel->intersect(ray, hit)) return open;
    ShadingPoint blocker;
    fill_point(world, ray, hit, {}, RayKind::Shadow, blocker);
    Closure closure;
    shade(material_of(world, hit), blocker, closure);
    if (segments) {
      if (!medium_known && blocker.back_side && !closure.thin_walled) medium = closure.inside;
      open *= transmittance(medium, hit.t);
    }
    open *= straight_transmission(closure, world.options);
    if (max_component(open) <= 0) return Rgb(0);
    if (!closure.thin_walled) {
      medium = blocker.back_side ? Medium{} : closure.inside;
      medium_known = true;
    }
    const float rest = ray.tfar - hit.t;
    if (!(rest > 0)) return open;
    ray = leave(blocker, wi, rest, geom::RayMask::ShadowTransparent);
  }
  return Rgb(0);
}

}  // namespace oriel
