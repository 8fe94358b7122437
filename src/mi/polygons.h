// SPDX-License-Identifier: Apache-2.0
// Fills a polygon group from lists: vectors, vertices, polygons, straight into its columns.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "mi/parse.h"

namespace oriel::mi {

/// Room for a list whose length shows only at its end. Doubling would leave up to three times the
/// memory of a big mesh behind; so a growing list asks how far through its text it is.
class Room {
 public:
  /// The list's text begins at p and ends near the next `stop` character of the source.
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

/// A place in the text; line and column are computed only when they are needed.
struct Place {
  Source* source = nullptr;
  const char* at = nullptr;
  SourceLocation locate() const { return source->locate(at); }
};

/// A number as an index. scene::kNone means absent, so what is no index at all becomes the largest
/// that is one.
inline std::uint32_t as_index(double value) {
  return value >= 0 && value < scene::kNone ? static_cast<std::uint32_t>(value) : scene::kNone - 1;
}
/// The index that stands next.
inline std::uint32_t index_of(Parse& parse) { return as_index(parse.number("an index")); }

/// The fields of one vertex as written, before they go to their columns.
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

/// Adds vertices and polygons to a group and keeps every index in it valid: what points outside is
/// reported, a field becomes kNone, a polygon is dropped.
class GroupBuilder {
 public:
  GroupBuilder(Parse& parse, scene::PolygonGroup& group) : parse_(parse), group_(group) {}

  void add_vertex(const VertexRecord& vertex, Place place, Room& room);
  /// Whether that vertex exists and has a point.
  bool is_usable_vertex(std::uint32_t vertex) const {
    return vertex < group_.vertices.size() &&
           !(vertex < bad_vertices_.size() && bad_vertices_[vertex]);
  }

  /// Index for a material's name, the same for equal names.
  std::uint32_t material_index(std::string_view name);
  /// Corners since begin_polygon() go in through corner(); end_polygon() checks and keeps or drops
  /// them. `material` as PolygonList::material has it.
  void begin_polygon() { polygon_begin_ = group_.polygons.indices.size(); }
  void corner(std::uint32_t vertex, const char* at, Room& room) {
    room.push(group_.polygons.indices, vertex, at);
  }
  void begin_hole() {
    const auto at = static_cast<std::uint32_t>(group_.polygons.indices.size());
    group_.polygons.holes.push_back(at);
  }
  /// Forgets the corners since begin_polygon().
  void abandon_polygon();
  void end_polygon(std::uint32_t material, Place place, Room& room);

  std::uint32_t last_material = scene::kNone;  ///< what a polygon without a name inherits

 private:
  bool usable(std::uint32_t index, Place place, std::string_view field);
  const char* polygon_fault(std::uint32_t& culprit) const;
  Parse& parse_;
  scene::PolygonGroup& group_;
  std::size_t polygon_begin_ = 0;
  std::vector<bool> bad_vertices_;  ///< empty, or true where a vertex has no valid point
};

/// Consecutive vectors, numbers or binary blocks, to the first token that is neither.
void read_vectors(Parse& parse, std::vector<Vec3>& vectors);
/// Floats from big-endian bytes.
float big_endian_float(const char* bytes);
std::uint32_t big_endian_int(const char* bytes);

}  // namespace oriel::mi
