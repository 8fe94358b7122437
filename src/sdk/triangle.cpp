// SPDX-License-Identifier: Apache-2.0
// Vertex data of the hit triangle, and the projection of its texture to the screen.
#include "sdk/triangle.h"

#include <cmath>

#include "geom/barycentric.h"
#include "geom/motion.h"
#include "runtime/world.h"
#include "sdk/context.h"

namespace oriel::sdk {

Vec3 HitTriangle::position(int corner) const {
  const auto i = static_cast<std::size_t>(corner);
  const Vec3 p = geom::corners_at(*mesh, {corners[0], corners[1], corners[2]}, time)[i];
  return mesh_to_world ? transform_point(p, *mesh_to_world) : p;
}

Vec3 HitTriangle::weights(const Vec3& place) const {
  return geom::barycentric_weights(place, position(0), position(1), position(2));
}

std::optional<HitTriangle> hit_triangle(const ShadingPoint& point) {
  if (point.environment || point.instance < 0 || !point.world || !point.world->accel) return {};
  const geom::Accel& accel = *point.world->accel;
  const auto index = static_cast<std::uint32_t>(point.instance);
  if (index >= accel.instance_count()) return {};
  const geom::MeshId id = accel.instance(index).mesh;
  const geom::Mesh& mesh = accel.mesh(id);
  if (point.primitive >= mesh.triangles.size()) return {};
  const geom::Triangle& t = mesh.triangles[point.primitive];
  HitTriangle hit{&mesh, {t.a, t.b, t.c}, nullptr, nullptr, nullptr, point.time};
  if (accel.is_baked(id)) {
    hit.mesh_to_object = point.to_object;
    hit.object_to_mesh = point.to_world;
  } else {
    hit.mesh_to_world = point.to_world;
  }
  return hit;
}

namespace {

enum class Sort : std::uint8_t { Point, Vector, Normal, Number };

/// Copies the values of the corners in object space; valid while the shader runs.
bool give(const HitTriangle& hit, const std::vector<Vec3>& column, Sort sort, const miVector** a,
          const miVector** b, const miVector** c) {
  if (column.empty()) return false;
  auto* values = static_cast<miVector*>(allocate_for_call(3 * sizeof(miVector)));
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3 v = column[hit.corners[i]];
    if (hit.mesh_to_object && sort == Sort::Point) v = transform_point(v, *hit.mesh_to_object);
    if (hit.mesh_to_object && sort == Sort::Vector) v = transform_vector(v, *hit.mesh_to_object);
    if (hit.object_to_mesh && sort == Sort::Normal && v != Vec3(0))
      v = normalize(transform_normal(v, *hit.object_to_mesh));
    values[i] = as_c(v);
  }
  *a = values, *b = values + 1, *c = values + 2;
  return true;
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miBoolean mi_tri_vectors(const miState* state, int which, int ntex, const miVector** a,
                         const miVector** b, const miVector** c) {
  const ShadingPoint& point = *context(state).point;
  if (!state->pri || point.ray_kind == RayKind::Displace) return miFALSE;
  const std::optional<HitTriangle> hit = hit_triangle(point);
  if (!hit) return miFALSE;
  const geom::Mesh& mesh = *hit->mesh;
  const auto answer = [&](const std::vector<Vec3>& column, Sort sort) {
    return give(*hit, column, sort, a, b, c) ? miTRUE : miFALSE;
  };
  const bool has_space = ntex >= 0 && static_cast<std::size_t>(ntex) < mesh.textures.size();
  const geom::TextureSpace* space =
      has_space ? &mesh.textures[static_cast<std::size_t>(ntex)] : nullptr;
  switch (which) {
    case 'p':
      return answer(mesh.positions, Sort::Point);
    case 'n':
      return answer(mesh.normals, Sort::Normal);
    case 'm':
      return mesh.motion.empty() ? miFALSE : answer(mesh.motion[0], Sort::Vector);
    case 't':
      return space ? answer(space->coordinate, Sort::Number) : miFALSE;
    case 'u':
      return space ? answer(space->basis_u, Sort::Vector) : miFALSE;
    case 'v':
      return space ? answer(space->basis_v, Sort::Vector) : miFALSE;
    case 'U':
      return answer(mesh.dpdu, Sort::Vector);
    case 'V':
      return answer(mesh.dpdv, Sort::Vector);
    default:
      return miFALSE;
  }
}

// Points are in pixels relative to the hit, so the third row of their map is the coordinate at the
// hit; displacements are in the tangent plane (first order).
miBoolean mi_texture_filter_project(miVector p[3], miVector t[3], miState* state, miScalar disc_r,
                                    miUint space) {
  const ShadingPoint& point = *context(state).point;
  const std::optional<HitTriangle> hit = hit_triangle(point);
  miVector step[2];
  if (!hit || space >= hit->mesh->textures.size() || !mi_raster_unit(state, &step[0], &step[1]))
    return miFALSE;
  const std::vector<Vec3>& column = hit->mesh->textures[space].coordinate;
  if (column.empty()) return miFALSE;
  const Vec3 &n = point.geometric_normal, &d = point.ray_direction, place = vec(state->point);
  const float slant = dot(d, n);
  if (slant == 0) return miFALSE;
  const auto coordinate = [&](const Vec3& at) {
    const Vec3 w = hit->weights(at);
    return column[hit->corners[0]] * w.x + column[hit->corners[1]] * w.y +
           column[hit->corners[2]] * w.z;
  };
  p[0] = {0, 0, 0}, p[1] = {disc_r, 0, 0}, p[2] = {0, disc_r, 0};
  t[0] = as_c(coordinate(place));
  for (int i = 0; i < 2; ++i) {
    mi_vector_from_object(state, &step[i], &step[i]);
    const Vec3 across = vec(step[i]) * disc_r;
    t[i + 1] = as_c(coordinate(place + across - d * (dot(across, n) / slant)));
  }
  return miTRUE;
}

}  // extern "C"
