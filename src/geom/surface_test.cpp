// SPDX-License-Identifier: Apache-2.0
// Normals stay on the front; missing fields have their documented fallback.
#include "geom/surface.h"

#include <gtest/gtest.h>

namespace oriel::geom {
namespace surface_test {

Mesh triangle(const Vec3& na, const Vec3& nb, const Vec3& nc) {
  Mesh mesh;
  const Vec3 places[] = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0)};
  mesh.positions.assign(std::begin(places), std::end(places));
  for (const Vec3& n : {na, nb, nc}) mesh.normals.push_back(n);
  mesh.triangles = {{0, 1, 2}};
  mesh.slots.emplace_back();
  return mesh;
}

SurfacePoint at(const Mesh& mesh, float u, float v) {
  Hit hit;
  hit.u = u;
  hit.v = v;
  hit.primitive = 0;
  SurfacePoint point;
  interpolate(mesh, hit, {}, point);
  return point;
}

TEST(Surface, VertexNormalsInterpolate) {
  const Vec3 tilted = normalize(Vec3(1, 0, 1));
  const SurfacePoint point = at(triangle(Vec3(0, 0, 1), tilted, Vec3(0, 0, 1)), 0.5f, 0);
  EXPECT_EQ(point.ng, Vec3(0, 0, 1));
  EXPECT_LT(length(point.ns - normalize(Vec3(0, 0, 1) + tilted)), 1e-6f);
}

TEST(Surface, NormalsWrittenForTheOtherSideAreReversed) {
  const Vec3 tilted = normalize(Vec3(1, 0, -1));
  const SurfacePoint point = at(triangle(tilted, tilted, tilted), 0.2f, 0.3f);
  EXPECT_LT(length(point.ns + tilted), 1e-6f);
}

TEST(Surface, NormalBelowTheHorizonIsClampedToIt) {
  const Vec3 wrong = normalize(Vec3(1, 0, -0.5f));
  const SurfacePoint point = at(triangle(Vec3(0, 0, 1), wrong, Vec3(0, 0, 1)), 1, 0);
  EXPECT_GT(dot(point.ns, point.ng), 0);
  EXPECT_LT(dot(point.ns, point.ng), 0.01f);
  EXPECT_GT(point.ns.x, 0.99f);
}

TEST(Surface, NullNormalIsReplacedByTheGeometricNormal) {
  const Vec3 tilted = normalize(Vec3(1, 0, 1));
  const Mesh mesh = triangle(Vec3(0), tilted, Vec3(0));
  EXPECT_EQ(at(mesh, 0, 0).ns, Vec3(0, 0, 1));
  EXPECT_LT(length(at(mesh, 1, 0).ns - tilted), 1e-6f);
  EXPECT_EQ(at(triangle(Vec3(0), Vec3(0), Vec3(0)), 0.3f, 0.3f).ns, Vec3(0, 0, 1));
}

TEST(Surface, WithoutTextureSpaceThereAreNoDerivatives) {
  const SurfacePoint point = at(triangle(Vec3(0), Vec3(0), Vec3(0)), 0.3f, 0.3f);
  EXPECT_EQ(point.texture_count, 0u);
  EXPECT_EQ(point.dpdu, Vec3(0));
  EXPECT_EQ(point.uv_density, 0);
}

TEST(Surface, ExplicitDerivativesOverrideTextureSpace) {
  Mesh mesh = triangle(Vec3(0), Vec3(0), Vec3(0));
  mesh.textures.resize(1);
  mesh.textures[0].coordinate = mesh.positions;
  EXPECT_EQ(at(mesh, 0.1f, 0.1f).dpdu, Vec3(1, 0, 0));
  EXPECT_FLOAT_EQ(at(mesh, 0.1f, 0.1f).uv_density, 1);
  mesh.dpdu.assign(3, Vec3(0, 5, 0));
  mesh.dpdv.assign(3, Vec3(7, 0, 0));
  EXPECT_EQ(at(mesh, 0.25f, 0.25f).dpdu, Vec3(0, 5, 0));
  EXPECT_EQ(at(mesh, 0.25f, 0.25f).dpdv, Vec3(7, 0, 0));
}

TEST(Surface, TinyTrianglesStillHaveANormal) {
  Mesh mesh = triangle(Vec3(0), Vec3(0), Vec3(0));
  for (Vec3& p : mesh.positions) p *= 1e-15f;
  EXPECT_LT(length(at(mesh, 0.3f, 0.3f).ng - Vec3(0, 0, 1)), 1e-6f);
}

TEST(Surface, MirroringAMeshKeepsItsFront) {
  Mesh mesh = triangle(Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 1));
  Mat4 mirror;
  mirror.setScale(Imath::V3f(-1, 1, 1));
  transform_mesh(mesh, mirror, mirror);
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 2, 1}));
  EXPECT_EQ(at(mesh, 0.3f, 0.3f).ng, Vec3(0, 0, 1));
  EXPECT_EQ(at(mesh, 0.3f, 0.3f).ns, Vec3(0, 0, 1));
}

}  // namespace surface_test
}  // namespace oriel::geom
