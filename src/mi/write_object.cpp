// SPDX-License-Identifier: Apache-2.0
// Objects and their polygon groups, which are most of the output.
#include "mi/write_parts.h"
#include "scene/element_settings.h"

namespace oriel::mi {
namespace {

using scene::kNone;
using scene::PolygonGroup;
using Column = std::vector<std::uint32_t>;

std::uint32_t at(const Column& column, std::size_t i) {
  return i < column.size() ? column[i] : kNone;
}

void write_field(TextSink& out, std::string_view field, std::uint32_t index) {
  if (index == kNone) return;
  out.put(field);
  out.index(index);
}

/// Writes ` m 7 m 8`: one index per column, up to the first column without one.
void write_fields(TextSink& out, std::string_view field, const std::vector<Column>& columns,
                  std::size_t vertex) {
  for (const Column& column : columns) {
    if (at(column, vertex) == kNone) return;
    write_field(out, field, column[vertex]);
  }
}

void write_derivative(TextSink& out, const std::vector<Column>& columns, std::size_t vertex) {
  constexpr std::size_t kMaxInOneField = 5;
  for (std::size_t i = 0; i < columns.size() && at(columns[i], vertex) != kNone; ++i)
    write_field(out, i % kMaxInOneField == 0 ? " d " : " ", columns[i][vertex]);
}

void write_mark(TextSink& out, const scene::VertexMark& mark) {
  constexpr std::string_view kNames[] = {" cusp", " conic", " corner", " dart"};
  out.put(kNames[static_cast<std::size_t>(mark.kind)]);
  if (!mark.level) return;
  out.put(" level ");
  out.integer(*mark.level);
}

void write_vertices(TextSink& out, const scene::VertexList& list) {
  auto mark = list.marks.begin();
  for (std::size_t i = 0; i < list.size(); ++i) {
    write_field(out, "v ", list.point[i]);
    write_field(out, " n ", at(list.normal, i));
    if (!list.derivative.empty()) write_derivative(out, list.derivative, i);
    for (const scene::TextureColumn& t : list.textures) {
      if (at(t.coordinate, i) == kNone) break;
      write_field(out, " t ", t.coordinate[i]);
      if (at(t.basis_u, i) == kNone || at(t.basis_v, i) == kNone) continue;
      write_field(out, " ", t.basis_u[i]);
      write_field(out, " ", t.basis_v[i]);
    }
    write_fields(out, " m ", list.motion, i);
    write_fields(out, " u ", list.user, i);
    if (mark != list.marks.end() && mark->vertex == i) write_mark(out, *mark++);
    out.put('\n');
  }
}

void write_polygons(TextSink& out, const PolygonGroup& group, FaceMaterials& materials) {
  const scene::PolygonList& list = group.polygons;
  std::size_t hole = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    out.put('p');
    materials.write(out, at(list.material, i));
    for (std::uint32_t corner = list.first[i]; corner < list.first[i + 1]; ++corner) {
      if (hole < list.holes.size() && list.holes[hole] == corner) {
        out.put(" hole");
        ++hole;
      }
      out.put(' ');
      out.index(list.indices[corner]);
    }
    out.put('\n');
  }
}

void write_group(TextSink& out, const PolygonGroup& group, bool tagged) {
  const auto is_merge = [](const scene::Statement& s) { return s.keyword == "merge"; };
  out.put("    group");
  if (!group.name.empty()) {
    out.put(' ');
    out.quoted(group.name);
  }
  out.put('\n');
  for (const auto& s : group.settings)
    if (is_merge(s)) write_statement(out, s, 2);
  for (const Vec3& v : group.vectors) {
    out.number(v.x);
    out.put(' ');
    out.number(v.y);
    out.put(' ');
    out.number(v.z);
    out.put('\n');
  }
  write_vertices(out, group.vertices);
  FaceMaterials materials(group, tagged);
  write_polygons(out, group, materials);
  for (const auto& surface : group.subdivisions) write_subdivision(out, surface, materials);
  write_freeform(out, group, tagged);
  for (const auto& s : group.settings)
    if (!is_merge(s)) write_statement(out, s, 2);
  out.put("    end group\n");
}

}  // namespace

void write_element(TextSink& out, const scene::Object& object, int depth) {
  out.put("object ");
  out.quoted(object.name);
  out.put('\n');
  write_statements(out, object.flags, depth + 1);
  // Bases precede the groups that use them.
  write_bases(out, object.bases);
  write_uninterpreted(out, object.uninterpreted, depth + 1);
  const bool tagged = scene::settings_of(object).tagged;
  for (const PolygonGroup& group : object.groups) write_group(out, group, tagged);
  for (const scene::Hair& hair : object.hairs) write_hair(out, hair, depth + 1);
  out.put("end object\n");
}

}  // namespace oriel::mi
