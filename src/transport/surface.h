// SPDX-License-Identifier: Apache-2.0
// Rays at surfaces: origins, the volume that a ray starts in, positions in maps, motion.
#pragma once

#include "runtime/fill_point.h"

namespace oriel {

/// Volume shaders of the object that contains the origin of a ray: those of the first surface with
/// volume shaders, if the ray hits its back side. Null: none.
/// Checked: VolumesOfMaterials.* in tests/analytic
const NodeList* volume_around(const World& world, geom::Ray ray);

/// A point of a surface and a direction, moved to the middle of the shutter interval. Maps of
/// indirect light store and look up moving surfaces there.
/// Inputs:  normal: world, at the point's time.
/// Checked: MovingPhotons.OnAMovingPlateAreFoundWhereverItIs
struct MapPlace {
  Vec3 position, normal;
};
MapPlace map_place(const ShadingPoint& point, const Vec3& normal);

/// Motion of a surface on the picture during the shutter interval, or during one motion interval if
/// the shutter is instantaneous; includes the motion of the camera. Pixels to the right and up, and
/// the increase of distance along the camera's axis. 0 where nothing moves.
Vec3 raster_motion(const ShadingPoint& point);

/// A ray that leaves a point, with its origin offset from the surface.
inline geom::Ray leave(const ShadingPoint& point, const Vec3& direction, float tfar,
                       std::uint32_t mask) {
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
