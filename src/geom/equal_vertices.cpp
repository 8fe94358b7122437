// SPDX-License-Identifier: Apache-2.0
#include "geom/equal_vertices.h"

#include <algorithm>

namespace oriel::geom {

namespace {

using IndexColumn = std::vector<std::uint32_t>;

/// Maximum number of distinct vertices at one point that a vertex is compared with.
constexpr int kMaxCompared = 16;

/// The index columns other than the point.
std::vector<const IndexColumn*> columns_of(const scene::VertexList& list) {
  std::vector<const IndexColumn*> columns;
  const auto add = [&](const IndexColumn& column) {
    if (column.size() == list.size()) columns.push_back(&column);
  };
  add(list.normal);
  for (const scene::TextureColumn& texture : list.textures) {
    add(texture.coordinate);
    add(texture.basis_u);
    add(texture.basis_v);
  }
  for (const IndexColumn& column : list.derivative) add(column);
  for (const IndexColumn& column : list.motion) add(column);
  return columns;
}

}  // namespace

DifferentVertices find_equal_vertices(const scene::VertexList& list, std::size_t vectors) {
  const std::vector<const IndexColumn*> columns = columns_of(list);
  const auto equal = [&](std::uint32_t a, std::uint32_t b) {
    return std::all_of(columns.begin(), columns.end(),
                       [=](const IndexColumn* column) { return (*column)[a] == (*column)[b]; });
  };
  DifferentVertices out;
  out.number_of.reserve(list.size());
  out.kept.reserve(std::min(list.size(), vectors));
  // The distinct vertices at each point as a linked list, the latest first.
  IndexColumn latest(vectors, scene::kNone), earlier;
  earlier.reserve(out.kept.capacity());
  for (std::uint32_t vertex = 0; vertex < list.size(); ++vertex) {
    const std::uint32_t point = list.point[vertex];
    std::uint32_t kind = point < vectors ? latest[point] : scene::kNone;
    for (int i = 0; kind != scene::kNone && !equal(out.kept[kind], vertex); ++i)
      kind = i + 1 < kMaxCompared ? earlier[kind] : scene::kNone;
    if (kind == scene::kNone) {
      kind = static_cast<std::uint32_t>(out.kept.size());
      out.kept.push_back(vertex);
      earlier.push_back(point < vectors ? latest[point] : scene::kNone);
      if (point < vectors) latest[point] = kind;
    }
    out.number_of.push_back(kind);
  }
  return out;
}

}  // namespace oriel::geom
