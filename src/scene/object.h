// SPDX-License-Identifier: Apache-2.0
// Geometry in a scene: groups over a pool of vectors, hair, uninterpreted geometry.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.h"
#include "scene/freeform.h"
#include "scene/hair.h"
#include "scene/polygon_list.h"
#include "scene/subdivision.h"
#include "scene/value.h"

namespace oriel::scene {

// Conventions
//   All indices are 0-based. A column of a vertex list is either empty (no vertex has the field) or
//   has one entry per vertex, kNone for vertices without the field. This needs four bytes per field
//   and vertex.

/// One texture space of a vertex list: indices into the group's vectors.
struct TextureColumn {
  std::vector<std::uint32_t> coordinate;
  std::vector<std::uint32_t> basis_u, basis_v;  ///< bump basis vectors, object space
  bool operator==(const TextureColumn&) const = default;
};

/// `v P n N d U V [..] t T [X Y] m M u W`: the vertices of a group, column by column.
struct VertexList {
  std::vector<std::uint32_t> point;
  std::vector<std::uint32_t> normal;
  std::vector<std::vector<std::uint32_t>> derivative;  ///< 2, 3 or 5 columns
  std::vector<TextureColumn> textures;
  std::vector<std::vector<std::uint32_t>> motion;  ///< one column per motion step
  std::vector<std::vector<std::uint32_t>> user;
  std::vector<VertexMark> marks;  ///< marked vertices only, ascending
  std::size_t size() const { return point.size(); }
  bool operator==(const VertexList&) const = default;
};

/// `group ... end group`; a `trilist` is stored in the same form.
struct PolygonGroup {
  std::string name;
  std::vector<Vec3> vectors;  ///< positions, normals, texture coordinates... in object space
  VertexList vertices;
  PolygonList polygons;
  std::vector<SubdivisionSurface> subdivisions;
  std::vector<std::string> materials;  ///< names used by polygons
  std::vector<Statement> settings;     ///< merge, approximate
  FreeForm freeform;                   ///< curves and surfaces over the same vertices
  SourceLocation where;
  bool operator==(const PolygonGroup&) const = default;
};

/// object "name" flags... body end object
struct Object {
  std::string name;
  std::vector<Statement> flags;  ///< visible, shadow, trace, tagged, tag, box, ... as written
  std::vector<Basis> bases;      ///< of free-form curves and surfaces
  std::vector<PolygonGroup> groups;
  std::vector<Hair> hairs;
  std::vector<UninterpretedStatement> uninterpreted;  ///< other geometry
  std::string content;  ///< loaded object of a placeholder (`file "f"`); empty: not loaded
  SourceLocation where;
  bool operator==(const Object&) const = default;
};

}  // namespace oriel::scene
