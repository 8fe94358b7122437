// SPDX-License-Identifier: Apache-2.0
// The Embree scenes of an Accel. Private to accel*.cpp.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geom/accel.h"
#include "geom/motion.h"
#include "geom/usable_instance.h"

namespace oriel::geom {

/// Geometry ids in the scene of an instanced mesh; triangles have id 0.
inline constexpr std::uint32_t kLines = 1, kBeziers = 2;

inline bool count_memory(void* total, ssize_t bytes, bool /*after*/) {
  static_cast<std::atomic<std::int64_t>*>(total)->fetch_add(bytes, std::memory_order_relaxed);
  return true;
}

inline void set_transform_of(RTCGeometry geometry, const Mat4& m, unsigned step = 0) {
  // Embree's matrices are column-major, ours row-major.
  const float columns[12] = {m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2],
                             m[2][0], m[2][1], m[2][2], m[3][0], m[3][1], m[3][2]};
  rtcSetGeometryTransform(geometry, step, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
}

inline void set_path_of(RTCGeometry geometry, const InstanceDesc& desc) {
  const auto steps = static_cast<unsigned>(desc.path.size());
  rtcSetGeometryTimeStepCount(geometry, std::max(1u, steps));
  if (steps == 0) set_transform_of(geometry, desc.local_to_world);
  for (unsigned step = 0; step < steps; ++step) set_transform_of(geometry, desc.path[step], step);
}

struct Accel::Impl {
  struct MeshEntry {
    Mesh mesh;
    RTCScene scene = nullptr;     // used once the mesh has several instances
    std::uint32_t uses = 0;       // number of usable instances
    std::uint32_t baked = kNone;  // the instance in whose world space the mesh is stored
    // The mesh was in the world space of an instance of the previous frame, with these matrices.
    bool was_baked = false;
    bool apart = false;  // `scene` contains the baked mesh, see keep_apart()
    Mat4 place, back;
  };

  std::atomic<std::int64_t> embree_bytes{0};
  Edges edges;
  std::size_t least_apart = SIZE_MAX;
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  std::vector<MeshEntry> meshes;
  std::vector<InstanceDesc> instances;
  std::vector<bool> attached;          // per instance: attached to the Embree scene
  std::vector<std::uint32_t> pending;  // instances to attach at the next commit
  // Of the previous frame, from begin_again() to commit():
  bool again = false, meshes_added = false;
  std::vector<InstanceDesc> before;
  std::vector<bool> before_attached;

  explicit Impl(Edges asked) : edges(asked) {
    // One instruction set on every processor, because wider ones round differently. They are no
    // faster for single rays.
    device = rtcNewDevice("max_isa=avx2");
    if (!device) throw std::runtime_error("Embree failed to initialise on this processor");
    rtcSetDeviceMemoryMonitorFunction(device, count_memory, &embree_bytes);
    top = new_scene();
  }
  ~Impl() {
    for (const MeshEntry& entry : meshes)
      if (entry.scene) rtcReleaseScene(entry.scene);
    rtcReleaseScene(top);
    rtcReleaseDevice(device);
  }

  RTCScene new_scene() const {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    // Robust traversal divides; fast traversal multiplies by an estimated reciprocal.
    rtcSetSceneFlags(scene, edges == Edges::Watertight
                                ? RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION
                                : RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    return scene;
  }

  void check() const {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error("Embree reports error " + std::to_string(error));
  }

  MeshEntry& mesh_of(std::uint32_t instance) {
    return meshes[static_cast<std::uint32_t>(instances[instance].mesh)];
  }
  const MeshEntry& mesh_of(std::uint32_t instance) const {
    return meshes[static_cast<std::uint32_t>(instances[instance].mesh)];
  }

  /// Index of the first piece of that curve geometry among the primitives of an instance.
  std::uint32_t first_piece(std::uint32_t instance, std::uint32_t geometry) const {
    const Mesh& mesh = mesh_of(instance).mesh;
    const std::size_t lines = geometry == kBeziers ? mesh.curves.lines.size() : 0;
    return static_cast<std::uint32_t>(mesh.triangles.size() + lines);
  }

  /// Puts a new geometry into a scene, which owns it then.
  static void attach(RTCScene scene, RTCGeometry geometry, std::uint32_t id, std::uint32_t mask) {
    rtcSetGeometryMask(geometry, mask);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
  }

  void attach_triangles(RTCScene scene, Mesh& mesh, std::uint32_t id, std::uint32_t mask) const {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto steps = static_cast<unsigned>(mesh.keys.size());
    if (steps > 0) rtcSetGeometryTimeStepCount(geometry, steps);
    for (unsigned step = 0; step < std::max(1u, steps); ++step)
      rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3,
                                 (steps > 0 ? mesh.keys[step] : mesh.positions).data(), 0,
                                 sizeof(Vec3), mesh.vertex_count());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh.triangles.data(), 0, sizeof(Triangle), mesh.triangles.size());
    attach(scene, geometry, id, mask);
  }

  void attach_curves(RTCScene scene, const Mesh& mesh) const {
    const Curves& curves = mesh.curves;
    const auto attach_pieces = [&](RTCGeometryType type, const std::vector<std::uint32_t>& pieces,
                                   std::uint32_t id) {
      if (pieces.empty()) return;
      RTCGeometry geometry = rtcNewGeometry(device, type);
      const auto steps = static_cast<unsigned>(curves.keys.size());
      if (steps > 0) rtcSetGeometryTimeStepCount(geometry, steps);
      for (unsigned step = 0; step < std::max(1u, steps); ++step)
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT4,
                                   (steps > 0 ? curves.keys[step] : curves.points).data(), 0,
                                   sizeof(Curves::Point), curves.points.size());
      rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, pieces.data(),
                                 0, sizeof(std::uint32_t), pieces.size());
      if (type == RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE) {
        // Pieces that continue in a neighbour have no caps at that end.
        auto* flags = static_cast<unsigned char*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, 1, pieces.size()));
        for (std::size_t i = 0; flags && i < pieces.size(); ++i) {
          const bool left = i > 0 && pieces[i - 1] + 1 == pieces[i];
          const bool right = i + 1 < pieces.size() && pieces[i] + 1 == pieces[i + 1];
          flags[i] = static_cast<unsigned char>((left ? RTC_CURVE_FLAG_NEIGHBOR_LEFT : 0) |
                                                (right ? RTC_CURVE_FLAG_NEIGHBOR_RIGHT : 0));
        }
      }
      attach(scene, geometry, id, RayMask::All);
    };
    attach_pieces(RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE, curves.lines, kLines);
    attach_pieces(RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE, curves.beziers, kBeziers);
  }

  void attach_instance(std::uint32_t i, const InstanceDesc& placed) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, mesh_of(i).scene);
    set_path_of(geometry, placed);
    attach(top, geometry, i, instances[i].mask);
  }

  void bake(std::uint32_t i, const Remake& remake) {
    MeshEntry& entry = mesh_of(i);
    const bool is_same = entry.was_baked && entry.place == instances[i].local_to_world &&
                         entry.back == instances[i].world_to_local;
    if (!is_same) {
      to_object_space(entry, remake);
      transform_mesh(entry.mesh, instances[i].local_to_world, instances[i].world_to_local);
    }
    entry.was_baked = false;
    entry.baked = i;
    const bool apart = entry.mesh.triangles.size() >= least_apart;
    if (!apart || !is_same || !entry.apart) release_scene(entry);
    if (!apart) return attach_triangles(top, entry.mesh, i, instances[i].mask);
    if (!entry.scene) {
      entry.scene = new_scene();
      attach_triangles(entry.scene, entry.mesh, 0, RayMask::All);
      rtcCommitScene(entry.scene);
      entry.apart = true;
    }
    attach_instance(i, InstanceDesc());  // in place: without transform
  }

  static void release_scene(MeshEntry& entry) {
    if (entry.scene) rtcReleaseScene(std::exchange(entry.scene, nullptr));
    entry.apart = false;
  }

  void to_object_space(MeshEntry& entry, const Remake& remake) {
    if (!std::exchange(entry.was_baked, false)) return;
    release_scene(entry);
    if (remake)
      entry.mesh = remake(static_cast<MeshId>(&entry - meshes.data()));
    else
      transform_mesh(entry.mesh, entry.back, entry.place);
  }

  // accel_rays.cpp
  /// A hit that Embree reports, without its distance.
  Hit hit_of(const RTCHit& found, const Ray& ray) const;
  /// Replaces the hit position of Embree, which is based on a reciprocal estimate that differs
  /// between processors.
  void refine(const Ray& ray, Hit& hit) const;
  bool occluded(RTCIntersectContext& context, const Ray& ray) const;

  // Moves a baked mesh back to object space when it gets a second instance.
  void unbake(MeshEntry& entry) {
    const std::uint32_t i = entry.baked;
    rtcDetachGeometry(top, i);
    transform_mesh(entry.mesh, instances[i].world_to_local, instances[i].local_to_world);
    entry.baked = kNone;
    release_scene(entry);
    build_scene_of(entry);
    attach_instance(i, instances[i]);
  }

  void build_scene_of(MeshEntry& entry) {
    entry.scene = new_scene();
    if (!entry.mesh.triangles.empty()) attach_triangles(entry.scene, entry.mesh, 0, RayMask::All);
    attach_curves(entry.scene, entry.mesh);
    rtcCommitScene(entry.scene);
  }

  // Returns true if the world is identical to the previous one, so that all built structures can be
  // reused.
  bool take_over() {
    if (!std::exchange(again, false)) return false;
    if (!meshes_added && instances == before) {
      attached = std::move(before_attached);
      pending.clear();
      return true;
    }
    for (MeshEntry& entry : meshes) {
      entry.uses = 0;
      if (entry.baked == kNone) continue;
      const InstanceDesc& desc = before[std::exchange(entry.baked, kNone)];
      entry.was_baked = true;
      entry.place = desc.local_to_world;
      entry.back = desc.world_to_local;
    }
    rtcReleaseScene(top);
    top = new_scene();
    return false;
  }

  void forget_unused() {
    for (MeshEntry& entry : meshes) {
      if (entry.uses > 0) continue;
      if (entry.scene) rtcReleaseScene(entry.scene);
      entry = {};
    }
  }

  void attach_pending(const Remake& remake) {
    std::sort(pending.begin(), pending.end());
    pending.erase(std::unique(pending.begin(), pending.end()), pending.end());
    std::erase_if(pending, [this](std::uint32_t i) {
      return attached[i] || mesh_of(i).mesh.empty() || !is_usable(instances[i]);
    });
    for (const std::uint32_t i : pending) ++mesh_of(i).uses;
    for (const std::uint32_t i : pending) {
      attached[i] = true;
      MeshEntry& entry = mesh_of(i);
      // Curves need an instance, since a baked matrix could deform their round cross-sections.
      if (entry.uses == 1 && entry.mesh.curves.empty() && instances[i].path.empty()) {
        bake(i, remake);
        continue;
      }
      if (entry.baked != kNone) unbake(entry);
      to_object_space(entry, remake);
      if (!entry.scene) build_scene_of(entry);
      attach_instance(i, instances[i]);
    }
    pending.clear();
  }
};

}  // namespace oriel::geom
