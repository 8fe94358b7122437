// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/sharp_caustics.h"

#include <ImathBoxAlgo.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "geom/accel.h"
#include "lights/sample_light.h"
#include "transport/lobes.h"
#include "transport/surface.h"

namespace oriel {
namespace {

/// Weight of a mirror or glass lobe from which on an instance casts caustics. Varnish and polished
/// stone are below it: their caustics are weak, and with them everything in a room would cast some.
constexpr float kLeastWeight = 0.1f;
/// Cosine of the view for which lobes are evaluated.
constexpr float kCosine = 0.7f;
/// Places of an instance at which its surface is evaluated.
constexpr std::size_t kPlaces = 16;
/// A light is small if its area covers less than this share of the directions at a quarter of the
/// scene's diagonal.
constexpr float kSmallShare = 0.01f;

bool is_small(const Light& light, float scene_diagonal) {
  const float distance = scene_diagonal / 4;
  return light.area < kSmallShare * 4 * kPi * distance * distance;
}

/// Whether rays that leave mirrors can hit the light.
bool is_met_by_mirrors(const Light& light) { return has_extent(light.shape) && light.visible; }

bool is_one_of(const Light& light, CausticLights which, bool caustic_on, float scene_diagonal) {
  if (light.portal || light.photons.none || !gives_direct_light(light)) return false;
  const bool found = is_met_by_mirrors(light) && !(caustic_on && is_small(light, scene_diagonal));
  return found == (which == CausticLights::Found);
}

/// The middle of a triangle, seen at a slant from its front; false for a triangle without area.
bool look_at(const World& world, std::uint32_t instance, std::uint32_t primitive, geom::Ray& ray,
             geom::Hit& hit) {
  const geom::InstanceDesc& desc = world.accel->instance(instance);
  const geom::Mesh& mesh = world.accel->mesh(desc.mesh);
  const geom::Triangle& triangle = mesh.triangles[primitive];
  Mat4 to_world, to_object;
  world.accel->placement_at(instance, 0, to_world, to_object);
  Vec3 corners[3];
  int k = 0;
  for (const std::uint32_t vertex : {triangle.a, triangle.b, triangle.c}) {
    corners[k] = mesh.positions[vertex];
    if (!world.accel->is_baked(desc.mesh)) to_world.multVecMatrix(corners[k], corners[k]);
    ++k;
  }
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const float area = length(normal);
  if (!(area > 0)) return false;
  const Vec3 view =
      Frame(normal / area).to_world(Vec3(std::sqrt(1 - kCosine * kCosine), 0, kCosine));
  hit.instance = instance;
  hit.primitive = primitive;
  hit.u = hit.v = 1.0f / 3;
  hit.ng = normal;
  hit.t = std::sqrt(area);
  ray.org = (corners[0] + corners[1] + corners[2]) / 3 + view * hit.t;
  ray.dir = -view;
  ray.mask = geom::RayMask::FinalGather;
  return true;
}

bool is_mirror_or_glass(const World& world, std::uint32_t instance, std::uint32_t primitive) {
  geom::Ray ray;
  geom::Hit hit;
  if (!look_at(world, instance, primitive, ray, hit)) return false;
  const Material& material = material_of(world, hit);
  if (!material.photon.empty()) return false;
  ShadingPoint point;
  fill_point(world, ray, hit, {}, RayKind::PhotonLight, point);
  Closure closure;
  shade_for_photons(material, point, closure);
  float weight = 0;
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    if (is_delta(lobe.kind) && !lobe.controls.highlights_only)
      weight += max_component(lobe.weight) * closure.opacity;
  }
  return weight >= kLeastWeight;
}

bool casts_caustics(const World& world, std::uint32_t instance) {
  const unsigned flags = photon_bits(world.instances[instance].visibility, true);
  constexpr unsigned kNeeded = kMeetsCaustics | kCastsCaustics;
  if ((flags & kNeeded) != kNeeded) return false;
  const geom::InstanceDesc& desc = world.accel->instance(instance);
  if (!(desc.mask & geom::RayMask::FinalGather)) return false;
  const std::size_t count = world.accel->mesh(desc.mesh).triangles.size();
  const std::size_t places = std::min(count, kPlaces);
  for (std::size_t i = 0; i < places; ++i)
    if (is_mirror_or_glass(world, instance,
                           static_cast<std::uint32_t>((2 * i + 1) * count / (2 * places))))
      return true;
  return false;
}

SharpCaustics::Sphere bounding_sphere(const geom::Accel& accel, std::uint32_t instance) {
  const geom::InstanceDesc& desc = accel.instance(instance);
  const geom::Mesh& mesh = accel.mesh(desc.mesh);
  geom::Box3 local = mesh.bounds();
  for (const auto& key : mesh.keys)
    for (std::size_t i = 0; i + 1 < key.size(); ++i) local.extendBy(key[i]);
  if (accel.is_baked(desc.mesh)) return {local.center(), length(local.size()) / 2};
  geom::Box3 box;
  constexpr int kTimes = 8;
  for (int i = 0; i <= kTimes; ++i) {
    Mat4 to_world, to_object;
    accel.placement_at(instance, static_cast<float>(i) / kTimes, to_world, to_object);
    box.extendBy(Imath::transform(local, to_world));
  }
  return {box.center(), length(box.size()) / 2};
}

}  // namespace

SharpCaustics::SharpCaustics(const World& world, CausticLights which)
    : lights_(world.lights.size(), 0), casters_(world.instances.size(), 0) {
  const float diagonal = length(world.accel->bounds().size());
  for (std::size_t i = 0; i < lights_.size(); ++i)
    if (is_one_of(world.lights[i], which, world.options.caustic.on, diagonal))
      lights_[i] = 1, ++light_count_;
  if (light_count_ == 0) return;
  parallel_for(world.accel->instance_count(), [&](std::size_t i) {
    casters_[i] = casts_caustics(world, static_cast<std::uint32_t>(i)) ? 1 : 0;
  });
  for (std::uint32_t i = 0; i < world.accel->instance_count(); ++i)
    if (casters_[i] != 0) spheres_.push_back(bounding_sphere(*world.accel, i));
}

}  // namespace oriel
