// SPDX-License-Identifier: Apache-2.0
// Particles made by geometry shaders. They are rendered as round hair segments: a tube is one
// segment, a sphere is a segment of nearly zero length.
#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "sdk/geometry_work.h"

using oriel::sdk::MapDeclaration;
using oriel::sdk::MapField;

struct miMap_decl {
  MapDeclaration declaration;
};

namespace oriel::sdk {
namespace {

constexpr int kMaxDimensions = 6;

/// Declarations by name; never freed, since other shaders may use them.
struct Declarations {
  std::mutex mutex;
  std::map<std::string, std::unique_ptr<miMap_decl>> by_name;
};
Declarations& declarations() {
  static Declarations all;
  return all;
}

/// Fields of maps are passed as miParameter pointers to another structure.
MapField* field_of(miParameter* parameter) { return reinterpret_cast<MapField*>(parameter); }
miParameter* parameter_of(MapField* field) { return reinterpret_cast<miParameter*>(field); }

MapWork* open_map() {
  GeometryWork* work = GeometryWork::current();
  return work && work->map.open ? &work->map : nullptr;
}

/// Values of a field of the current particle by name; null if there is none.
const std::vector<double>* values_of(const MapWork& map, const std::string& name) {
  std::size_t local = 1, global = 0;  // after the position
  for (const MapDeclaration::Field& field : map.declaration.fields) {
    const std::size_t at = field.global ? global++ : local++;
    if (field.name != name) continue;
    const auto& list = field.global ? map.globals : map.values;
    return at < list.size() ? &list[at] : nullptr;
  }
  return nullptr;
}

/// Values of a shape attribute: of the field that was assigned to it, else of the field with the
/// same name.
const std::vector<double>* shape_values(const MapWork& map, const std::string& shape) {
  const auto named = map.shape_fields.find(shape);
  return values_of(map, named == map.shape_fields.end() ? shape : named->second);
}

float shape_number(const MapWork& map, const std::string& shape, float otherwise) {
  const std::vector<double>* values = shape_values(map, shape);
  if (!values || values->empty() || !std::isfinite((*values)[0])) return otherwise;
  return static_cast<float>((*values)[0]);
}

Vec3 vector_of(const std::vector<double>* values, const Vec3& otherwise) {
  if (!values || values->empty()) return otherwise;
  Vec3 v(0);
  for (int i = 0; i < 3 && i < static_cast<int>(values->size()); ++i) {
    const double n = (*values)[static_cast<std::size_t>(i)];
    v[i] = std::isfinite(n) ? static_cast<float>(n) : 0.0f;
  }
  return v;
}

/// Splits off the values of global fields, which precede those of the first particle.
void take_globals(MapWork& map) {
  if (map.globals_taken) return;
  map.globals_taken = true;
  const auto globals = static_cast<std::size_t>(
      std::count_if(map.declaration.fields.begin(), map.declaration.fields.end(),
                    [](const MapDeclaration::Field& f) { return f.global; }));
  const std::size_t own = 1 + map.declaration.fields.size() - globals;
  if (map.values.size() <= own) return;
  const auto end =
      map.values.begin() + static_cast<std::ptrdiff_t>(std::min(globals, map.values.size() - own));
  map.globals.assign(map.values.begin(), end);
  map.values.erase(map.values.begin(), end);
}

void add_end(scene::Hair& hair, const Vec3& p, float radius) {
  hair.scalars.insert(hair.scalars.end(), {p.x, p.y, p.z, std::max(0.0f, radius)});
}

void add_particle(MapWork& map) {
  take_globals(map);
  if (map.values.empty() || map.values[0].empty()) return;
  const Vec3 p = vector_of(&map.values[0], Vec3(0));
  const float radius = shape_number(map, "radius", 1);
  scene::Hair& hair = map.hair;
  if (map.tubes) {
    const Vec3 way = vector_of(shape_values(map, "direction"), Vec3(0, 0, 1));
    const float length = shape_number(map, "length", 1);
    add_end(hair, p, shape_number(map, "radius0", radius));
    add_end(hair, p + normalize(way) * length, shape_number(map, "radius1", radius));
  } else {
    // Far below the pixel size of the sphere, far above rounding errors.
    constexpr float kHalfLength = 1e-3f;
    const Vec3 half(radius * kHalfLength, 0, 0);
    add_end(hair, p - half, radius);
    add_end(hair, p + half, radius);
  }
  hair.first.push_back(static_cast<std::uint32_t>(hair.scalars.size()));
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miBoolean mi_api_map_decl_dim(int dim) {
  GeometryWork* work = GeometryWork::current();
  if (!work || dim < 1 || dim > kMaxDimensions) return miFALSE;
  work->map.dimension = dim;
  return miTRUE;
}

miParameter* mi_api_map_field_decl(miParam_type type, const char* name, int dimension,
                                   miBoolean global) {
  GeometryWork* work = GeometryWork::current();
  std::string own = taken(name);
  if (!work || (type != miTYPE_SCALAR && type != miTYPE_INTEGER) || dimension < 0) return nullptr;
  MapField& field = work->map_fields.emplace_back();
  field.field = {std::move(own), global != miFALSE};
  field.first = &field;
  return parameter_of(&field);
}

miParameter* mi_api_map_field_append(miParameter* list, miParameter* field) {
  if (!list || !field || list == field) return list ? list : field;
  MapField* last = field_of(list)->first;
  while (last->next) last = last->next;
  if (last != field_of(field)) last->next = field_of(field);
  for (MapField* f = field_of(field); f; f = f->next) f->first = field_of(list)->first;
  return field;
}

miMap_decl* mi_api_map_decl_begin(const char* name, miParameter* fields) {
  GeometryWork* work = GeometryWork::current();
  const std::string own = taken(name);
  if (!work || own.empty()) return nullptr;
  auto made = std::make_unique<miMap_decl>();
  made->declaration.dimension = work->map.dimension;
  for (const MapField* f = fields ? field_of(fields)->first : nullptr; f; f = f->next)
    made->declaration.fields.push_back(f->field);
  const std::lock_guard lock(declarations().mutex);
  return (declarations().by_name[own] = std::move(made)).get();
}

void mi_api_map_decl_end(void) {
  if (GeometryWork* work = GeometryWork::current()) work->map.dimension = MapWork().dimension;
}

miBoolean mi_api_map_obj_type(const char* type) {
  GeometryWork* work = GeometryWork::current();
  const std::string own = taken(type);
  if (!work || work->object.name.empty() || (own != "spheres" && own != "tubes")) return miFALSE;
  work->map.tubes = own == "tubes";
  work->map.shape_fields.clear();
  return miTRUE;
}

miBoolean mi_api_map_obj_field(const char* shape_field, const char* map_field) {
  GeometryWork* work = GeometryWork::current();
  const std::string shape = taken(shape_field), field = taken(map_field);
  if (!work) return miFALSE;
  work->map.shape_fields[shape] = field;
  return miTRUE;
}

miBoolean mi_api_map_begin(const char* declaration) {
  GeometryWork* work = GeometryWork::current();
  const std::string own = taken(declaration);
  if (!work) return miFALSE;
  const std::lock_guard lock(declarations().mutex);
  const auto found = declarations().by_name.find(own);
  if (found == declarations().by_name.end()) return miFALSE;
  MapWork& map = work->map;
  map.declaration = found->second->declaration;
  map.open = true;
  map.globals_taken = false;
  map.values.clear(), map.globals.clear(), map.current.clear();
  map.hair = {};
  map.hair.degree = 1;
  map.hair.per_vertex = {{scene::Hair::Field::Kind::Radius, 1}};
  map.hair.first = {0};
  return miTRUE;
}

miBoolean mi_api_map_value(miParam_type type, void* value) {
  MapWork* map = open_map();
  if (!map || !value) return miFALSE;
  if (type == miTYPE_SCALAR)
    map->current.push_back(*static_cast<const miScalar*>(value));
  else if (type == miTYPE_INTEGER)
    map->current.push_back(*static_cast<const miInteger*>(value));
  else
    return miFALSE;
  return miTRUE;
}

void mi_api_map_field_end(void) {
  MapWork* map = open_map();
  if (!map) return;
  map->values.push_back(std::move(map->current));
  map->current.clear();
}

void mi_api_map_element_end(void) {
  MapWork* map = open_map();
  if (!map) return;
  add_particle(*map);
  map->values.clear();
  map->current.clear();
}

miTag mi_api_map_end(int) {
  MapWork* map = open_map();
  if (!map) return miNULLTAG;
  GeometryWork& work = *GeometryWork::current();
  map->open = false;
  if (!work.object.name.empty()) work.object.hairs.push_back(std::move(map->hair));
  map->hair = {};
  return GeometryWork::tag_of(work.prefix + "map of " + work.object.name);
}

}  // extern "C"
