// SPDX-License-Identifier: Apache-2.0
#include "geom/surface.h"

#include <algorithm>

#include "geom/hair.h"
#include "geom/motion.h"

namespace oriel::geom {

namespace {

// Relative error bound of n rounded operations, (n eps) / (1 - n eps) for small n.
constexpr float gamma(int n) { return static_cast<float>(n) * 6.0e-8f; }

Vec3 abs(const Vec3& v) { return Vec3(std::abs(v.x), std::abs(v.y), std::abs(v.z)); }

// Transforms an error bound: |M| |v|.
Vec3 transform_bound(const Vec3& v, const Mat4& m) {
  return Vec3(v.x * std::abs(m[0][0]) + v.y * std::abs(m[1][0]) + v.z * std::abs(m[2][0]),
              v.x * std::abs(m[0][1]) + v.y * std::abs(m[1][1]) + v.z * std::abs(m[2][1]),
              v.x * std::abs(m[0][2]) + v.y * std::abs(m[1][2]) + v.z * std::abs(m[2][2]));
}

Vec3 translation(const Mat4& m) { return Vec3(m[3][0], m[3][1], m[3][2]); }

// Normalises a vector whose squared length may be out of range of float.
Vec3 normalize_any(const Vec3& v) {
  const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 ? normalize(v * (1 / largest)) : v;
}

// Bounds the distance between Embree's plane and that of the triangle. Embree's normal is the
// rounded cross product of the sides; its tilt grows with the length and thinness of the triangle.
float tilt_of(const Vec3& e1, const Vec3& e2, float inverse_area) {
  const float l1 = length(e1), l2 = length(e2), longest = std::max(l1, l2);
  const float thinness = l1 * l2 * inverse_area;
  constexpr float kThinnest = 1000;  // beyond this value the offset would be visible
  return longest * gamma(8) * (1 + std::min(thinness, kThinnest));
}

struct Weights {
  float a, b, c;
  Vec3 operator()(const std::vector<Vec3>& column, const Triangle& t) const {
    return column[t.a] * a + column[t.b] * b + column[t.c] * c;
  }
  Vec3 operator()(const std::array<Vec3, 3>& corner) const {
    return corner[0] * a + corner[1] * b + corner[2] * c;
  }
  Vec3 operator()(const Vec3& at_a, const Vec3& at_b, const Vec3& at_c) const {
    return at_a * a + at_b * b + at_c * c;
  }
};

Vec3 shading_normal(const Mesh& mesh, const Triangle& t, const Weights& weights, const Vec3& ng) {
  const Vec3& a = mesh.normals[t.a];
  const Vec3& b = mesh.normals[t.b];
  const Vec3& c = mesh.normals[t.c];
  const Vec3 front = dot(a + b + c, ng) < 0 ? -ng : ng;
  const Vec3 n = (a == Vec3(0) ? front : a) * weights.a + (b == Vec3(0) ? front : b) * weights.b +
                 (c == Vec3(0) ? front : c) * weights.c;
  return front == ng ? n : -n;
}

// Computes the shading normal and the velocity of a moving triangle. The position error grows with
// the distance of the corners between keys.
void move_triangle(const Mesh& mesh, const Triangle& t, float time, const Weights& weights,
                   SurfacePoint& point, Vec3& error) {
  point.speed = weights(speeds_at(mesh, t, time));
  for (const std::uint32_t v : {t.a, t.b, t.c})
    error += (abs(mesh.keys.front()[v]) + abs(mesh.keys.back()[v])) * gamma(7);
  if (mesh.normals.empty()) return;
  const Vec3& a = mesh.positions[t.a];
  const Vec3 rest = normalize_any(cross(mesh.positions[t.b] - a, mesh.positions[t.c] - a));
  point.ns = turned(shading_normal(mesh, t, weights, rest), rest, point.ng);
}

// Derivatives in texture space 0 or from the scene, and the ratio of areas.
void derive(const Mesh& mesh, const Triangle& t, const Weights& weights, const Vec3& e1,
            const Vec3& e2, SurfacePoint& point) {
  const TextureDerivatives by = texture_derivatives(mesh, t, 0, e1, e2);
  point.dpdu = by.by_u;
  point.dpdv = by.by_v;
  point.uv_density = by.area;
  if (!mesh.dpdu.empty() && !mesh.dpdv.empty()) {
    point.dpdu = weights(mesh.dpdu, t);
    point.dpdv = weights(mesh.dpdv, t);
  }
}

}  // namespace

TextureDerivatives texture_derivatives(const Mesh& mesh, const Triangle& t, std::size_t space,
                                       const Vec3& e1, const Vec3& e2) {
  TextureDerivatives by;
  if (space >= mesh.textures.size() || mesh.textures[space].coordinate.empty()) return by;
  const std::vector<Vec3>& uv = mesh.textures[space].coordinate;
  const Vec3 d1 = uv[t.b] - uv[t.a], d2 = uv[t.c] - uv[t.a];
  const float area = d1.x * d2.y - d1.y * d2.x;
  by.area = std::abs(area);
  if (area == 0) return by;
  const Vec3 by_u = (e1 * d2.y - e2 * d1.y) * (1 / area);
  const Vec3 by_v = (e2 * d1.x - e1 * d2.x) * (1 / area);
  if (!is_finite(by_u) || !is_finite(by_v)) return by;
  by.by_u = by_u;
  by.by_v = by_v;
  return by;
}

void interpolate(const Mesh& mesh, const Hit& hit, const Placement& placement,
                 SurfacePoint& point) {
  point.time = hit.time;
  point.speed = Vec3(0);
  if (hit.primitive >= mesh.triangles.size()) return interpolate_curve(mesh, hit, placement, point);
  const Triangle& t = mesh.triangles[hit.primitive];
  const Weights weights{1 - hit.u - hit.v, hit.u, hit.v};
  const bool moves = !mesh.keys.empty();
  std::array<Vec3, 3> moved;
  if (moves) moved = moved_corners(mesh, t, hit.time);
  const Vec3& a = moves ? moved[0] : mesh.positions[t.a];
  const Vec3& b = moves ? moved[1] : mesh.positions[t.b];
  const Vec3& c = moves ? moved[2] : mesh.positions[t.c];
  const Vec3 e1 = b - a, e2 = c - a;
  const Mat4* forward = placement.local_to_world;
  const Mat4* back = placement.world_to_local;

  // Position and normals in the space of the mesh.
  point.p = weights(a, b, c);
  Vec3 error = (abs(a) * std::abs(weights.a) + abs(b) * weights.b + abs(c) * weights.c) * gamma(7);
  const Vec3 cross_product = cross(e1, e2);
  const float area = length(cross_product);
  // Twice the area, within the range where its square is a float.
  const bool plain = area > 1e-12f && area < 1e12f;
  const float inverse_area = area > 0 ? 1 / area : 0;
  point.ng = plain ? cross_product * inverse_area : normalize_any(cross_product);
  const bool flat = mesh.normals.empty();
  point.ns = flat ? point.ng : shading_normal(mesh, t, weights, point.ng);
  if (moves) move_triangle(mesh, t, hit.time, weights, point, error);
  derive(mesh, t, weights, e1, e2, point);

  float tilt = tilt_of(e1, e2, inverse_area);

  // Transform to world space.
  float world_area = area;
  if (forward) {
    const Vec3 local = point.p;
    point.p = transform_point(local, *forward);
    const Vec3 there = transform_bound(abs(local), *forward) + abs(translation(*forward));
    const Vec3 and_back = transform_bound(abs(point.p), *back) + abs(translation(*back));
    error = transform_bound(error + and_back * gamma(8), *forward) + there * gamma(4);
    world_area = length(cross(transform_vector(e1, *forward), transform_vector(e2, *forward)));
    const Vec3 normal = transform_normal(point.ng, *back);
    tilt /= length(normal);  // the distance of planes grows as the normal gets shorter
    point.ng = normalize_any(normal);
    point.ns = transform_normal(point.ns, *back);
    if (moves) point.speed = transform_vector(point.speed, *forward);
    point.dpdu = transform_vector(point.dpdu, *forward);
    point.dpdv = transform_vector(point.dpdv, *forward);
  }
  point.offset = dot(abs(point.ng), error + abs(point.p) * gamma(2)) + tilt;
  if (world_area > 0) point.uv_density /= world_area;

  // A shading normal below the horizon would be lit from behind.
  constexpr float kHorizon = 1e-3f;
  point.ns = flat ? point.ng : normalize(point.ns);
  if (const float cosine = dot(point.ns, point.ng); !(cosine >= kHorizon))
    point.ns = normalize(point.ns + point.ng * (kHorizon - cosine));

  // Vertex attributes of the scene.
  point.slot = mesh.slot_of(hit.primitive);
  point.primitive = hit.primitive;
  point.texture_count =
      static_cast<std::uint32_t>(std::min(mesh.textures.size(), kMaxTextureSpaces));
  for (std::uint32_t s = 0; s < point.texture_count; ++s) {
    const TextureSpace& space = mesh.textures[s];
    SurfacePoint::Texture& texture = point.textures[s];
    const auto read = [&](const std::vector<Vec3>& column, bool is_vector) {
      if (column.empty()) return Vec3(0);
      const Vec3 value = weights(column, t);
      return is_vector && forward ? transform_vector(value, *forward) : value;
    };
    texture.coordinate = read(space.coordinate, false);
    texture.basis_u = read(space.basis_u, true);
    texture.basis_v = read(space.basis_v, true);
  }
}

void transform_mesh(Mesh& mesh, const Mat4& matrix, const Mat4& inverse) {
  // Double, so that an instance far from the origin is rounded only once in each direction.
  const Imath::M44d exact(matrix);
  const auto place = [&exact](std::vector<Vec3>& positions) {
    for (std::size_t i = 0; i + 1 < positions.size(); ++i)
      positions[i] = Vec3(Imath::V3d(positions[i]) * exact);
  };
  place(mesh.positions);
  for (std::vector<Vec3>& key : mesh.keys) place(key);
  // Not normalised: the lengths act as interpolation weights, as in object space.
  for (Vec3& n : mesh.normals) n = transform_normal(n, inverse);
  const auto carry = [&matrix](std::vector<Vec3>& column) {
    for (Vec3& v : column) v = transform_vector(v, matrix);
  };
  for (TextureSpace& space : mesh.textures) {
    carry(space.basis_u);
    carry(space.basis_v);
  }
  carry(mesh.dpdu);
  carry(mesh.dpdv);
  for (std::vector<Vec3>& step : mesh.motion) carry(step);
  if (determinant3(matrix) < 0)
    for (Triangle& t : mesh.triangles) std::swap(t.b, t.c);
}

Vec3 turned(const Vec3& v, const Vec3& from, const Vec3& to) {
  const Vec3 axis = cross(from, to);
  const float cosine = dot(from, to);
  if (cosine < -0.999f) return -v;
  return v * cosine + cross(axis, v) + axis * (dot(axis, v) / (1 + cosine));
}

double determinant3(const Mat4& m) {
  const Imath::V3d x(m[0][0], m[0][1], m[0][2]), y(m[1][0], m[1][1], m[1][2]),
      z(m[2][0], m[2][1], m[2][2]);
  return x.cross(y).dot(z);
}

}  // namespace oriel::geom
