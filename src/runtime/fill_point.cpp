// SPDX-License-Identifier: Apache-2.0
#include "runtime/fill_point.h"

#include <algorithm>
#include <cmath>

#include "runtime/bump.h"

namespace oriel {
namespace {

static_assert(kMaxTextureSpaces == geom::kMaxTextureSpaces);

/// Half axes of the cone's ellipse on the plane of the surface: the width of the cone perpendicular
/// to the view, stretched along it by the slant.
void set_footprint(float width, ShadingPoint& point) {
  /// The anisotropy of look-ups is limited as well, so a longer footprint has no effect on quality.
  constexpr float kMinCosine = 0.05f;
  const Vec3& n = point.geometric_normal;
  const Vec3 along = point.ray_direction - n * dot(point.ray_direction, n);
  const float cosine = std::max(kMinCosine, std::abs(dot(point.ray_direction, n)));
  const Vec3 major = length(along) > 1e-4f ? normalize(along) : Frame(n).s;
  point.dpdx = major * (width / cosine);
  point.dpdy = cross(n, major) * width;
}

}  // namespace

void take_texture_spaces(const geom::SurfacePoint& surface, ShadingPoint& point) {
  point.texture_spaces = static_cast<std::uint8_t>(surface.texture_count);
  point.other_spaces_cleared = false;
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

}  // namespace oriel
