// SPDX-License-Identifier: Apache-2.0
// Refined hits equal those of exact arithmetic, independent of Embree's estimate.
#include "geom/refine_hit.h"

#include <gtest/gtest.h>

#include <random>

#include "geom/accel.h"

namespace oriel::geom {
namespace refine_hit_test {

Mesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  Mesh mesh;
  mesh.positions = {a, b, c, Vec3(0)};
  mesh.triangles = {{0, 1, 2}};
  mesh.slots.emplace_back();
  return mesh;
}

Mesh hair(bool line) {
  Mesh mesh;
  mesh.curves.points = {{Vec3(0, 0, 0), .1f},
                        {Vec3(1, .5f, 0), .12f},
                        {Vec3(2, -.5f, .2f), .09f},
                        {Vec3(3, 0, 0), .05f}};
  if (line)
    mesh.curves.lines = {0, 1, 2};
  else
    mesh.curves.beziers = {0};
  mesh.slots.emplace_back();
  return mesh;
}

class Random {
 public:
  float operator()(float a, float b) {
    return std::uniform_real_distribution<float>(a, b)(engine_);
  }
  Vec3 place(float reach) {
    return Vec3((*this)(-reach, reach), (*this)(-reach, reach), (*this)(-reach, reach));
  }

 private:
  std::mt19937 engine_{17};
};

/// The hit with the reciprocal estimate of another processor.
Hit disturbed(Hit hit, Random& random) {
  const float factor = 1 + random(-3e-7f, 3e-7f);
  hit.t *= factor;
  hit.u *= factor;
  hit.v *= factor;
  return hit;
}

void expect_same_bits(const Hit& a, const Hit& b) {
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(a.u, b.u);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.ng, b.ng);
}

TEST(RefineHit, DistanceOfATriangleIsThatOfItsPlane) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = random.place(5), b = random.place(5), c = random.place(5);
    const float u = random(.05f, .6f), v = random(.05f, .35f);
    const Vec3 org = random.place(20), dir = a * (1 - u - v) + b * u + c * v - org;
    Hit hit;
    hit.primitive = 0;
    refine_hit(triangle(a, b, c), org, dir, hit);
    using Wide = Imath::Vec3<long double>;
    const Wide wa(a), n = (Wide(b) - wa).cross(Wide(c) - wa);
    const long double t = n.dot(wa - Wide(org)) / n.dot(Wide(dir));
    EXPECT_NEAR(hit.t, static_cast<double>(t), 6.1e-8 * std::abs(static_cast<double>(t)));
    // Areas of the parts into which the point divides the triangle.
    const Wide p = Wide(org) + Wide(dir) * t - wa;
    EXPECT_NEAR(hit.u, double(p.cross(Wide(c) - wa).dot(n) / n.dot(n)), 1e-7);
    EXPECT_NEAR(hit.v, double((Wide(b) - wa).cross(p).dot(n) / n.dot(n)), 1e-7);
  }
}

TEST(RefineHit, IsIndependentOfTheEmbreeEstimate) {
  Random random;
  for (const Mesh& mesh :
       {triangle(Vec3(0, -1, -1), Vec3(3, -1, -.5f), Vec3(1, 2, 1)), hair(true), hair(false)}) {
    Accel accel;
    accel.add_instance({accel.add_mesh(mesh), Mat4(), Mat4()});
    accel.commit();
    int hits = 0, same = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 org(random(0, 3), random(-1, 1), 5);
      const Vec3 dir = Vec3(random(0, 3), random(-.5f, .5f), 0) - org;
      Hit hit;
      if (!accel.intersect({org, 0, dir}, hit)) continue;
      ++hits;
      Hit again = disturbed(hit, random);
      refine_hit(mesh, org, dir, again);
      // At the ends of curves Embree's values are kept.
      same += again.t == hit.t && again.u == hit.u && again.ng == hit.ng ? 1 : 0;
      if (mesh.curves.empty()) expect_same_bits(again, hit);
    }
    EXPECT_GT(hits, 500);
    EXPECT_GT(same, .99 * hits);
  }
}

TEST(RefineHit, HairIsHitOnItsSurface) {
  Random random;
  const Mesh mesh = hair(false);
  Accel accel;
  accel.add_instance({accel.add_mesh(mesh), Mat4(), Mat4()});
  accel.commit();
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 org(random(.2f, 2.8f), random(-1, 1), 5), dir(0, 0, -1);
    Hit hit;
    if (!accel.intersect({org, 0, dir}, hit) || hit.u < .01f || hit.u > .99f) continue;
    ++hits;
    const float u = hit.u, w = 1 - u;
    const auto& c = mesh.curves.points;
    const Vec3 axis = c[0].p * (w * w * w) + c[1].p * (3 * w * w * u) + c[2].p * (3 * w * u * u) +
                      c[3].p * (u * u * u);
    const float radius = c[0].radius * (w * w * w) + c[1].radius * (3 * w * w * u) +
                         c[2].radius * (3 * w * u * u) + c[3].radius * (u * u * u);
    EXPECT_NEAR(length(org + dir * hit.t - axis), radius, 2e-6f);
  }
  EXPECT_GT(hits, 300);
}

TEST(RefineHit, OfCoincidentSurfacesTheFirstInstanceIsHit) {
  Random random;
  for (const bool instanced : {false, true}) {
    Accel accel;
    const Mesh mesh = triangle(Vec3(-1, -1, .3f), Vec3(2, -1, .1f), Vec3(-1, 2, -.2f));
    const MeshId id = accel.add_mesh(mesh);
    // The other triangle lies in the same plane and begins at another corner.
    const MeshId other =
        instanced
            ? id
            : accel.add_mesh(triangle(mesh.positions[2], mesh.positions[0], mesh.positions[1]));
    accel.add_instance({id, Mat4(), Mat4()});
    accel.add_instance({other, Mat4(), Mat4()});
    accel.commit();
    for (int i = 0; i < 5000; ++i) {
      const Vec3 org = random.place(3) + Vec3(0, 0, 9);
      Hit hit;
      if (!accel.intersect({org, 0, random.place(.6f) - org}, hit)) continue;
      EXPECT_EQ(hit.instance, 0u);
    }
  }
}

TEST(RefineHit, ASurfaceDoesNotBlockRaysThatStartInItsPlane) {
  Accel accel;
  accel.add_instance(
      {accel.add_mesh(triangle(Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0))), Mat4(), Mat4()});
  accel.commit();
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const Ray ray{Vec3(random(-1, 1), random(-1, 1), 0), 0, random.place(1) + Vec3(0, 0, 2)};
    Hit hit;
    EXPECT_FALSE(accel.occluded(ray));
    EXPECT_FALSE(accel.intersect(ray, hit));
  }
}

}  // namespace refine_hit_test
}  // namespace oriel::geom
