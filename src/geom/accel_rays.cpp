// SPDX-License-Identifier: Apache-2.0
// Rays of an Accel: nearest hits, and whether something blocks them.
#include <limits>

#include "geom/accel_impl.h"
#include "geom/nearest_hit.h"
#include "geom/refine_hit.h"

namespace oriel::geom {
namespace {

/// The smallest tnear above the given one. Embree's robust mode also reports hits at tnear itself,
/// which would be the surface that the ray starts on.
float behind(float tnear) { return tnear + std::numeric_limits<float>::min(); }

}  // namespace

Hit Accel::Impl::hit_of(const RTCHit& found, const Ray& ray) const {
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

void Accel::Impl::refine(const Ray& ray, Hit& hit) const {
  const InstanceDesc& desc = instances[hit.instance];
  const MeshEntry& entry = meshes[static_cast<std::uint32_t>(desc.mesh)];
  if (entry.baked != kNone) return refine_hit(entry.mesh, ray.org, ray.dir, hit);
  const Mat4 back =
      desc.path.empty() ? desc.world_to_local : inverse_of(matrix_at(desc.path, ray.time));
  refine_hit(entry.mesh, transform_point(ray.org, back), transform_vector(ray.dir, back), hit);
  hit.ng = transform_normal(hit.ng, back);
}

bool Accel::Impl::occluded(RTCIntersectContext& context, const Ray& ray) const {
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

}  // namespace oriel::geom
