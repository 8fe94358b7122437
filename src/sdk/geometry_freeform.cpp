// SPDX-License-Identifier: Apache-2.0
// Free-form surfaces made by geometry shaders: the same elements as in scene files.
#include <algorithm>
#include <limits>

#include "sdk/context.h"
#include "sdk/geometry_work.h"

/// A list that shaders append to.
struct miDlist {
  miDlist_type type = miDLIST_GEOSCALAR;
  std::vector<miGeoScalar> numbers;
  std::vector<miTag> tags;
  std::vector<void*> pointers;
};

namespace oriel::sdk {
namespace {

/// Converts to the precision of scene files.
float narrow(double value) {
  constexpr double kMax = std::numeric_limits<float>::max();
  return value == value ? static_cast<float>(std::clamp(value, -kMax, kMax)) : 0.0f;
}

std::vector<float> numbers_of(const miDlist* list) {
  std::vector<float> numbers;
  if (!list) return numbers;
  for (const miGeoScalar n : list->numbers) numbers.push_back(narrow(n));
  return numbers;
}

scene::FreeSurface* open_surface() {
  GeometryWork* work = GeometryWork::current();
  return work && work->surface.open ? &work->surface.surface : nullptr;
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miDlist* mi_api_dlist_create(miDlist_type type) {
  auto* list = new miDlist;
  list->type = type;
  return list;
}

miBoolean mi_api_dlist_add(miDlist* list, void* value) {
  if (!list) return miFALSE;
  if (list->type == miDLIST_POINTER) {
    list->pointers.push_back(value);
    return miTRUE;
  }
  if (!value) return miFALSE;
  if (list->type == miDLIST_TAG)
    list->tags.push_back(*static_cast<const miTag*>(value));
  else
    list->numbers.push_back(*static_cast<const miGeoScalar*>(value));
  return miTRUE;
}

void mi_api_dlist_delete(miDlist* list) { delete list; }

miBoolean mi_api_geovector_xyz_add(const miGeoVector* v) {
  scene::PolygonGroup* group = open_group();
  if (!group || !v) return miFALSE;
  group->vectors.emplace_back(narrow(v->x), narrow(v->y), narrow(v->z));
  return miTRUE;
}

miBoolean mi_api_basis_add(const char* name, miBoolean rational, miBasis_type type, int degree,
                           int step, miDlist* matrix) {
  using Kind = scene::Basis::Kind;
  constexpr Kind kKinds[] = {Kind::Bezier, Kind::BSpline, Kind::Taylor, Kind::Cardinal,
                             Kind::Matrix};
  GeometryWork* work = GeometryWork::current();
  scene::Basis basis;
  basis.name = taken(name);
  if (!work || work->object.name.empty() || type < miBASIS_BEZIER || type > miBASIS_MATRIX)
    return miFALSE;
  basis.kind = kKinds[type];
  basis.rational = rational != miFALSE;
  if (basis.kind != Kind::Cardinal) basis.degree = degree;
  if (basis.kind == Kind::Matrix) {
    basis.step = step;
    basis.matrix = numbers_of(matrix);
  }
  work->object.bases.push_back(std::move(basis));
  return miTRUE;
}

miBoolean mi_api_surface_begin(const char* name, const char* material) {
  GeometryWork* work = GeometryWork::current();
  scene::FreeSurface surface;
  surface.name = taken(name);
  const std::string wanted = taken(material);
  scene::PolygonGroup* group = open_group();
  if (!work || !group) return miFALSE;
  surface.material = material_index(*group, work->own_name(wanted));
  work->surface = {std::move(surface), true};
  return miTRUE;
}

miBoolean mi_api_surface_params(int direction, const char* basis, double min, double max,
                                miDlist* knots, miBoolean rational) {
  scene::BasisUse use{rational != miFALSE, taken(basis), numbers_of(knots)};
  scene::FreeSurface* surface = open_surface();
  if (!surface || direction < miU || direction > miV) return miFALSE;
  (direction == miU ? surface->u : surface->v) = std::move(use);
  (direction == miU ? surface->u_min : surface->v_min) = narrow(min);
  (direction == miU ? surface->u_max : surface->v_max) = narrow(max);
  return miTRUE;
}

miBoolean mi_api_vertex_ref_add(int vertex, double weight) {
  const scene::PolygonGroup* group = open_group();
  scene::FreeSurface* surface = open_surface();
  if (!group || !surface || vertex < 0 ||
      static_cast<std::size_t>(vertex) >= group->vertices.size())
    return miFALSE;
  auto& points = surface->textures.empty() ? surface->points : surface->textures.back().points;
  points.push_back({static_cast<std::uint32_t>(vertex), narrow(weight)});
  return miTRUE;
}

miBoolean mi_api_surface_texture_begin(miBoolean volume, miBoolean bump, const char* basis_u,
                                       miDlist* u, miBoolean rational_u, const char* basis_v,
                                       miDlist* v, miBoolean rational_v) {
  scene::TextureSurface texture;
  texture.volume = volume != miFALSE;
  texture.vector = bump != miFALSE;
  texture.u = {rational_u != miFALSE, taken(basis_u), numbers_of(u)};
  texture.v = {rational_v != miFALSE, taken(basis_v), numbers_of(v)};
  scene::FreeSurface* surface = open_surface();
  if (!surface) return miFALSE;
  surface->textures.push_back(std::move(texture));
  return miTRUE;
}

miBoolean mi_api_surface_end(void) {
  scene::PolygonGroup* group = open_group();
  scene::FreeSurface* surface = open_surface();
  if (!group || !surface) return miFALSE;
  group->freeform.surfaces.push_back(std::move(*surface));
  GeometryWork::current()->surface = {};
  return miTRUE;
}

}  // extern "C"
