// SPDX-License-Identifier: Apache-2.0
#include "geom/accel.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/assert.h"
#include "geom/motion.h"
#include "geom/nearest_hit.h"
#include "geom/refine_hit.h"
#include "geom/usable_instance.h"

namespace oriel::geom {
namespace {

/// Geometry ids in the scene of an instanced mesh; triangles have id 0.
constexpr std::uint32_t kLines = 1, kBeziers = 2;

/// The smallest tnear above the given one. Embree's robust mode also reports hits at tnear itself,
/// which would be the surface that the ray starts on.
float behind(float tnear) { return tnear + std::numeric_limits<float>::min(); }

bool count_memory(void* total, ssize_t bytes, bool /*after*/) {
  static_cast<std::atomic<std::int64_t>*>(total)->fetch_add(bytes, std::memory_order_relaxed);
  return true;
}

void set_transform_of(RTCGeometry geometry, const Mat4& m, unsigned step = 0) {
  // Embree's matrices are column-major, ours row-major.
  const float columns[12] = {m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2],
                             m[2][0], m[2][1], m[2][2], m[3][0], m[3][1], m[3][2]};
  rtcSetGeometryTransform(geometry, step, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
}

void set_path_of(RTCGeometry geometry, const InstanceDesc& desc) {
  const auto steps = static_cast<unsigned>(desc.path.size());
  rtcSetGeometryTimeStepCount(geometry, std::max(1u, steps));
  if (steps == 0) set_transform_of(geometry, desc.local_to_world);
  for (unsigned step = 0; step < steps; ++step) set_transform_of(geometry, desc.path[step], step);
}

}  // namespace

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
    rtcSetGeometryMask(geometry, mask);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
  }

  void attach_curves(RTCScene scene, const Mesh& mesh) const {
    const Curves& curves = mesh.curves;
    const auto attach = [&](RTCGeometryType type, const std::vector<std::uint32_t>& pieces,
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
      rtcSetGeometryMask(geometry, RayMask::All);
      rtcCommitGeometry(geometry);
      rtcAttachGeometryByID(scene, geometry, id);
      rtcReleaseGeometry(geometry);
    };
    attach(RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE, curves.lines, kLines);
    attach(RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE, curves.beziers, kBeziers);
  }

  void attach_instance(std::uint32_t i, const InstanceDesc& placed) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, mesh_of(i).scene);
    set_path_of(geometry, placed);
    rtcSetGeometryMask(geometry, instances[i].mask);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(top, geometry, i);
    rtcReleaseGeometry(geometry);
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

  /// Replaces the hit position of Embree, which is based on a reciprocal estimate that differs
  /// between processors.
  /// A hit that Embree reports, without its distance.
  Hit hit_of(const RTCHit& found, const Ray& ray) const {
    Hit hit;
    hit.u = found.u;
    hit.v = found.v;
    hit.primitive = found.primID;
    hit.ng = Vec3(found.Ng_x, found.Ng_y, found.Ng_z);
    hit.time = ray.time;
    hit.instance = found.geomID;
    if (found.instID[0] != RTC_INVALID_GEOMETRY_ID) {
      hit.instance = found.instID[0];
      if (found.geomID != 0) hit.primitive += first_piece(hit.instance, found.geomID);
    }
    return hit;
  }

  bool occluded(RTCIntersectContext& context, const Ray& ray) const {
    RTCRay query;
    query.org_x = ray.org.x;
    query.org_y = ray.org.y;
    query.org_z = ray.org.z;
    query.tnear = behind(ray.tnear);
    query.dir_x = ray.dir.x;
    query.dir_y = ray.dir.y;
    query.dir_z = ray.dir.z;
    query.time = ray.time;
    query.tfar = ray.tfar;
    query.mask = ray.mask;
    query.flags = 0;
    rtcOccluded1(top, &context, &query);
    return query.tfar < 0;
  }

  void refine(const Ray& ray, Hit& hit) const {
    const InstanceDesc& desc = instances[hit.instance];
    const MeshEntry& entry = meshes[static_cast<std::uint32_t>(desc.mesh)];
    if (entry.baked != kNone) return refine_hit(entry.mesh, ray.org, ray.dir, hit);
    const Mat4 back =
        desc.path.empty() ? desc.world_to_local : inverse_of(matrix_at(desc.path, ray.time));
    refine_hit(entry.mesh, transform_point(ray.org, back), transform_vector(ray.dir, back), hit);
    hit.ng = transform_normal(hit.ng, back);
  }

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

Accel::Accel(Edges edges) : impl_(std::make_unique<Impl>(edges)), scene_(impl_->top) {}

Accel::~Accel() = default;

void Accel::keep_apart(std::size_t least_triangles) { impl_->least_apart = least_triangles; }

MeshId Accel::add_mesh(Mesh mesh) {
  ORIEL_ASSERT(mesh.triangles.empty() || mesh.vertex_count() >= 3);
  impl_->meshes.emplace_back().mesh = std::move(mesh);
  impl_->meshes_added = true;
  return static_cast<MeshId>(impl_->meshes.size() - 1);
}

std::uint32_t Accel::add_instance(const InstanceDesc& desc) {
  ORIEL_ASSERT(static_cast<std::size_t>(desc.mesh) < impl_->meshes.size());
  impl_->instances.push_back(desc);
  impl_->attached.push_back(false);
  const auto index = static_cast<std::uint32_t>(impl_->instances.size() - 1);
  impl_->pending.push_back(index);
  return index;
}

bool Accel::set_transform(std::uint32_t instance, const Mat4& local_to_world,
                          const Mat4& world_to_local) {
  InstanceDesc desc = impl_->instances[instance];
  const Mat4 from_world = desc.world_to_local, to_world = desc.local_to_world;
  desc.local_to_world = local_to_world;
  desc.world_to_local = world_to_local;
  desc.path.clear();
  if (!is_usable(desc)) return false;
  impl_->instances[instance] = desc;
  if (!impl_->attached[instance]) {
    impl_->pending.push_back(instance);  // its previous matrix may have been singular
    return true;
  }
  Impl::MeshEntry& entry = impl_->mesh_of(instance);
  RTCGeometry geometry = rtcGetGeometry(impl_->top, instance);
  if (entry.baked == instance) {
    transform_mesh(entry.mesh, from_world * local_to_world, world_to_local * to_world);
    const RTCGeometry triangles = entry.apart ? rtcGetGeometry(entry.scene, 0) : geometry;
    for (unsigned step = 0; step < std::max<std::size_t>(1, entry.mesh.keys.size()); ++step)
      rtcUpdateGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, step);
    rtcUpdateGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0);
    if (entry.apart) {
      rtcCommitGeometry(triangles);
      rtcCommitScene(entry.scene);
    }
  } else {
    set_path_of(geometry, impl_->instances[instance]);
  }
  rtcCommitGeometry(geometry);
  return true;
}

void Accel::set_mask(std::uint32_t instance, std::uint32_t mask) {
  impl_->instances[instance].mask = mask;
  if (!impl_->attached[instance]) return;
  RTCGeometry geometry = rtcGetGeometry(impl_->top, instance);
  rtcSetGeometryMask(geometry, mask);
  rtcCommitGeometry(geometry);
}

void Accel::begin_again() {
  if (impl_->again) return;
  impl_->again = true;
  impl_->meshes_added = false;
  impl_->before = std::move(impl_->instances);
  impl_->before_attached = std::move(impl_->attached);
  impl_->instances.clear();
  impl_->attached.clear();
  impl_->pending.clear();
}

void Accel::commit(const Remake& remake) {
  const bool again = impl_->again;
  if (!impl_->take_over()) {
    impl_->attach_pending(remake);
    if (again) impl_->forget_unused();
    rtcCommitScene(impl_->top);
    impl_->check();
    scene_ = impl_->top;
  }
  impl_->before = {};
  impl_->before_attached = {};
  instances_ = impl_->instances.data();
}

/// Passes hits of some instances to a test.
struct Accel::AskingContext {
  RTCIntersectContext embree;  // first: Embree passes its address
  const Impl& impl;
  const Ray& ray;
  std::uint32_t asked;
  BlockTest& test;

  static void ask(const RTCFilterFunctionNArguments* args) {
    const auto& context = *reinterpret_cast<const AskingContext*>(args->context);
    Hit hit = context.impl.hit_of(*reinterpret_cast<const RTCHit*>(args->hit), context.ray);
    if ((context.impl.instances[hit.instance].mask & context.asked) == 0) return;
    hit.t = reinterpret_cast<const RTCRay*>(args->ray)->tfar;
    context.impl.refine(context.ray, hit);
    if (!context.test.blocks(hit)) args->valid[0] = 0;
  }
};

bool Accel::intersect(const Ray& ray, Hit& hit) const {
  NearestContext context;
  rtcInitIntersectContext(&context.embree);
  if (impl_->edges == Edges::Watertight) context.embree.filter = keep_nearest;
  RTCRayHit query;
  query.ray.org_x = ray.org.x;
  query.ray.org_y = ray.org.y;
  query.ray.org_z = ray.org.z;
  query.ray.tnear = behind(ray.tnear);
  query.ray.dir_x = ray.dir.x;
  query.ray.dir_y = ray.dir.y;
  query.ray.dir_z = ray.dir.z;
  query.ray.time = ray.time;
  query.ray.tfar = ray.tfar;
  query.ray.mask = ray.mask;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_, &context.embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit = impl_->hit_of(query.hit, ray);
  hit.t = impl_->edges == Edges::Watertight ? context.t : query.ray.tfar;
  impl_->refine(ray, hit);
  return true;
}

bool Accel::occluded(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  return impl_->occluded(context, ray);
}

bool Accel::occluded(const Ray& ray, std::uint32_t asked, BlockTest& test) const {
  AskingContext context{{}, *impl_, ray, asked, test};
  rtcInitIntersectContext(&context.embree);
  context.embree.filter = AskingContext::ask;
  return impl_->occluded(context.embree, ray);
}

void Accel::interpolate(const Hit& hit, SurfacePoint& point) const {
  const InstanceDesc& desc = instances_[hit.instance];
  const Impl::MeshEntry& entry = impl_->meshes[static_cast<std::uint32_t>(desc.mesh)];
  if (desc.path.empty()) {
    const Placement placement =
        entry.baked == kNone ? Placement{&desc.local_to_world, &desc.world_to_local} : Placement{};
    geom::interpolate(entry.mesh, hit, placement, point);
  } else {
    const Mat4 forward = matrix_at(desc.path, hit.time), back = inverse_of(forward);
    geom::interpolate(entry.mesh, hit, {&forward, &back}, point);
    point.speed += transform_point(transform_point(point.p, back), change_at(desc.path, hit.time));
    // Allows for the rounding of the matrices that Embree interpolates between keys.
    const auto place = [](const Mat4& m) { return length(Vec3(m[3][0], m[3][1], m[3][2])); };
    point.offset = 2 * point.offset +
                   5e-7f * (place(desc.path.front()) + place(desc.path.back()) + length(point.p));
  }
  point.instance = hit.instance;
  point.user = desc.user;
}

void Accel::placement_at(std::uint32_t instance, float time, Mat4& local_to_world,
                         Mat4& world_to_local) const {
  const InstanceDesc& desc = instances_[instance];
  local_to_world = desc.path.empty() ? desc.local_to_world : matrix_at(desc.path, time);
  world_to_local = desc.path.empty() ? desc.world_to_local : inverse_of(local_to_world);
}

const Mesh& Accel::mesh(MeshId id) const {
  return impl_->meshes[static_cast<std::uint32_t>(id)].mesh;
}

bool Accel::is_baked(MeshId id) const {
  return impl_->meshes[static_cast<std::uint32_t>(id)].baked != kNone;
}

const InstanceDesc& Accel::instance(std::uint32_t index) const { return impl_->instances[index]; }

std::uint32_t Accel::instance_count() const {
  return static_cast<std::uint32_t>(impl_->instances.size());
}

Box3 Accel::bounds() const {
  RTCBounds b;
  rtcGetSceneBounds(scene_, &b);
  if (!(b.lower_x <= b.upper_x)) return Box3();
  return Box3(Vec3(b.lower_x, b.lower_y, b.lower_z), Vec3(b.upper_x, b.upper_y, b.upper_z));
}

AccelMemory Accel::memory() const {
  AccelMemory memory;
  for (const Impl::MeshEntry& entry : impl_->meshes) {
    memory.meshes += entry.mesh.bytes() + sizeof(Impl::MeshEntry) - sizeof(Mesh);
    memory.triangles += entry.mesh.triangles.size();
  }
  memory.instances = impl_->instances.capacity() * sizeof(InstanceDesc);
  for (const InstanceDesc& desc : impl_->instances)
    memory.instances += desc.path.capacity() * sizeof(Mat4);
  memory.embree = static_cast<std::size_t>(std::max<std::int64_t>(0, impl_->embree_bytes));
  return memory;
}

}  // namespace oriel::geom
