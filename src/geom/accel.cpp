// SPDX-License-Identifier: Apache-2.0
#include "geom/accel.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "geom/accel_impl.h"

namespace oriel::geom {

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
