// SPDX-License-Identifier: Apache-2.0
#include "runtime/environment.h"

#include "runtime/environment_ray.h"

namespace oriel {

Rgba environment_radiance(const NodeList& shaders, const World& world, const Vec3& origin,
                          const Vec3& direction, RayKind kind, bool blurred, float roughness) {
  return environment_radiance(shaders, world,
                              {origin, direction, kind, Vec2(0), blurred, roughness});
}

Rgba environment_radiance(const NodeList& shaders, const World& world, const EnvironmentRay& ray) {
  ShadingPoint point;
  point.environment = true;
  point.ray_kind = ray.kind;
  point.blurred = ray.blurred;
  point.roughness = ray.roughness;
  point.ray_origin = ray.origin;
  point.ray_direction = ray.direction;
  point.position = ray.origin + ray.direction;
  point.normal = point.geometric_normal = -ray.direction;
  point.raster = ray.raster;
  point.world = &world;
  Rgba c(0);
  for (const ShaderNode* node : shaders)
    if (node->spec().value) c = node->color(point);
  return c;
}

}  // namespace oriel
