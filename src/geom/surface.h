// SPDX-License-Identifier: Apache-2.0
// The surface at a hit: position with error bound, normals, texture spaces, derivatives.
#pragma once

#include <cstdint>

#include "geom/mesh.h"
#include "geom/tessellate.h"

namespace oriel::geom {

/// A hit as reported by Accel.
struct Hit {
  float t = 0;  ///< in units of the ray direction
  float u = 0;  ///< barycentric weight of corner b; that of a is 1 - u - v
  float v = 0;  ///< of corner c
  std::uint32_t instance = kNone;
  std::uint32_t primitive = kNone;  ///< index in the mesh of the instance
  Vec3 ng{0, 0, 0};                 ///< world space, towards the front, not normalised
  float time = 0;                   ///< of the ray
};

// Conventions
//   All vectors are in world space and refer to the front side, even if the back was hit. The front
//   is the side with counter-clockwise corners in object space, also for mirrored instances.
struct SurfacePoint {
  Vec3 p;
  /// A ray that starts at p + offset ng (or p - offset ng) does not hit its own surface again. The
  /// offset bounds the rounding of p and of the transform of the ray into an instance and back.
  float offset;
  Vec3 ng;  ///< unit geometric normal
  /// Unit shading normal, always on the side of ng. Vertex normals that all point to the back of
  /// the triangle are reversed; a single one that does is bent to the horizon.
  Vec3 ns;
  Vec3 dpdu, dpdv;   ///< in texture space 0, or derivatives of the scene; null if there are none
  float uv_density;  ///< area in texture space 0 per world area; 0 if there is no texture space
  float time;        ///< of the hit
  Vec3 speed;        ///< displacement per unit of ray time; null if nothing moves
  std::uint32_t slot;
  std::uint32_t instance, user, primitive;
  std::uint32_t texture_count;
  struct Texture {
    Vec3 coordinate;
    Vec3 basis_u, basis_v;  ///< bump basis with transformed lengths; null if not given
  };
  Texture textures[kMaxTextureSpaces];  ///< only the first texture_count are set

  /// Start of a ray in direction `d`, on either side.
  Vec3 ray_origin(const Vec3& d) const { return p + ng * (dot(d, ng) < 0 ? -offset : offset); }
};

/// Matrices of an instance whose mesh is in object space.
struct Placement {
  const Mat4* local_to_world = nullptr;
  const Mat4* world_to_local = nullptr;
};

/// Fills all of `point` except instance and user. A null placement means that the mesh is in world
/// space.
///
/// Model:   the position is computed from the barycentrics, not from t. The offset bounds the
///          rounding of that sum, of the transforms in both directions and of the differences in
///          the intersection. On a moving mesh all data is at the time of the hit; vertex normals
///          are rotated with their triangle. Motion of the instance is handled in Accel.
/// Source:  M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 3rd ed., 3.9, for
///          running error bounds; the factors for Embree's own inverse matrix were determined by
///          experiment.
/// Checked: AccelTest.RaysDoNotHitTheirOriginSurface, Surface.*
void interpolate(const Mesh& mesh, const Hit& hit, const Placement& placement, SurfacePoint& point);

/// Derivatives of the position on a flat triangle by the first two coordinates of a texture space,
/// in the space of the mesh; null vectors if there is no such space or its area is 0.
struct TextureDerivatives {
  Vec3 by_u{0}, by_v{0};
  float area = 0;  ///< twice the area of the triangle in texture space
};
/// e1, e2: corners b and c minus corner a.
TextureDerivatives texture_derivatives(const Mesh& mesh, const Triangle& t, std::size_t space,
                                       const Vec3& e1, const Vec3& e2);

/// Transforms all columns of `mesh` and preserves its front: a mirroring matrix swaps corners b and
/// c of all triangles.
void transform_mesh(Mesh& mesh, const Mat4& matrix, const Mat4& inverse);

/// Rotates `v` by the smallest rotation that maps `from` to `to` (both unit vectors).
Vec3 turned(const Vec3& v, const Vec3& from, const Vec3& to);

/// Determinant of the upper 3x3 in double, since a product of three scales easily leaves the range
/// of float.
double determinant3(const Mat4& m);

}  // namespace oriel::geom
