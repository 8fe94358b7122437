// SPDX-License-Identifier: Apache-2.0
#include "transport/surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "runtime/bump.h"

namespace oriel {
namespace {

static_assert(kMostTextureSpaces == geom::kMaxTextureSpaces);

/// Half axes of the cone's ellipse on the plane of the surface: as wide as the cone across the
/// view, stretched by the slant along it.
void set_footprint(float width, ShadingPoint& point) {
  /// Beyond this slant a longer footprint only costs: the texture's anisotropy is limited as well.
  constexpr float kLeastCosine = 0.05f;
  const Vec3& n = point.geometric_normal;
  const Vec3 along = point.ray_direction - n * dot(point.ray_direction, n);
  const float cosine = std::max(kLeastCosine, std::abs(dot(point.ray_direction, n)));
  const Vec3 major = length(along) > 1e-4f ? normalize(along) : Frame(n).s;
  point.dpdx = major * (width / cosine);
  point.dpdy = cross(n, major) * width;
}

}  // namespace

void take_texture_spaces(const geom::SurfacePoint& surface, ShadingPoint& point) {
  point.texture_spaces = static_cast<std::uint8_t>(surface.texture_count);
  // Shaders of users read spaces that an object does not have.
  std::fill(point.tex + point.texture_spaces, std::end(point.tex), Vec3(0));
  for (std::uint32_t i = 0; i < surface.texture_count; ++i) {
    point.tex[i] = surface.textures[i].coordinate;
    point.bump_u[i] = surface.textures[i].basis_u;
    point.bump_v[i] = surface.textures[i].basis_v;
  }
  point.dpdu = surface.dpdu;
  point.dpdv = surface.dpdv;
}

void fill_point(const World& world, const geom::Ray& ray, const geom::Hit& hit, const RayCone& cone,
                RayKind kind, ShadingPoint& point) {
  geom::SurfacePoint surface;
  world.accel->interpolate(hit, surface);
  const InstanceData& instance = world.instances[surface.user];

  point.position = surface.p;
  point.ray_origin = ray.org;
  point.ray_direction = ray.dir;
  point.ray_length = hit.t;
  point.ray_kind = kind;
  point.back_side = dot(surface.ng, ray.dir) > 0;
  const float side = point.back_side ? -1.0f : 1.0f;
  point.geometric_normal = surface.ng * side;
  point.normal = facing_viewer(surface.ns * side, point);
  point.ray_offset = surface.offset;
  point.instance = static_cast<int>(surface.user);
  point.primitive = hit.primitive;
  point.on_primitive = Vec2(hit.u, hit.v);
  point.to_object = &instance.to_object;
  point.to_world = &instance.to_world;
  point.time = hit.time;
  point.speed = surface.speed;
  if (world.shutter.on && !world.accel->instance(hit.instance).path.empty()) {
    Mat4 to_world, to_object;
    world.accel->placement_at(hit.instance, hit.time, to_world, to_object);
    point.to_world.set(to_world);
    point.to_object.set(to_object);
  }
  point.world = &world;
  take_texture_spaces(surface, point);
  set_footprint(cone.width_at(hit.t) * 0.5f, point);
}

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
  constexpr int kMostSurfaces = 256;
  if (!world.has_object_volumes) return nullptr;
  ray.tnear = 0;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0u;
  for (int i = 0; i < kMostSurfaces; ++i) {
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

const Material& material_of(const World& world, const geom::Hit& hit) {
  const geom::InstanceDesc& desc = world.accel->instance(hit.instance);
  const InstanceData& instance = world.instances[desc.user];
  const std::uint32_t slot = world.accel->mesh(desc.mesh).slot_of(hit.primitive);
  return world.materials[static_cast<std::size_t>(instance.materials[slot])];
}

geom::Ray leave(const ShadingPoint& point, const Vec3& direction, float tfar, std::uint32_t mask) {
  const float side = dot(direction, point.geometric_normal) < 0 ? -1.0f : 1.0f;
  geom::Ray ray;
  ray.org = point.position + point.geometric_normal * (side * point.ray_offset);
  ray.dir = direction;
  ray.tfar = tfar;
  ray.mask = mask;
  ray.time = point.time;
  return ray;
}

}  // namespace oriel
