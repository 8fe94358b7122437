// SPDX-License-Identifier: Apache-2.0
// The triangle that was hit: its corners as they lie in memory.
#pragma once

#include <array>
#include <optional>

#include "geom/mesh.h"
#include "runtime/shading_point.h"

namespace oriel::sdk {

struct HitTriangle {
  const geom::Mesh* mesh = nullptr;
  std::array<std::uint32_t, 3> corners{};
  // Between the mesh's space and others; null where they are the same.
  const Mat4* mesh_to_world = nullptr;
  const Mat4* mesh_to_object = nullptr;
  const Mat4* object_to_mesh = nullptr;
  float time = 0;  ///< of the ray

  Vec3 position(int corner) const;  ///< world space
  /// Weights of the corners at a point of world space in their plane, their sum is 1.
  Vec3 weights(const Vec3& position) const;
};

/// Nothing where no triangle was hit.
std::optional<HitTriangle> hit_triangle(const ShadingPoint& point);

}  // namespace oriel::sdk
