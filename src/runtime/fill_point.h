// SPDX-License-Identifier: Apache-2.0
// Fills the shading point of a ray's hit: bases, footprint, material.
#pragma once

#include "runtime/world.h"

namespace oriel {

/// Ray cone for texture filtering: the width grows by `spread` per unit of distance.
/// Source: Akenine-Moller et al., "Texture Level of Detail Strategies for Real-Time Ray Tracing",
///         Ray Tracing Gems, 2019.
struct RayCone {
  float width = 0, spread = 0;
  float width_at(float t) const { return width + spread * t; }
};

/// Copies texture coordinates, bump bases and derivatives of a surface.
void take_texture_spaces(const geom::SurfacePoint& surface, ShadingPoint& point);

/// Fills the point of a hit, including `ray_*` and `ray_kind`.
void fill_point(const World& world, const geom::Ray& ray, const geom::Hit& hit, const RayCone& cone,
                RayKind kind, ShadingPoint& point);

/// The material of a hit.
inline const Material& material_of(const World& world, const geom::Hit& hit) {
  const geom::InstanceDesc& desc = world.accel->instance(hit.instance);
  const InstanceData& instance = world.instances[desc.user];
  const std::uint32_t slot = world.accel->mesh(desc.mesh).slot_of(hit.primitive);
  return world.materials[static_cast<std::size_t>(instance.materials[slot])];
}

}  // namespace oriel
