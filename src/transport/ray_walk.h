// SPDX-License-Identifier: Apache-2.0
// A ray from surface to surface: what paths and photons share.
#pragma once

#include "runtime/shading_point.h"
#include "transport/medium.h"
#include "transport/surface.h"

namespace oriel {

/// The current ray and the medium that it is in.
///
/// Checked: by paths and photons: Glass.*, CutOut.*, VolumesOfMaterials.*, PhotonTrace.* in
///          tests/analytic.
struct RayWalk {
  geom::Ray ray;
  RayKind kind = RayKind::Eye;
  MediumOnWay medium;
  /// The exact point that the ray left; its origin is offset from the surface, and glass may be
  /// thinner than the offset.
  Vec3 left{0};

  /// Starts at the origin of `ray`, which is on no surface.
  void begin(const World& world) {
    left = ray.org;
    medium.begin_in(volume_around(world, ray));
  }
  /// Leaves a surface.
  /// Inputs:  reach: maximum distance, scene units; mask: what the ray meets, geom::RayMask.
  void leave_surface(const ShadingPoint& point, const Vec3& direction, float reach,
                     std::uint32_t mask) {
    ray = leave(point, direction, reach, mask);
    left = point.position;
  }
  /// Continues from a point in a volume, where light was scattered.
  void leave_volume_point(const Vec3& place, const Vec3& direction, std::uint32_t mask) {
    ray = {.time = ray.time};
    ray.org = left = place;
    ray.dir = direction;
    ray.mask = mask;
  }
  /// The input of volume shaders that act on a segment of the ray.
  /// Inputs:  length: scene units, infinite behind all surfaces.
  ShadingPoint volume_segment(const World& world, const Vec3& from, const Vec3& to,
                              float length) const {
    ShadingPoint segment;
    segment.ray_kind = kind;
    segment.position = to;
    segment.normal = segment.geometric_normal = -ray.dir;
    segment.ray_origin = from;
    segment.ray_direction = ray.dir;
    segment.ray_length = length;
    segment.world = &world;
    segment.time = ray.time;
    return segment;
  }
};

}  // namespace oriel
