// SPDX-License-Identifier: Apache-2.0
// The surface at a hit: place with its error, normals, texture spaces, derivatives.
#pragma once

#include <cstdint>

#include "geom/mesh.h"
#include "geom/tessellate.h"

namespace oriel::geom {

/// A hit as Accel reports it.
struct Hit {
  float t = 0;  ///< in lengths of the ray's direction
  float u = 0;  ///< barycentric weight of corner b; that of a is 1 - u - v
  float v = 0;  ///< of corner c
  std::uint32_t instance = kNone;
  std::uint32_t primitive = kNone;  ///< triangle of the instance's mesh
  Vec3 ng{0, 0, 0};                 ///< world, toward the front, not normalised
  float time = 0;                   ///< of the ray
};

// Conventions
//   All vectors are in world space and belong to the front side, whichever side was hit: the front
//   is where the triangle runs counter-clockwise in object space, mirrored instances included.
struct SurfacePoint {
  Vec3 p;
  /// From p this far along ng (or against it) no ray meets the surface it starts on; bounds the
  /// rounding of p and of the ray's way into an instance and back.
  float offset;
  Vec3 ng;  ///< unit geometric normal
  /// Unit shading normal, always on the side of ng: vertex normals that as a whole look to the back
  /// of their triangle are reversed, a single one that does is bent to the horizon.
  Vec3 ns;
  Vec3 dpdu, dpdv;   ///< of texture space 0, or the scene's derivatives; null when there are none
  float uv_density;  ///< area in texture space 0 per world area; 0 when there is no such space
  float time;        ///< of the hit
  Vec3 speed;        ///< way per unit of ray time; null where nothing moves
  std::uint32_t slot;
  std::uint32_t instance, user, primitive;
  std::uint32_t texture_count;
  struct Texture {
    Vec3 coordinate;
    Vec3 basis_u, basis_v;  ///< bump basis, lengths as transformed; null when not given
  };
  Texture textures[kMaxTextureSpaces];  ///< only the first texture_count are set

  /// Where a ray in direction `d` (either side) may start.
  Vec3 ray_origin(const Vec3& d) const { return p + ng * (dot(d, ng) < 0 ? -offset : offset); }
};

/// Matrices of an instance whose mesh is in object space.
struct Placement {
  const Mat4* local_to_world = nullptr;
  const Mat4* world_to_local = nullptr;
};

/// Fills all of `point` but instance and user. A null placement: the mesh is in world space.
///
/// Model:   the place comes from the barycentrics, not from t, and the offset bounds the rounding
///          of that sum, of the transforms there and back and of the intersection's differences.
///          On a mesh that moves all is at the time of the hit, vertex normals turned as their
///          triangle has turned; that the instance moves is left to Accel.
/// Source:  M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 3rd ed., 3.9, for
///          running error bounds; the factors for the tracer's own inverse were found by trial.
/// Checked: AccelTest.RaysNeverMeetTheSurfaceTheyStartOn, Surface.*
void interpolate(const Mesh& mesh, const Hit& hit, const Placement& placement, SurfacePoint& point);

/// Derivatives of the place on a flat triangle by the first two coordinates of a texture space, in
/// the mesh's space; null vectors where the space has none or its area there is 0.
struct TextureDerivatives {
  Vec3 by_u{0}, by_v{0};
  float area = 0;  ///< twice the triangle's in the texture space
};
/// e1, e2: corners b and c less corner a.
TextureDerivatives texture_derivatives(const Mesh& mesh, const Triangle& t, std::size_t space,
                                       const Vec3& e1, const Vec3& e2);

/// Carries all columns of `mesh` through `matrix` and keeps its front: a mirroring matrix swaps
/// corners b and c of all triangles.
void transform_mesh(Mesh& mesh, const Mat4& matrix, const Mat4& inverse);

/// `v` turned as `to` is turned from `from`, both unit, by the shortest way.
Vec3 turned(const Vec3& v, const Vec3& from, const Vec3& to);

/// Determinant of the upper 3x3, in double: its product of three scales leaves float's range early.
double determinant3(const Mat4& m);

}  // namespace oriel::geom
