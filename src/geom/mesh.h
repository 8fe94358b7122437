// SPDX-License-Identifier: Apache-2.0
// Triangle meshes as the ray tracer and the shading point read them: columns of shared vertices.
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
//   Everything is in object space, or in world space once an Accel has baked the mesh. The front of
//   a triangle is the side from which a, b, c run counter-clockwise. A column is empty (the mesh
//   lacks the field) or has one entry per vertex; a null vector says that this vertex lacks it.

struct Triangle {
  std::uint32_t a = 0, b = 0, c = 0;
  bool operator==(const Triangle&) const = default;
};

struct TextureSpace {
  std::vector<Vec3> coordinate;
  std::vector<Vec3> basis_u, basis_v;  ///< bump basis vectors, not normalised
};

/// What a triangle's slot stands for. In a tagged object `label` indexes the instance's material
/// list; otherwise `name` is the object's own material, and empty means the instance supplies one.
struct MaterialSlot {
  std::string name;
  std::uint32_t label = kNone;
  bool inherits() const { return name.empty() && label == kNone; }
  bool operator==(const MaterialSlot&) const = default;
};

/// Room for `count` elements: exactly as many in an empty column; later ones grow by half, so that
/// many small parts are not each copied with all that is there.
template <class T>
void make_room(std::vector<T>& column, std::size_t count) {
  if (count <= column.capacity()) return;
  column.reserve(column.empty() ? count : std::max(count, column.capacity() * 3 / 2));
}

struct Mesh {
  std::vector<Vec3> positions;  ///< one more than there are vertices: Embree reads 16 bytes at each
  std::vector<Triangle> triangles;
  std::vector<Vec3> normals;  ///< unit in object space; null = the geometric normal there
  std::vector<TextureSpace> textures;
  std::vector<Vec3> dpdu, dpdv;           ///< derivatives, where the scene gives them
  std::vector<std::vector<Vec3>> motion;  ///< one column per motion step
  /// Positions at equal steps of a ray's time from 0 to 1, padded as they are; empty: they stay.
  std::vector<std::vector<Vec3>> keys;
  Curves curves;                    ///< hair; its pieces count as primitives after triangles
  std::vector<std::uint32_t> slot;  ///< per primitive; empty when all are in slot 0
  std::vector<MaterialSlot> slots;  ///< never empty in a tessellated mesh
  bool tagged = false;

  std::size_t vertex_count() const { return positions.empty() ? 0 : positions.size() - 1; }
  bool empty() const { return triangles.empty() && curves.empty(); }
  std::uint32_t slot_of(std::uint32_t primitive) const {
    return slot.empty() ? 0 : slot[primitive];
  }
  /// Bounds of what triangles and curves use; empty for an empty mesh.
  Box3 bounds() const;
  /// Memory the columns hold.
  std::size_t bytes() const;
};

}  // namespace oriel::geom
