// SPDX-License-Identifier: Apache-2.0
// Objects made by geometry shaders, and their results.
#include <deque>
#include <mutex>
#include <unordered_map>

#include "sdk/context.h"
#include "sdk/current.h"
#include "sdk/geometry_parts.h"
#include "sdk/geometry_work.h"
#include "sdk/host.h"
#include "sdk/tags.h"

namespace oriel::sdk {
namespace {

/// Names with tags; never freed.
struct Names {
  std::mutex mutex;
  std::deque<std::string> names;
  std::unordered_map<std::string, miTag> tags;
};
Names& names() {
  static Names all;
  return all;
}

/// Sets the entry of the last vertex in a column, which is created if necessary.
void set_last(std::vector<std::uint32_t>& column, std::size_t vertices, int value) {
  column.resize(vertices, scene::kNone);
  if (value >= 0) column.back() = static_cast<std::uint32_t>(value);
}

}  // namespace

GeometryWork*& GeometryWork::current() {
  thread_local GeometryWork* work = nullptr;
  return work;
}

std::string GeometryWork::name_for(const char* wanted) {
  const std::string name = taken(wanted);
  if (incremental && !name.empty())
    if (std::string known = own_name(name); scene->find(known)) return known;
  return free_name(name);
}

std::string GeometryWork::own_name(const std::string& name) const {
  const auto found = given.find(name);
  return found == given.end() ? name : found->second;
}

miTag GeometryWork::add(scene::Element element) {
  const std::string name = scene::name_of(element);
  scene->add(std::move(element));
  const miTag tag = tag_of(name);
  if (Host* host = current_host()) host->renew(tag);
  return tag;
}

miTag GeometryWork::tag_of(const std::string& name) {
  const std::lock_guard lock(names().mutex);
  miTag& tag = names().tags[name];
  if (tag == miNULLTAG) {
    tag = make_tag(TagKind::Made, names().names.size());
    names().names.push_back(name);
  }
  return tag;
}

const std::string* GeometryWork::name_of(miTag tag) {
  if (kind_of(tag) != TagKind::Made) return nullptr;
  const std::lock_guard lock(names().mutex);
  return index_of(tag) < names().names.size() ? &names().names[index_of(tag)] : nullptr;
}

std::string finish(GeometryWork& work) {
  finish_objects(work);
  if (work.results.empty()) return {};
  if (work.results.size() == 1 && !work.scene->get<scene::Instance>(work.results[0]))
    return work.results[0];
  scene::InstanceGroup all;
  for (const std::string& result : work.results) {
    if (work.scene->get<scene::Instance>(result)) {
      all.members.push_back(result);
      continue;
    }
    scene::Instance placed;
    placed.name = work.name_for(nullptr);
    placed.element = result;
    all.members.push_back(placed.name);
    work.scene->add(std::move(placed));
  }
  const std::string name = work.name_for(nullptr);
  all.name = name;
  work.scene->add(std::move(all));
  return name;
}

}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miBoolean mi_geoshader_add_result(miTag* result, miTag tag) {
  GeometryWork* work = GeometryWork::current();
  const std::string* name = GeometryWork::name_of(tag);
  if (!work || !name) return miFALSE;
  work->results.push_back(*name);
  *result = tag;
  return miTRUE;
}

miBoolean mi_geoshader_echo_tag(FILE*, miTag, miEchoOptions*) {
  if (Host* host = current_host())
    host->warn_once("OR-SDK-040", "mi_geoshader_echo_tag: elements are not written as text");
  return miFALSE;
}

miBoolean mi_api_basis_list_clear(void) {
  if (GeometryWork* work = GeometryWork::current()) work->object.bases.clear();
  return miTRUE;
}

miBoolean mi_api_object_group_begin(double) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return miFALSE;
  work->object.groups.emplace_back();
  return miTRUE;
}
miBoolean mi_api_object_group_end(void) { return open_group() ? miTRUE : miFALSE; }

miBoolean mi_api_vector_xyz_add(const miVector* v) {
  scene::PolygonGroup* group = open_group();
  if (!group) return miFALSE;
  group->vectors.push_back(vec(*v));
  return miTRUE;
}

miBoolean mi_api_vertex_add(int point) {
  scene::PolygonGroup* group = open_group();
  if (!group) return miFALSE;
  scene::VertexList& v = group->vertices;
  v.point.push_back(static_cast<std::uint32_t>(point));
  // Existing columns have an entry for each vertex.
  const std::size_t n = v.point.size();
  if (!v.normal.empty()) v.normal.resize(n, scene::kNone);
  for (scene::TextureColumn& t : v.textures)
    for (auto* column : {&t.coordinate, &t.basis_u, &t.basis_v})
      if (!column->empty()) column->resize(n, scene::kNone);
  for (auto& column : v.motion) column.resize(n, scene::kNone);
  return miTRUE;
}

miBoolean mi_api_vertex_normal_add(int normal) {
  scene::PolygonGroup* group = open_group();
  if (!group || group->vertices.point.empty()) return miFALSE;
  set_last(group->vertices.normal, group->vertices.size(), normal);
  return miTRUE;
}

miBoolean mi_api_vertex_tex_add(int coordinate, int bump_x, int bump_y) {
  scene::PolygonGroup* group = open_group();
  if (!group || group->vertices.point.empty()) return miFALSE;
  scene::VertexList& v = group->vertices;
  // The first texture space that the last vertex lacks.
  std::size_t space = 0;
  while (space < v.textures.size() && v.textures[space].coordinate.back() != scene::kNone) ++space;
  if (space == v.textures.size()) v.textures.emplace_back();
  scene::TextureColumn& column = v.textures[space];
  set_last(column.coordinate, v.size(), coordinate);
  if (bump_x >= 0) set_last(column.basis_u, v.size(), bump_x);
  if (bump_y >= 0) set_last(column.basis_v, v.size(), bump_y);
  return miTRUE;
}

miBoolean mi_api_vertex_motion_add(int motion) {
  scene::PolygonGroup* group = open_group();
  if (!group || group->vertices.point.empty()) return miFALSE;
  auto& columns = group->vertices.motion;
  if (columns.empty()) columns.emplace_back();
  set_last(columns[0], group->vertices.size(), motion);
  return miTRUE;
}

miBoolean mi_api_poly_begin_tag(int, miTag material) {
  scene::PolygonGroup* group = open_group();
  if (!group) return miFALSE;
  scene::PolygonList& p = group->polygons;
  if (p.first.empty()) p.first.push_back(0);
  const std::string* name = GeometryWork::name_of(material);
  p.material.push_back(material_index(*group, name ? *name : std::string()));
  return miTRUE;
}

miBoolean mi_api_poly_index_add(int vertex) {
  scene::PolygonGroup* group = open_group();
  if (!group || vertex < 0 || static_cast<std::size_t>(vertex) >= group->vertices.size())
    return miFALSE;
  group->polygons.indices.push_back(static_cast<std::uint32_t>(vertex));
  return miTRUE;
}

miBoolean mi_api_poly_hole_add(void) {
  scene::PolygonGroup* group = open_group();
  if (!group) return miFALSE;
  group->polygons.holes.push_back(static_cast<std::uint32_t>(group->polygons.indices.size()));
  return miTRUE;
}

miBoolean mi_api_poly_end(void) {
  scene::PolygonGroup* group = open_group();
  if (!group) return miFALSE;
  group->polygons.first.push_back(static_cast<std::uint32_t>(group->polygons.indices.size()));
  return miTRUE;
}

}  // extern "C"
