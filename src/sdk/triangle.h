// SPDX-License-Identifier: Apache-2.0
// The triangle of a hit with its vertex data.
#pragma once

#include <array>
#include <optional>

#include "geom/mesh.h"
#include "runtime/shading_point.h"

namespace oriel::sdk {

struct HitTriangle {
  const geom::Mesh* mesh = nullptr;
  std::array<std::uint32_t, 3> corners{};
  // Transforms between the space of the mesh and others; null if they are equal.
  const Mat4* mesh_to_world = nullptr;
  const Mat4* mesh_to_object = nullptr;
  const Mat4* object_to_mesh = nullptr;
  float time = 0;  ///< of the ray

  Vec3 position(int corner) const;  ///< world space
  /// Barycentric weights of a point in world space in the plane of the triangle; their sum is 1.
  Vec3 weights(const Vec3& position) const;
};

/// Unset if the hit is not a triangle.
std::optional<HitTriangle> hit_triangle(const ShadingPoint& point);

}  // namespace oriel::sdk
