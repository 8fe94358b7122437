// SPDX-License-Identifier: Apache-2.0
// Objects, instances, groups and lights that geometry shaders make.
#include <cstring>
#include <mutex>
#include <unordered_map>

#include "sdk/context.h"
#include "sdk/geometry_work.h"
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

scene::Value boolean(bool on) {
  scene::Value v;
  v.kind = scene::Value::Kind::Boolean;
  v.boolean = on;
  return v;
}
scene::Value integer(int number) {
  scene::Value v;
  v.kind = scene::Value::Kind::Numbers;
  v.integral = true;
  v.numbers = {static_cast<double>(number)};
  return v;
}

/// Sets the last vertex's entry of a column that may not be there yet.
void set_last(std::vector<std::uint32_t>& column, std::size_t vertices, int value) {
  column.resize(vertices, scene::kNone);
  if (value >= 0) column.back() = static_cast<std::uint32_t>(value);
}

Mat4 matrix_of(const miMatrix m) {
  Mat4 out;
  std::memcpy(out.getValue(), m, sizeof(miMatrix));
  return out;
}

/// The name that an item was given by name or by tag.
std::string item_name(const char* name, miTag tag) {
  const std::string* known = GeometryWork::name_of(tag);
  std::string own = taken(name);
  return known ? *known : own;
}

}  // namespace

GeometryWork*& GeometryWork::current() {
  thread_local GeometryWork* work = nullptr;
  return work;
}

std::string GeometryWork::name_for(const char* wanted) {
  return free_name(wanted ? taken(wanted) : std::string("made"));
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
  if (work.results.size() == 1) return work.results[0];
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
  scene::PolygonGroup* group = open_group();
  if (!group || group->vertices.point.empty()) return miFALSE;
  set_last(group->vertices.normal, group->vertices.size(), normal);
  return miTRUE;
}

miBoolean mi_api_vertex_tex_add(int coordinate, int bump_x, int bump_y) {
  scene::PolygonGroup* group = open_group();
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

miInstance* mi_api_instance_begin(const char* name) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return nullptr;
  work->instance = {};
  work->instance.name = work->name_for(name);
  work->instance_data = {};
  for (const int i : {0, 5, 10, 15})
    work->instance_data.tf.global_to_local[i] = work->instance_data.tf.local_to_global[i] = 1;
  return &work->instance_data;
}

miTag mi_api_instance_end(const char* name, miTag item, ...) {
  GeometryWork* work = GeometryWork::current();
  if (!work || work->instance.name.empty()) return miNULLTAG;
  scene::Instance& made = work->instance;
  made.element = item_name(name, item);
  made.transform = matrix_of(work->instance_data.tf.global_to_local);
  if (const std::string* material = GeometryWork::name_of(work->instance_data.material))
    made.materials = {*material};
  const std::string own = made.name;
  work->scene->add(std::move(made));
  made = {};
  return GeometryWork::tag_of(own);
}

miGroup* mi_api_instgroup_begin(const char* name) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return nullptr;
  work->group = {};
  work->group.name = work->name_for(name);
  return reinterpret_cast<miGroup*>(&work->group);
}

miBoolean mi_api_instgroup_additem(const char* name, miTag tag) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return miFALSE;
  work->group.members.push_back(item_name(name, tag));
  return miTRUE;
}

miTag mi_api_instgroup_end(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work || work->group.name.empty()) return miNULLTAG;
  const std::string own = work->group.name;
  work->scene->add(std::move(work->group));
  work->group = {};
  return GeometryWork::tag_of(own);
}

miLight* mi_api_light_begin(const char* name) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return nullptr;
  work->light = {};
  work->light.name = work->name_for(name);
  work->light_data = {};
  return &work->light_data;
}

miTag mi_api_light_end(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work || work->light.name.empty()) return miNULLTAG;
  const miLight& data = work->light_data;
  if (data.type != miLIGHT_DIRECTION) work->light.origin = vec(data.origin);
  if (data.type != miLIGHT_ORIGIN) work->light.direction = vec(data.direction);
  if (data.type == miLIGHT_SPOT) work->light.spread = data.spread;
  if (const std::string* shader = GeometryWork::name_of(data.shader))
    work->light.shaders.push_back({*shader, {}, {}, false, {}});
  const std::string own = work->light.name;
  work->scene->add(std::move(work->light));
  work->light = {};
  return GeometryWork::tag_of(own);
}

miBoolean mi_api_function_call(const char* declaration) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return miFALSE;
  work->calls.push_back({{}, taken(declaration), {}, false, {}});
  return miTRUE;
}

miBoolean mi_api_parameter_name(const char* name) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return miFALSE;
  work->parameter = taken(name);
  return miTRUE;
}

miBoolean mi_api_parameter_value(miParam_type type, void* value, ...) {
  GeometryWork* work = GeometryWork::current();
  if (!work || work->calls.empty() || !value) return miFALSE;
  scene::Value v;
  const auto numbers = [&](int count) {
    v.kind = scene::Value::Kind::Numbers;
    const auto* from = static_cast<const miScalar*>(value);
    v.numbers.assign(from, from + count);
  };
  switch (type) {
    case miTYPE_BOOLEAN:
      v = boolean(*static_cast<miBoolean*>(value) != miFALSE);
      break;
    case miTYPE_INTEGER:
      v = integer(*static_cast<miInteger*>(value));
      break;
    case miTYPE_SCALAR:
      numbers(1);
      break;
    case miTYPE_COLOR:
      numbers(4);
      break;
    case miTYPE_VECTOR:
      numbers(3);
      break;
    case miTYPE_TRANSFORM:
      numbers(16);
      break;
    case miTYPE_STRING:
      v.kind = scene::Value::Kind::Text;
      v.text = static_cast<const char*>(value);
      break;
    default: {
      const std::string* name = GeometryWork::name_of(*static_cast<miTag*>(value));
      if (!name) return miFALSE;
      v.kind = scene::Value::Kind::Text;
      v.text = *name;
    }
  }
  work->calls.back().arguments.push_back({work->parameter, std::move(v), {}});
  return miTRUE;
}

miTag mi_api_function_call_end(miTag next) {
  GeometryWork* work = GeometryWork::current();
  if (!work || work->calls.empty()) return miNULLTAG;
  scene::ShaderElement element;
  element.name = work->name_for(nullptr);
  element.functions.push_back(std::move(work->calls.back()));
  work->calls.pop_back();
  if (const std::string* behind = GeometryWork::name_of(next))
    element.functions.push_back({*behind, {}, {}, false, {}});
  const std::string own = element.name;
  work->scene->add(std::move(element));
  return GeometryWork::tag_of(own);
}

miTag mi_api_tag_lookup(const char* name) {
  const std::string own = taken(name);
  GeometryWork* work = GeometryWork::current();
  if (!work || !work->scene->find(own)) return miNULLTAG;
  return GeometryWork::tag_of(own);
}

char* mi_api_name_lookup(miTag tag) {
  const std::string* name = GeometryWork::name_of(tag);
  return name ? const_cast<char*>(name->c_str()) : nullptr;
}

}  // extern "C"
