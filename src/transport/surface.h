// SPDX-License-Identifier: Apache-2.0
// From a ray's hit to the shading point: bases, footprint, material.
#pragma once

#include "runtime/world.h"

namespace oriel {

/// The cone a ray stands for, to filter textures: width grows by `spread` per unit of distance.
/// Source: Akenine-Moller et al., "Texture Level of Detail Strategies for Real-Time Ray Tracing",
///         Ray Tracing Gems, 2019.
struct RayCone {
  float width = 0, spread = 0;
  float width_at(float t) const { return width + spread * t; }
};

/// Texture coordinates, bump bases and derivatives of a surface.
void take_texture_spaces(const geom::SurfacePoint& surface, ShadingPoint& point);

/// Fills the point of a hit. `point.ray_*` and `ray_kind` are set from the ray.
void fill_point(const World& world, const geom::Ray& ray, const geom::Hit& hit, const RayCone& cone,
                RayKind kind, ShadingPoint& point);

/// The material of a hit.
const Material& material_of(const World& world, const geom::Hit& hit);

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
geom::Ray leave(const ShadingPoint& point, const Vec3& direction, float tfar, std::uint32_t mask);

}  // namespace oriel
