// SPDX-License-Identifier: Apache-2.0
#include "transport/surface.h"

#include <limits>

namespace oriel {

Vec3 raster_motion(const ShadingPoint& point) {
  const World& world = *point.world;
  const scene::Shutter& shutter = world.shutter;
  if (!shutter.on) return Vec3(0);
  const bool closed = !(shutter.close > shutter.open);
  const float interval = 1 / static_cast<float>(shutter.last - shutter.first);
  const float from = closed ? static_cast<float>(-shutter.first) * interval : shutter.open;
  const float to = closed ? from + interval : shutter.close;
  const auto seen = [&](float time) {
    return world.camera.project(point.position + point.speed * (time - point.time), time);
  };
  const Vec3 way = seen(to) - seen(from);
  return is_finite(way) ? way : Vec3(0);
}

const NodeList* volume_around(const World& world, geom::Ray ray) {
  // A ray may meet things inside of the object first; so many of them are looked behind.
  constexpr int kMaxSurfaces = 256;
  if (!world.has_object_volumes) return nullptr;
  ray.tnear = 0;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0u;
  for (int i = 0; i < kMaxSurfaces; ++i) {
    geom::Hit hit;
    if (!world.accel->intersect(ray, hit)) return nullptr;
    ShadingPoint point;
    fill_point(world, ray, hit, {}, RayKind::Shadow, point);
    const Material& material = material_of(world, hit);
    if (!material.volume.empty()) return point.back_side ? &material.volume : nullptr;
    ray = leave(point, ray.dir, ray.tfar, ray.mask);
  }
  return nullptr;
}

MapPlace map_place(const ShadingPoint& point, const Vec3& normal) {
  const World& world = *point.world;
  if (!world.shutter.on || point.instance < 0 || point.time == world.shutter.middle())
    return {point.position, normal};
  const auto instance = static_cast<std::uint32_t>(point.instance);
  const geom::InstanceDesc& desc = world.accel->instance(instance);
  const geom::Mesh& mesh = world.accel->mesh(desc.mesh);
  if (desc.path.empty() && mesh.keys.empty() && mesh.curves.keys.empty())
    return {point.position, normal};
  const Vec3 front = point.back_side ? -point.geometric_normal : point.geometric_normal;
  const geom::Hit hit{.u = point.on_primitive.x,
                      .v = point.on_primitive.y,
                      .instance = instance,
                      .primitive = point.primitive,
                      .ng = front,
                      .time = world.shutter.middle()};
  geom::SurfacePoint middle;
  world.accel->interpolate(hit, middle);
  return {middle.p, geom::turned(normal, front, middle.ng)};
}

}  // namespace oriel
