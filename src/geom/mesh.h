// SPDX-License-Identifier: Apache-2.0
// Triangle meshes for ray tracing and shading: columns of vertex data.
#pragma once

#include <ImathBox.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.h"
#include "geom/curves.h"
#include "scene/object.h"

namespace oriel::geom {

using Box3 = Imath::Box3f;
using scene::kNone;

// Conventions
//   Object space, or world space once an Accel has baked the mesh. The front of a triangle is the
//   side on which a, b, c are counter-clockwise. A column is empty (the mesh lacks the field) or
//   has one entry per vertex; a null vector means that the vertex lacks the value.

struct Triangle {
  std::uint32_t a = 0, b = 0, c = 0;
  bool operator==(const Triangle&) const = default;
};

struct TextureSpace {
  std::vector<Vec3> coordinate;
  std::vector<Vec3> basis_u, basis_v;  ///< bump basis vectors, not normalised
};

/// Material slot of triangles. In a tagged object `label` is an index into the material list of the
/// instance; otherwise `name` is the material of the object, and empty means that the instance
/// provides one.
struct MaterialSlot {
  std::string name;
  std::uint32_t label = kNone;
  bool inherits() const { return name.empty() && label == kNone; }
  bool operator==(const MaterialSlot&) const = default;
};

/// Reserves `count` elements: exactly in an empty column, by factors of 1.5 afterwards, so that
/// many small appends do not copy the column each time.
template <class T>
void make_room(std::vector<T>& column, std::size_t count) {
  if (count <= column.capacity()) return;
  column.reserve(column.empty() ? count : std::max(count, column.capacity() * 3 / 2));
}

struct Mesh {
  /// has one extra entry at the end: Embree reads 16 bytes per vertex
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<Vec3> normals;  ///< unit vectors in object space; null = geometric normal
  std::vector<TextureSpace> textures;
  std::vector<Vec3> dpdu, dpdv;           ///< derivatives, if the scene provides them
  std::vector<std::vector<Vec3>> motion;  ///< one column per motion step
  /// Positions at equal steps of ray time from 0 to 1, with the same extra entry; empty if the mesh
  /// does not move.
  std::vector<std::vector<Vec3>> keys;
  Curves curves;                    ///< hair; its pieces are primitives after the triangles
  std::vector<std::uint32_t> slot;  ///< per primitive; empty if all are in slot 0
  std::vector<MaterialSlot> slots;  ///< never empty in a tessellated mesh
  bool tagged = false;

  std::size_t vertex_count() const { return positions.empty() ? 0 : positions.size() - 1; }
  bool empty() const { return triangles.empty() && curves.empty(); }
  std::uint32_t slot_of(std::uint32_t primitive) const {
    return slot.empty() ? 0 : slot[primitive];
  }
  /// Bounds of all vertices in use; empty for an empty mesh.
  Box3 bounds() const;
  /// Memory usage of the columns.
  std::size_t bytes() const;
};

}  // namespace oriel::geom
