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

RTCRay embree_ray(const Ray& ray) {
  RTCRay r;
  r.org_x = ray.org.x;
  r.org_y = ray.org.y;
  r.org_z = ray.org.z;
  r.tnear = behind(ray.tnear);
  r.dir_x = ray.dir.x;
  r.dir_y = ray.dir.y;
  r.dir_z = ray.dir.z;
  r.time = ray.time;
  r.tfar = ray.tfar;
  r.mask = ray.mask;
  r.flags = 0;
  return r;
}

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
  RTCRay query = embree_ray(ray);
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
    if (!context.test.blocks(hit)) args->valid[0] = 0;
  }
};

bool Accel::intersect(const Ray& ray, Hit& hit) const {
  NearestContext context;
  rtcInitIntersectContext(&context.embree);
  if (impl_->edges == Edges::Watertight) context.embree.filter = keep_nearest;
  RTCRayHit query;
  query.ray = embree_ray(ray);
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

void Accel::refine(const Ray& ray, Hit& hit) const { impl_->refine(ray, hit); }

}  // namespace oriel::geom
