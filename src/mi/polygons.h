// SPDX-License-Identifier: Apache-2.0
// Builds a polygon group from lists of vectors, vertices and polygons, directly in its columns.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "mi/parse.h"

namespace oriel::mi {

/// Reserves memory for a list of unknown length. Doubling would leave up to three times the memory
/// of a large mesh unused; the length is extrapolated from the position in the text instead.
class Room {
 public:
  /// The text of the list begins at p and ends near the next `stop` character of the source.
  Room(const Source& source, const char* p, char stop, bool list_was_empty);
  template <class T>
  void push(std::vector<T>& list, const T& value, const char* p) {
    if (list.size() == list.capacity()) list.reserve(wanted(list.size(), p));
    list.push_back(value);
  }

 private:
  std::size_t wanted(std::size_t size, const char* p) const;
  const char* begin_;
  const char* end_;
  char stop_;
  bool fresh_;
};

/// A position in the text. Line and column are computed on demand.
struct Place {
  Source* source = nullptr;
  const char* at = nullptr;
  SourceLocation locate() const { return source->locate(at); }
};

/// Converts a number to an index. Invalid numbers become the largest valid index, because
/// scene::kNone means absent.
inline std::uint32_t as_index(double value) {
  return value >= 0 && value < scene::kNone ? static_cast<std::uint32_t>(value) : scene::kNone - 1;
}
/// Reads the next token as an index.
inline std::uint32_t index_of(Parse& parse) { return as_index(parse.number("an index")); }

/// The fields of one vertex as written, before they are split into columns.
struct VertexRecord {
  struct Texture {
    std::uint32_t coordinate = scene::kNone, basis_u = scene::kNone, basis_v = scene::kNone;
  };
  std::uint32_t point = scene::kNone, normal = scene::kNone;
  std::vector<std::uint32_t> derivative, motion, user;
  std::vector<Texture> textures;
  std::optional<scene::VertexMark> mark;
  void clear();
};

/// Adds vertices and polygons to a group and keeps every index in it valid. An index out of range
/// is reported; the field becomes kNone, or the polygon is dropped.
class GroupBuilder {
 public:
  GroupBuilder(Parse& parse, scene::PolygonGroup& group) : parse_(parse), group_(group) {}

  void add_vertex(const VertexRecord& vertex, Place place, Room& room);
  /// Whether the vertex exists and has a valid point.
  bool is_usable_vertex(std::uint32_t vertex) const {
    return vertex < group_.vertices.size() &&
           !(vertex < bad_vertices_.size() && bad_vertices_[vertex]);
  }

  /// Index of a material name in the group; adds the name if it is new.
  std::uint32_t material_index(std::string_view name);
  /// A polygon is begin_polygon(), corner() for each corner, and end_polygon(), which checks the
  /// corners and keeps or drops the polygon. `material`: see PolygonList::material.
  void begin_polygon() { polygon_begin_ = group_.polygons.indices.size(); }
  void corner(std::uint32_t vertex, const char* at, Room& room) {
    room.push(group_.polygons.indices, vertex, at);
  }
  void begin_hole() {
    const auto at = static_cast<std::uint32_t>(group_.polygons.indices.size());
    group_.polygons.holes.push_back(at);
  }
  /// Removes the corners since begin_polygon().
  void abandon_polygon();
  void end_polygon(std::uint32_t material, Place place, Room& room);

  std::uint32_t last_material = scene::kNone;  ///< inherited by polygons without a material name

 private:
  bool usable(std::uint32_t index, Place place, std::string_view field);
  const char* polygon_fault(std::uint32_t& culprit) const;
  Parse& parse_;
  scene::PolygonGroup& group_;
  std::size_t polygon_begin_ = 0;
  std::vector<bool> bad_vertices_;  ///< empty, or true for vertices without a valid point
};

/// Reads consecutive vectors, as numbers or binary blocks.
void read_vectors(Parse& parse, std::vector<Vec3>& vectors);
/// Big-endian conversion of four bytes.
float big_endian_float(const char* bytes);
std::uint32_t big_endian_int(const char* bytes);

}  // namespace oriel::mi
