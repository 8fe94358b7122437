// SPDX-License-Identifier: Apache-2.0
#include "transport/occlusion.h"

#include <cmath>
#include <limits>

#include "sampling/warp.h"
#include "transport/surface.h"

namespace oriel {
namespace {

/// Holes on one ray before the rest counts as free.
constexpr int kMostHoles = 64;

/// Distance to the first surface that is there; infinite when there is none within reach. A cut-out
/// is there by chance, as often as it is opaque.
float way_to_surface(const World& world, const ShadingPoint& from, const Vec3& direction,
                     float reach, sampling::Sampler& stream, RayCounts& counts) {
  geom::Ray ray = leave(from, direction, reach, geom::RayMask::Probe);
  float passed = 0;
  for (int i = 0; i < kMostHoles; ++i) {
    geom::Hit hit;
    ++counts.probe;
    if (!world.accel->intersect(ray, hit)) break;
    const Material& material = material_of(world, hit);
    if (!material.may_have_holes) return passed + hit.t;
    ShadingPoint point;
    fill_point(world, ray, hit, {}, RayKind::Probe, point);
    Closure closure;
    shade(material, point, closure);
    if (stream.next_1d() < closure.opacity) return passed + hit.t;
    passed += hit.t;
    ray = leave(point, direction, reach - passed, geom::RayMask::Probe);
  }
  return std::numeric_limits<float>::infinity();
}

}  // namespace

float free_share(const World& world, const ShadingPoint& point, const Vec3& normal, float distance,
                 int samples, sampling::Sampler& sampler, RayCounts& counts) {
  /// Tells these streams from those of lobes, which number from 0.
  constexpr std::uint32_t kBranch = 1000;
  const Frame frame(normal);
  const float reach = distance > 0 ? distance : std::numeric_limits<float>::infinity();
  float free = 0;
  for (int i = 0; i < samples; ++i) {
    auto stream =
        sampler.split(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(samples), kBranch);
    const Vec3 w = frame.to_world(sampling::sample_cosine_hemisphere(stream.next_2d()));
    // Below the flat triangle there is nothing but the surface itself.
    if (dot(w, point.geometric_normal) <= 0) continue;
    const float met = way_to_surface(world, point, w, reach, stream, counts);
    free += std::isinf(met) ? 1.0f : distance > 0 ? met / distance : 0.0f;
  }
  return free / static_cast<float>(samples);
}

}  // namespace oriel
