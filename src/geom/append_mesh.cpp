// SPDX-License-Identifier: Apache-2.0
#include "geom/append_mesh.h"

#include <algorithm>

namespace oriel::geom {

namespace {

using Column = std::vector<Vec3>;

void append_column(Column& column, std::size_t before, const Column& part, std::size_t more) {
  if (column.empty() && part.empty()) return;
  column.resize(before, Vec3(0));
  column.insert(column.end(), part.begin(), part.end());
  column.resize(before + more, Vec3(0));
}

void append_slots(Mesh& mesh, const Mesh& part) {
  const std::size_t before = mesh.triangles.size();
  if (mesh.slots.empty()) mesh.slots = before == 0 ? part.slots : std::vector<MaterialSlot>(1);
  std::vector<std::uint32_t> number;
  for (const MaterialSlot& slot : part.slots) {
    auto found = std::find(mesh.slots.begin(), mesh.slots.end(), slot);
    if (found == mesh.slots.end()) found = mesh.slots.insert(mesh.slots.end(), slot);
    number.push_back(static_cast<std::uint32_t>(found - mesh.slots.begin()));
  }
  mesh.slot.resize(before, 0);
  for (std::uint32_t i = 0; i < part.triangles.size(); ++i)
    mesh.slot.push_back(number[part.slot_of(i)]);
  if (mesh.slots.size() == 1) mesh.slot.clear();
}

}  // namespace

void append_mesh(Mesh& mesh, const Mesh& part) {
  if (part.triangles.empty()) return;
  const std::size_t before = mesh.vertex_count(), more = part.vertex_count();
  // A mesh without triangles may have an unused slot.
  if (mesh.triangles.empty()) mesh.slots.clear();
  append_slots(mesh, part);
  mesh.positions.resize(before);
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  append_column(mesh.normals, before, part.normals, more);
  append_column(mesh.dpdu, before, part.dpdu, more);
  append_column(mesh.dpdv, before, part.dpdv, more);
  mesh.textures.resize(std::max(mesh.textures.size(), part.textures.size()));
  const TextureSpace none;
  for (std::size_t s = 0; s < mesh.textures.size(); ++s) {
    const TextureSpace& other = s < part.textures.size() ? part.textures[s] : none;
    append_column(mesh.textures[s].coordinate, before, other.coordinate, more);
    append_column(mesh.textures[s].basis_u, before, other.basis_u, more);
    append_column(mesh.textures[s].basis_v, before, other.basis_v, more);
  }
  mesh.motion.resize(std::max(mesh.motion.size(), part.motion.size()));
  for (std::size_t m = 0; m < mesh.motion.size(); ++m)
    append_column(mesh.motion[m], before, m < part.motion.size() ? part.motion[m] : Column(), more);
  const auto first = static_cast<std::uint32_t>(before);
  make_room(mesh.triangles, mesh.triangles.size() + part.triangles.size());
  for (const Triangle& t : part.triangles)
    mesh.triangles.push_back({t.a + first, t.b + first, t.c + first});
}

}  // namespace oriel::geom
