// SPDX-License-Identifier: Apache-2.0
// Objects that geometry shaders make, and what they return.
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

/// Names that shaders have tags for; for the life of the program.
struct Names {
  std::mutex mutex;
  std::deque<std::string> names;
  std::unordered_map<std::string, miTag> tags;
};
Names& names() {
  static Names all;
  return all;
}

using made::boolean;
using made::integer;
using made::take;

/// Flags as an object's or instance's header says them.
template <class T>
void store_flags(const T& from, std::vector<scene::Statement>& flags) {
  const auto say = [&](const char* word, const scene::Value& value) {
    flags.push_back({word, false, {value}, {}});
  };
  say("visible", boolean(from.visible));
  say("shadow", boolean(from.shadow));
  say("reflection", integer(from.reflection));
  say("refraction", integer(from.refraction));
  say("transparency", integer(from.transparency));
  say("finalgather", integer(from.finalgather));
  say("caustic", integer(from.caustic));
  say("globillum", integer(from.globillum));
}

scene::PolygonGroup* polygons() {
  GeometryWork* work = GeometryWork::current();
  return work && !work->object.groups.empty() ? &work->object.groups.back() : nullptr;
}

/// Sets the last vertex's entry of a column that may not be there yet.
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
  const std::string name = take(wanted);
  if (incremental && wanted)
    if (std::string known = own_name(name); scene->find(known)) return known;
  const std::string stem = !wanted ? prefix + "made" : scene->find(name) ? prefix + name : name;
  std::string own = stem;
  for (int i = 2; scene->find(own); ++i) own = stem + "#" + std::to_string(i);
  if (wanted) given[name] = own;
  return own;
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
  // Placeholders are filled at once: there is room for what is seen and what is not.
  for (std::size_t i = 0; i < work.callbacks.size(); ++i) {
    const GeometryWork::Callback callback = work.callbacks[i];
    work.object = {};
    callback.call(GeometryWork::tag_of(callback.object), callback.arguments);
  }
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

miObject* mi_api_object_begin(const char* name) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return nullptr;
  // The content of a placeholder comes under the placeholder's name.
  const bool filling = !work->callbacks.empty() && !name;
  work->object = {};
  work->object.name = filling ? work->callbacks.back().object : work->name_for(name);
  work->object_flags = {};
  work->object_flags.visible = work->object_flags.shadow = miTRUE;
  work->object_flags.reflection = work->object_flags.refraction = 3;
  work->object_flags.transparency = work->object_flags.finalgather = 3;
  work->object_flags.face = 'a';
  return &work->object_flags;
}

miTag mi_api_object_end(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work || work->object.name.empty()) return miNULLTAG;
  store_flags(work->object_flags, work->object.flags);
  made::attach(work->object_flags, work->object.flags);
  const miTag tag = work->add(std::move(work->object));
  work->object = {};
  return tag;
}

miBoolean mi_api_basis_list_clear(void) { return miTRUE; }

miBoolean mi_api_object_group_begin(double) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return miFALSE;
  work->object.groups.emplace_back();
  return miTRUE;
}
miBoolean mi_api_object_group_end(void) { return polygons() ? miTRUE : miFALSE; }

miBoolean mi_api_vector_xyz_add(const miVector* v) {
  scene::PolygonGroup* group = polygons();
  if (!group) return miFALSE;
  group->vectors.push_back(vec(*v));
  return miTRUE;
}

miBoolean mi_api_vertex_add(int point) {
  scene::PolygonGroup* group = polygons();
  if (!group) return miFALSE;
  scene::VertexList& v = group->vertices;
  v.point.push_back(static_cast<std::uint32_t>(point));
  // Columns that are there have an entry for each vertex.
  const std::size_t n = v.point.size();
  if (!v.normal.empty()) v.normal.resize(n, scene::kNone);
  for (scene::TextureColumn& t : v.textures)
    for (auto* column : {&t.coordinate, &t.basis_u, &t.basis_v})
      if (!column->empty()) column->resize(n, scene::kNone);
  for (auto& column : v.motion) column.resize(n, scene::kNone);
  return miTRUE;
}

miBoolean mi_api_vertex_normal_add(int normal) {
  scene::PolygonGroup* group = polygons();
  if (!group || group->vertices.point.empty()) return miFALSE;
  set_last(group->vertices.normal, group->vertices.size(), normal);
  return miTRUE;
}

miBoolean mi_api_vertex_tex_add(int coordinate, int bump_x, int bump_y) {
  scene::PolygonGroup* group = polygons();
  if (!group || group->vertices.point.empty()) return miFALSE;
  scene::VertexList& v = group->vertices;
  // The first space that the last vertex does not have yet.
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
  scene::PolygonGroup* group = polygons();
  if (!group || group->vertices.point.empty()) return miFALSE;
  auto& columns = group->vertices.motion;
  if (columns.empty()) columns.emplace_back();
  set_last(columns[0], group->vertices.size(), motion);
  return miTRUE;
}

miBoolean mi_api_poly_begin_tag(int, miTag material) {
  scene::PolygonGroup* group = polygons();
  if (!group) return miFALSE;
  scene::PolygonList& p = group->polygons;
  if (p.first.empty()) p.first.push_back(0);
  std::uint32_t index = scene::kNone;
  if (const std::string* name = GeometryWork::name_of(material)) {
    index = 0;
    while (index < group->materials.size() && group->materials[index] != *name) ++index;
    if (index == group->materials.size()) group->materials.push_back(*name);
  }
  p.material.push_back(index);
  return miTRUE;
}

miBoolean mi_api_poly_index_add(int vertex) {
  scene::PolygonGroup* group = polygons();
  if (!group || vertex < 0 || static_cast<std::size_t>(vertex) >= group->vertices.size())
    return miFALSE;
  group->polygons.indices.push_back(static_cast<std::uint32_t>(vertex));
  return miTRUE;
}

miBoolean mi_api_poly_hole_add(void) {
  scene::PolygonGroup* group = polygons();
  if (!group) return miFALSE;
  group->polygons.holes.push_back(static_cast<std::uint32_t>(group->polygons.indices.size()));
  return miTRUE;
}

miBoolean mi_api_poly_end(void) {
  scene::PolygonGroup* group = polygons();
  if (!group) return miFALSE;
  group->polygons.first.push_back(static_cast<std::uint32_t>(group->polygons.indices.size()));
  return miTRUE;
}

miBoolean mi_api_object_callback(miGeoshader_callback callback, void* args) {
  GeometryWork* work = GeometryWork::current();
  if (!work || !callback || work->object.name.empty()) return miFALSE;
  work->callbacks.push_back({work->object.name, callback, args});
  return miTRUE;
}

miBoolean mi_api_incremental(miBoolean on) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return miFALSE;
  work->incremental = on != miFALSE;
  return miTRUE;
}

}  // extern "C"
