// SPDX-License-Identifier: Apache-2.0
// What Accel costs over bare Embree: the same rays through both, in one run.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <map>
#include <memory>
#include <random>

#include "base/frame.h"
#include "base/parallel.h"
#include "geom/accel.h"

namespace {

using namespace oriel;
using namespace oriel::geom;

void add_quad(Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void add_box(Mesh& mesh, const Vec3& low, const Vec3& high) {
  const auto corner = [&](int i) {
    return Vec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  };
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
        std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}})
    add_quad(mesh, corner(a), corner(b), corner(c), corner(d));
}

// A room of 6 x 3 x 5 with 28 boxes in it: 348 triangles.
Mesh small_room() {
  Mesh mesh;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  add_box(mesh, Vec3(0), Vec3(6, 3, 5));
  for (int i = 0; i < 28; ++i) {
    const Vec3 low(0.2f + 5.2f * unit(random), 1.5f * unit(random), 0.2f + 3.0f * unit(random));
    add_box(mesh, low, low + Vec3(0.6f, 1.2f, 0.6f) * (0.2f + 0.8f * unit(random)));
  }
  mesh.positions.emplace_back(0.0f);
  return mesh;
}

// The same room with 54 wavy balls of 20,000 triangles: 1.08 million.
Mesh big_room() {
  Mesh mesh;
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0, 1);
  add_box(mesh, Vec3(0), Vec3(6, 3, 5));
  constexpr int kRings = 100, kColumns = 100;
  for (int ball = 0; ball < 54; ++ball) {
    const Vec3 center(0.5f + 5 * unit(random), 0.4f + 2.2f * unit(random),
                      0.5f + 3.0f * unit(random));
    const float size = 0.15f + 0.35f * unit(random);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i <= kRings; ++i)
      for (int j = 0; j < kColumns; ++j) {
        const float theta = kPi * i / kRings, phi = kTwoPi * j / kColumns;
        const float r = size * (1 + 0.05f * std::sin(20 * theta) * std::sin(20 * phi));
        mesh.positions.push_back(center + Vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                               std::sin(theta) * std::sin(phi)) *
                                              r);
      }
    const auto at = [&](int i, int j) {
      return first + static_cast<std::uint32_t>(i * kColumns + j % kColumns);
    };
    for (int i = 0; i < kRings; ++i)
      for (int j = 0; j < kColumns; ++j) {
        mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
        mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
      }
  }
  mesh.positions.emplace_back(0.0f);
  return mesh;
}

enum Scene { Small, Big };
enum Kind { Primary, Diffuse, Shadow };

// One scene in both structures, with rays of each kind made from real hits.
struct World {
  Accel accel;
  RTCDevice device = nullptr;
  RTCScene bare = nullptr;
  std::vector<Ray> rays[3];

  explicit World(Scene which) {
    flush_denormals();
    const MeshId id = accel.add_mesh(which == Small ? small_room() : big_room());
    accel.add_instance({id, Mat4(), Mat4(), RayMask::All, 0});
    accel.commit();
    build_bare(accel.mesh(id));
    make_rays();
  }

  void build_bare(const Mesh& mesh) {
    device = rtcNewDevice(nullptr);
    bare = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               mesh.positions.data(), 0, sizeof(Vec3), mesh.vertex_count());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh.triangles.data(), 0, sizeof(Triangle), mesh.triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(bare, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(bare);
  }

  void make_rays() {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    constexpr int kTile = 16, kWidth = 640, kHeight = 480;
    for (int tile = 0; tile < kWidth * kHeight / (kTile * kTile); ++tile)
      for (int i = 0; i < kTile * kTile; ++i) {
        const int x = tile % (kWidth / kTile) * kTile + i % kTile;
        const int y = tile / (kWidth / kTile) * kTile + i / kTile;
        const Vec3 d((x + unit(random)) / kWidth - 0.5f,
                     ((y + unit(random)) / kHeight - 0.5f) * kHeight / kWidth, -0.5f);
        const Ray primary{Vec3(3, 1.5f, 4.9f), 0, d};
        rays[Primary].push_back(primary);
        Hit hit;
        if (!accel.intersect(primary, hit)) continue;
        SurfacePoint point;
        accel.interpolate(hit, point);
        if (dot(point.ng, d) > 0) point.ng = -point.ng;
        const float r2 = unit(random), phi = kTwoPi * unit(random), r = std::sqrt(r2);
        const Vec3 cosine(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r2));
        rays[Diffuse].push_back(spawn_ray(point, Frame(point.ng).to_world(cosine), RayMask::All));
        const Vec3 lamp(2.5f + unit(random), 2.95f, 2 + unit(random));
        rays[Shadow].push_back(spawn_ray_to(point, lamp, RayMask::All));
      }
  }
};

World& world(Scene which) {
  static std::map<Scene, std::unique_ptr<World>> worlds;
  std::unique_ptr<World>& entry = worlds[which];
  if (!entry) entry = std::make_unique<World>(which);
  return *entry;
}

RTCRay bare_ray(const Ray& ray) {
  return RTCRay{ray.org.x, ray.org.y, ray.org.z, ray.tnear, ray.dir.x, ray.dir.y,
                ray.dir.z, ray.time,  ray.tfar,  ray.mask,  0,         0};
}

void through_accel(benchmark::State& state, Scene which, Kind kind) {
  const World& w = world(which);
  flush_denormals();
  std::size_t hits = 0;
  for (auto _ : state)
    for (const Ray& ray : w.rays[kind]) {
      Hit hit;
      hits += kind == Shadow ? w.accel.occluded(ray) : w.accel.intersect(ray, hit);
      benchmark::DoNotOptimize(hit);
    }
  benchmark::DoNotOptimize(hits);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(w.rays[kind].size()));
  state.counters["bytes/triangle"] = w.accel.memory().bytes_per_triangle();
}

void through_embree(benchmark::State& state, Scene which, Kind kind) {
  const World& w = world(which);
  flush_denormals();
  for (auto _ : state)
    for (const Ray& ray : w.rays[kind]) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      RTCRayHit query;
      query.ray = bare_ray(ray);
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      if (kind == Shadow)
        rtcOccluded1(w.bare, &context, &query.ray);
      else
        rtcIntersect1(w.bare, &context, &query);
      benchmark::DoNotOptimize(query);
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(w.rays[kind].size()));
}

void interpolation(benchmark::State& state, Scene which) {
  const World& w = world(which);
  flush_denormals();
  std::vector<Hit> hits;
  for (const Ray& ray : w.rays[Primary])
    if (Hit hit; w.accel.intersect(ray, hit)) hits.push_back(hit);
  SurfacePoint point;
  for (auto _ : state)
    for (const Hit& hit : hits) {
      w.accel.interpolate(hit, point);
      benchmark::DoNotOptimize(point);
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(hits.size()));
}

#define ORIEL_RAY_BENCH(scene, kind)                           \
  BENCHMARK_CAPTURE(through_embree, scene##kind, scene, kind); \
  BENCHMARK_CAPTURE(through_accel, scene##kind, scene, kind)

ORIEL_RAY_BENCH(Small, Primary);
ORIEL_RAY_BENCH(Small, Diffuse);
ORIEL_RAY_BENCH(Small, Shadow);
ORIEL_RAY_BENCH(Big, Primary);
ORIEL_RAY_BENCH(Big, Diffuse);
ORIEL_RAY_BENCH(Big, Shadow);
BENCHMARK_CAPTURE(interpolation, Small, Small);
BENCHMARK_CAPTURE(interpolation, Big, Big);

}  // namespace

BENCHMARK_MAIN();
