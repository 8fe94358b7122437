// SPDX-License-Identifier: Apache-2.0
// Rays at surfaces: how they leave, what volume they start in, what maps know of a place.
#pragma once

#include "runtime/fill_point.h"

namespace oriel {

/// Volume shaders of the object that a ray starts in: those of the first surface on its way that
/// has any, where the ray meets its back. Null: none.
/// Checked: VolumesOfMaterials.* in tests/analytic
const NodeList* volume_around(const World& world, geom::Ray ray);

/// A point of a surface and a direction there as they are in the middle of the shutter: so maps of
/// indirect light know what moves, and what moves finds its own light in them.
/// Inputs:  normal: world, at the point's time.
/// Checked: MovingPhotons.OnAMovingPlateAreFoundWhereverItIs
struct MapPlace {
  Vec3 position, normal;
};
MapPlace map_place(const ShadingPoint& point, const Vec3& normal);

/// Way of a surface on the picture while the shutter is open, in one motion interval for one that
/// is closed: as it goes now, seen by the camera as that goes. Pixels to the right and up, and
/// distance along the camera's axis; alpha 0. Null where nothing moves.
Vec3 raster_motion(const ShadingPoint& point);

/// A ray leaving a point in a direction, clear of the surface it leaves.
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
