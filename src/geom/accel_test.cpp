// SPDX-License-Identifier: Apache-2.0
// Ray intersection with baked and instanced meshes, and self-intersection.
#include "geom/accel.h"

#include <gtest/gtest.h>

#include <random>

#include "base/parallel.h"

namespace oriel::geom {
namespace accel_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Mesh mesh_of(std::vector<Vec3> places, std::vector<Triangle> triangles) {
  Mesh mesh;
  mesh.positions = std::move(places);
  mesh.positions.push_back(Vec3(0));
  mesh.triangles = std::move(triangles);
  mesh.slots.emplace_back();
  return mesh;
}

// The triangle (0,0,0) (1,0,0) (0,1,0), front toward +z, with its texture space.
Mesh unit_triangle() {
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  mesh.textures.resize(1);
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 3, 0)})
    mesh.textures[0].coordinate.push_back(p);
  mesh.textures[0].basis_u = std::vector<Vec3>(3, Vec3(1, 0, 0));
  mesh.textures[0].basis_v = std::vector<Vec3>(3, Vec3(0, 1, 0));
  return mesh;
}

// A closed ball of `rings` x 2 `rings` quads with outward normals.
Mesh ball(int rings) {
  Mesh mesh;
  const int columns = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < columns; ++j) {
      const double theta = M_PI * i / rings, phi = 2 * M_PI * j / columns;
      const double r = i == 0 || i == rings ? 0 : std::sin(theta);  // poles without a hole
      mesh.positions.push_back(Vec3(static_cast<float>(r * std::cos(phi)),
                                    static_cast<float>(r * std::sin(phi)),
                                    static_cast<float>(std::cos(theta))));
    }
  mesh.normals = mesh.positions;
  mesh.positions.push_back(Vec3(0));
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>(i * columns + j % columns);
  };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < columns; ++j) {
      if (i + 1 < rings) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  mesh.slots.emplace_back();
  return mesh;
}

Mat4 inverse_of(const Mat4& m) { return Mat4(Imath::M44d(m).inverse()); }

InstanceDesc instance_of(MeshId mesh, const Mat4& to_world, std::uint32_t user = 0,
                         std::uint32_t mask = RayMask::All) {
  return {mesh, to_world, inverse_of(to_world), mask, user};
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float unit() { return std::uniform_real_distribution<float>(0, 1)(engine_); }
  float in(float low, float high) { return low + (high - low) * unit(); }
  Vec3 direction() {
    const float z = in(-1, 1), phi = in(0, kTwoPi), r = std::sqrt(std::max(0.0f, 1 - z * z));
    return Vec3(r * std::cos(phi), r * std::sin(phi), z);
  }
  // Rotation, anisotropic scale up to `stretch`, translation up to `far`.
  Mat4 placement(float stretch, float far, bool mirrored = false) {
    Mat4 first, scale, second, move;
    first.setEulerAngles(Imath::V3f(in(0, 6), in(0, 6), in(0, 6)));
    second.setEulerAngles(Imath::V3f(in(0, 6), in(0, 6), in(0, 6)));
    const auto factor = [&] { return std::pow(stretch, in(-1, 1)); };
    scale.setScale(Imath::V3f(factor(), factor(), mirrored ? -factor() : factor()));
    move.setTranslation(Imath::V3f(direction() * (far * unit())));
    return first * scale * second * move;
  }

 private:
  std::mt19937 engine_;
};

TEST(AccelTest, AnEmptyWorldIsNeverHit) {
  Accel accel;
  accel.commit();
  Hit hit;
  EXPECT_FALSE(accel.intersect({Vec3(0), 0, Vec3(0, 0, 1)}, hit));
  EXPECT_FALSE(accel.occluded({Vec3(0), 0, Vec3(0, 0, 1)}));
  EXPECT_TRUE(accel.bounds().isEmpty());
}

TEST(AccelTest, EmptyMeshesAndSingularInstancesAreNeverHit) {
  Accel accel;
  const MeshId empty = accel.add_mesh(Mesh());
  const MeshId triangle = accel.add_mesh(unit_triangle());
  accel.add_instance(instance_of(empty, Mat4()));
  accel.add_instance(instance_of(empty, Mat4()));
  Mat4 flat, broken;
  flat[2][2] = 0;
  broken[0][1] = kNan;
  const std::uint32_t first = accel.add_instance({triangle, flat, flat});
  accel.add_instance({triangle, broken, broken});
  accel.commit();
  const Ray ray{Vec3(0.2f, 0.2f, 1), 0, Vec3(0, 0, -1)};
  EXPECT_FALSE(accel.occluded(ray));
  EXPECT_TRUE(accel.set_transform(first, Mat4(), Mat4()));
  accel.commit();
  EXPECT_TRUE(accel.occluded(ray)) << "a repaired instance appears";
  EXPECT_FALSE(accel.set_transform(first, broken, broken));
}

TEST(AccelTest, HitsOfTransformedTrianglesMatchTheirClosedForm) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const bool mirrored = i % 2 == 1, instanced = i % 4 >= 2;
    const Mat4 place = random.placement(3, 10, mirrored);
    Accel accel;
    const MeshId mesh = accel.add_mesh(unit_triangle());
    const std::uint32_t index = accel.add_instance(instance_of(mesh, place, 77));
    Mat4 away;
    away.setTranslation(Imath::V3f(0, 0, 1e6f));
    if (instanced) accel.add_instance(instance_of(mesh, away));
    accel.commit();
    EXPECT_EQ(accel.is_baked(mesh), !instanced);

    const Vec3 local(0.3f, 0.4f, 0), target = transform_point(local, place);
    const Vec3 front = normalize(transform_normal(Vec3(0, 0, 1), inverse_of(place)));
    const Vec3 d = random.direction();
    if (std::abs(dot(d, front)) < 0.1f) continue;
    const Ray ray{target - d * 5.0f, 0, d * 2.0f};
    Hit hit;
    ASSERT_TRUE(accel.intersect(ray, hit));
    EXPECT_TRUE(accel.occluded(ray));
    EXPECT_NEAR(hit.t, 2.5f, 1e-4f);
    EXPECT_EQ(hit.instance, index);
    EXPECT_GT(dot(normalize(hit.ng), front), 0.9999f);

    SurfacePoint point;
    accel.interpolate(hit, point);
    EXPECT_LT(length(point.p - target), 1e-4f);
    EXPECT_EQ(point.user, 77u);
    EXPECT_GT(dot(point.ng, front), 0.9999f) << "front stays front, mirrored or not";
    EXPECT_GT(dot(point.ns, front), 0.9999f);
    ASSERT_EQ(point.texture_count, 1u);
    EXPECT_NEAR(point.textures[0].coordinate.x, 0.6f, 1e-4f);
    EXPECT_NEAR(point.textures[0].coordinate.y, 1.2f, 1e-4f);
    const Vec3 x = transform_vector(Vec3(1, 0, 0), place);
    const Vec3 y = transform_vector(Vec3(0, 1, 0), place);
    EXPECT_LT(length(point.dpdu - x / 2), 1e-4f);
    EXPECT_LT(length(point.dpdv - y / 3), 1e-4f);
    EXPECT_LT(length(point.textures[0].basis_u - x), 1e-4f);
    EXPECT_LT(length(point.textures[0].basis_v - y), 1e-4f);
    EXPECT_NEAR(point.uv_density * length(cross(x, y)), 6, 1e-3f);
  }
}

TEST(AccelTest, InstancedAndBakedMeshesGiveEqualHits) {
  Random random(2);
  for (int round = 0; round < 20; ++round) {
    const Mat4 place = random.placement(2, 5, round % 2 == 1);
    Accel baked, instanced;
    baked.add_instance(instance_of(baked.add_mesh(ball(12)), place));
    const MeshId mesh = instanced.add_mesh(ball(12));
    Mat4 away;
    away.setTranslation(Imath::V3f(1e5f, 0, 0));
    instanced.add_instance(instance_of(mesh, place));
    instanced.add_instance(instance_of(mesh, away));
    baked.commit();
    instanced.commit();
    int differing = 0, hits = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 target = transform_point(random.direction() * 0.9f, place);
      const Vec3 d = random.direction();
      const Ray ray{target - d * 10.0f, 0, d};
      Hit a, b;
      const bool hit_a = baked.intersect(ray, a), hit_b = instanced.intersect(ray, b);
      if (hit_a != hit_b || (hit_a && a.primitive != b.primitive)) {
        ++differing;  // on an edge, rounding decides
        continue;
      }
      if (!hit_a) continue;
      ++hits;
      EXPECT_NEAR(a.t, b.t, 1e-4f);
      SurfacePoint p, q;
      baked.interpolate(a, p);
      instanced.interpolate(b, q);
      EXPECT_LT(length(p.p - q.p), 2e-5f);
      EXPECT_LT(length(p.ng - q.ng), 1e-3f);
      EXPECT_LT(length(p.ns - q.ns), 1e-4f);
    }
    EXPECT_GT(hits, 700);
    EXPECT_LE(differing, 3);
  }
}

TEST(AccelTest, MasksApplyPerRayType) {
  for (const bool instanced : {false, true}) {
    Accel accel;
    const MeshId mesh = accel.add_mesh(unit_triangle());
    Mat4 away;
    away.setTranslation(Imath::V3f(1e5f, 0, 0));
    const std::uint32_t index =
        accel.add_instance(instance_of(mesh, Mat4(), 0, RayMask::Camera | RayMask::Shadow));
    if (instanced) accel.add_instance(instance_of(mesh, away));
    accel.commit();
    const auto seen = [&](std::uint32_t kind) {
      const Ray ray{Vec3(0.2f, 0.2f, 1), 0, Vec3(0, 0, -1), 10, kind, 0};
      Hit hit;
      EXPECT_EQ(accel.intersect(ray, hit), accel.occluded(ray));
      return accel.occluded(ray);
    };
    for (std::uint32_t kind = RayMask::Camera; kind <= RayMask::Probe; kind <<= 1)
      EXPECT_EQ(seen(kind), kind == RayMask::Camera || kind == RayMask::Shadow);
    accel.set_mask(index, RayMask::Probe);
    accel.commit();
    EXPECT_TRUE(seen(RayMask::Probe));
    EXPECT_FALSE(seen(RayMask::Camera));
  }
}

TEST(AccelTest, MovedInstancesAreHitAtTheirNewPosition) {
  for (const bool instanced : {false, true}) {
    Accel accel;
    const MeshId mesh = accel.add_mesh(unit_triangle());
    Mat4 away, mirror;
    away.setTranslation(Imath::V3f(1e5f, 0, 0));
    const std::uint32_t index = accel.add_instance(instance_of(mesh, away));
    if (instanced) accel.add_instance(instance_of(mesh, away));
    accel.commit();
    const Ray ray{Vec3(-0.2f, 0.2f, 1), 0, Vec3(0, 0, -1)};
    EXPECT_FALSE(accel.occluded(ray));
    mirror.setScale(Imath::V3f(-1, 1, 1));
    EXPECT_TRUE(accel.set_transform(index, mirror, mirror));
    accel.commit();
    Hit hit;
    ASSERT_TRUE(accel.intersect(ray, hit));
    EXPECT_GT(hit.ng.z, 0);
    EXPECT_EQ(accel.bounds().min.x, -1);
  }
}

TEST(AccelTest, ASecondInstanceAfterTheFirstCommitLeavesTheFirstInPlace) {
  Accel accel;
  const MeshId mesh = accel.add_mesh(unit_triangle());
  Mat4 mirrored, moved;
  mirrored.setScale(Imath::V3f(-2, 1, 1));
  moved.setTranslation(Imath::V3f(10, 0, 0));
  accel.add_instance(instance_of(mesh, mirrored, 1));
  accel.commit();
  EXPECT_TRUE(accel.is_baked(mesh));
  accel.add_instance(instance_of(mesh, moved, 2));
  accel.commit();
  EXPECT_FALSE(accel.is_baked(mesh));
  EXPECT_EQ(accel.mesh(mesh).positions[1], Vec3(1, 0, 0));
  Hit hit;
  ASSERT_TRUE(accel.intersect({Vec3(-1, 0.2f, 1), 0, Vec3(0, 0, -1)}, hit));
  EXPECT_EQ(accel.instance(hit.instance).user, 1u);
  EXPECT_GT(hit.ng.z, 0);
  ASSERT_TRUE(accel.intersect({Vec3(10.2f, 0.2f, 1), 0, Vec3(0, 0, -1)}, hit));
  EXPECT_EQ(accel.instance(hit.instance).user, 2u);
}

/// All hits of rays in a fixed pattern.
std::vector<float> scan(const Accel& accel) {
  std::vector<float> seen;
  for (int i = 0; i < 400; ++i) {
    const int row = i / 20;
    const float x = 0.03f * static_cast<float>(i % 20) - 0.05f;
    const float y = 0.03f * static_cast<float>(row) - 0.05f;
    Hit hit;
    if (!accel.intersect({Vec3(x, y, 4), 0, Vec3(0.01f, 0.02f, -1)}, hit)) continue;
    SurfacePoint point;
    accel.interpolate(hit, point);
    for (const float v : {hit.t, hit.u, hit.v, point.p.x, point.p.y, point.p.z, point.offset,
                          static_cast<float>(point.user)})
      seen.push_back(v);
  }
  return seen;
}

/// Updates an accel from frame to frame and compares each with a new one. least_apart: see
/// Accel::keep_apart(), of the updated one.
void expect_updates_equal_new_accels(std::size_t least_apart) {
  Random random(7);
  const Mat4 a = random.placement(1, 0.2f, false), b = random.placement(1, 0.2f, true);
  // Lists of instances by mesh and position: single, several, moved and none per mesh.
  using Frame = std::vector<std::pair<int, Mat4>>;
  const Frame frames[] = {{{0, a}, {1, b}},         {{0, a}, {1, b}}, {{0, b}, {1, b}},
                          {{0, b}, {0, a}, {1, b}}, {{0, a}, {1, b}}, {{1, a}},
                          {{1, a}, {1, b}},         {{1, b}}};
  const auto make = [](int mesh) { return mesh == 0 ? unit_triangle() : ball(8); };
  Accel accel;
  accel.keep_apart(least_apart);
  std::vector<std::pair<int, MeshId>> kept;
  int made = 0;
  for (const Frame& frame : frames) {
    accel.begin_again();
    Accel anew;
    std::vector<std::pair<int, MeshId>> known, meshes;
    for (const auto& [mesh, place] : frame) {
      const auto is_it = [mesh = mesh](const auto& m) { return m.first == mesh; };
      if (std::none_of(known.begin(), known.end(), is_it)) {
        const auto old = std::find_if(kept.begin(), kept.end(), is_it);
        known.emplace_back(mesh, old == kept.end() ? accel.add_mesh(make(mesh)) : old->second);
        meshes.emplace_back(mesh, anew.add_mesh(make(mesh)));
      }
      const auto id = [&](const auto& of) {
        return std::find_if(of.begin(), of.end(), is_it)->second;
      };
      accel.add_instance(instance_of(id(known), place, mesh));
      anew.add_instance(instance_of(id(meshes), place, mesh));
    }
    accel.commit([&](MeshId id) {
      ++made;
      return make(std::find_if(known.begin(), known.end(), [&](const auto& m) {
                    return m.second == id;
                  })->first);
    });
    anew.commit();
    const std::vector<float> seen = scan(accel);
    EXPECT_FALSE(seen.empty());
    EXPECT_EQ(seen, scan(anew)) << "frame " << &frame - frames;
    EXPECT_EQ(accel.bounds().min, anew.bounds().min);
    EXPECT_EQ(accel.memory().triangles, anew.memory().triangles);
    kept = known;
  }
  // Only meshes that had a single instance and now have another one, or several.
  EXPECT_GT(made, 0);
  EXPECT_LT(made, 6);
}

TEST(NextFrame, UpdateEqualsANewAccelBitForBit) { expect_updates_equal_new_accels(SIZE_MAX); }

TEST(AccelTest, MeshesApartHaveTheSameHits) {
  expect_updates_equal_new_accels(1);
  // A moved instance, and a second one of the same mesh.
  Random random(9);
  const Mat4 a = random.placement(1, 0.2f, false), b = random.placement(1, 0.2f, true);
  Accel apart, plain;
  apart.keep_apart(2);
  for (Accel* accel : {&apart, &plain}) {
    const MeshId balls = accel->add_mesh(ball(8)), triangle = accel->add_mesh(unit_triangle());
    accel->add_instance(instance_of(balls, a, 1));
    accel->add_instance(instance_of(triangle, a, 2));
    accel->commit();
  }
  EXPECT_EQ(scan(apart), scan(plain));
  for (Accel* accel : {&apart, &plain}) {
    ASSERT_TRUE(accel->set_transform(0, b, inverse_of(b)));
    accel->set_mask(0, RayMask::All & ~RayMask::Camera);
    accel->commit();
  }
  EXPECT_FALSE(scan(apart).empty());
  EXPECT_EQ(scan(apart), scan(plain));
  Hit hit;
  for (int i = 0; i < 200; ++i) {
    const Ray ray{random.direction() * 4.0f, 0, random.direction(), 100, RayMask::Camera};
    EXPECT_EQ(apart.intersect(ray, hit), plain.intersect(ray, hit));
    EXPECT_EQ(apart.occluded(ray), plain.occluded(ray));
  }
  for (Accel* accel : {&apart, &plain}) {
    accel->add_instance(instance_of(MeshId{0}, a, 3));
    accel->commit();
  }
  EXPECT_EQ(scan(apart), scan(plain));
}

// Rays that start at a hit, away from a flat surface or outward from a convex one, hit nothing.
int self_hits(Random& random, bool instanced, float stretch, float far, int rays) {
  int bad = 0;
  for (int scene = 0; scene < 20; ++scene) {
    Accel accel;
    const bool flat = scene % 2 == 0;
    const MeshId mesh = accel.add_mesh(flat ? unit_triangle() : ball(16));
    const Mat4 place = random.placement(stretch, far, scene % 3 == 0);
    accel.add_instance(instance_of(mesh, place));
    if (instanced) accel.add_instance({mesh, place, inverse_of(place), 0, 0});
    accel.commit();
    for (int i = 0; i < rays / 20; ++i) {
      const Vec3 local =
          flat ? Vec3(random.in(0, 0.5f), random.in(0, 0.5f), 0) : random.direction() * 0.5f;
      const Vec3 target = transform_point(local, place);
      // Not too far away, so that the aim is exact.
      const Vec3 d = random.direction(), org = target - d * random.in(1, 4) * stretch;
      Hit hit;
      if (!accel.intersect({org, 0, d}, hit)) continue;
      SurfacePoint point;
      accel.interpolate(hit, point);
      Vec3 out = random.direction();
      if (i % 4 == 0) out = normalize(out - point.ng * (0.999f * dot(out, point.ng)));  // grazing
      if (!flat && dot(out, point.ng) < 0) out = -out;
      // Rounding makes the stretched ball locally concave, so only the triangle itself is tested.
      if (accel.intersect(spawn_ray(point, out, RayMask::All), hit) &&
          (stretch == 1 || hit.primitive == point.primitive)) {
        ++bad;
      }
    }
  }
  return bad;
}

TEST(AccelTest, RaysDoNotHitTheirOriginSurface) {
  flush_denormals();
  Random random(3);
  for (const bool instanced : {false, true})
    for (const float stretch : {1.0f, 10.0f, 100.0f})
      for (const float far : {0.0f, 10.0f, 1000.0f, 1e5f})
        EXPECT_EQ(self_hits(random, instanced, stretch, far, 40000), 0)
            << (instanced ? "instanced" : "baked") << " stretch " << stretch << " far " << far;
}

// Number of rays from inside a closed ball that escape; aimed exactly at edges, or anywhere.
int leaks(Accel::Edges edges, bool at_edges, int rays) {
  Accel accel(edges);
  accel.add_instance(instance_of(accel.add_mesh(ball(40)), Mat4()));
  accel.commit();
  const Mesh& mesh = accel.mesh(MeshId{0});
  Random random(4);
  int count = 0;
  for (int i = 0; i < rays; ++i) {
    const Triangle& t = mesh.triangles[i % mesh.triangles.size()];
    const float w = random.unit();
    const Vec3 on_edge = mesh.positions[t.b] * w + mesh.positions[t.a] * (1 - w);
    const Vec3 org = random.direction() * (0.9f * random.unit());
    const Vec3 d = at_edges ? on_edge - org : random.direction();
    count += accel.occluded({org, 0, d}) ? 0 : 1;
  }
  return count;
}

TEST(AccelTest, ClosedMeshesAreWatertight) {
  EXPECT_EQ(leaks(Accel::Edges::Fast, false, 500000), 0);
  EXPECT_EQ(leaks(Accel::Edges::Watertight, true, 100000), 0);
  RecordProperty("leaks_at_edges_of_100000", leaks(Accel::Edges::Fast, true, 100000));
}

TEST(AccelTest, MemoryStaysWithinTheBudgetPerTriangle) {
  Accel accel;
  Mesh mesh = ball(250);  // shared vertices, as in smooth surfaces
  mesh.textures.resize(1);
  mesh.textures[0].coordinate = mesh.normals;
  mesh.positions.shrink_to_fit();
  mesh.triangles.shrink_to_fit();
  accel.add_instance(instance_of(accel.add_mesh(std::move(mesh)), Mat4()));
  accel.commit();
  const AccelMemory memory = accel.memory();
  EXPECT_EQ(memory.triangles, 249000u);
  EXPECT_LE(memory.bytes_per_triangle(), 120);
  EXPECT_GE(memory.bytes_per_triangle(), 40) << "Embree's part is counted";
}

}  // namespace accel_test
}  // namespace oriel::geom
