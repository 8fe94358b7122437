// SPDX-License-Identifier: Apache-2.0
#include "lights/open_sides.h"

#include <algorithm>
#include <optional>

#include "base/frame.h"
#include "base/parallel.h"
#include "runtime/fill_point.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"

namespace oriel {
namespace {

constexpr std::uint32_t kRays = 16;
/// Transparent surfaces that a ray passes, at most.
constexpr int kMaxPassed = 8;

struct Place {
  geom::SurfacePoint surface;
  bool emits;
};

/// The first surface that does not transmit light, on a cosine-distributed ray from a surface.
std::optional<Place> next_place(const World& world, const std::vector<EmissionKind>& emission,
                                const geom::SurfacePoint& from, const Vec3& normal, Vec2 u) {
  geom::Ray ray;
  ray.dir = Frame(normal).to_world(sampling::sample_cosine_hemisphere(u));
  ray.org = from.ray_origin(ray.dir);
  ray.mask = geom::RayMask::FinalGather;
  ray.time = world.shutter.middle();
  for (int i = 0; i < kMaxPassed; ++i) {
    geom::Hit hit;
    if (!world.accel->intersect(ray, hit)) return std::nullopt;
    Place place;
    world.accel->interpolate(hit, place.surface);
    const Material& material = material_of(world, hit);
    const auto index = static_cast<std::size_t>(&material - world.materials.data());
    place.emits = emission[index] == EmissionKind::Source;
    if (place.emits || !material.may_transmit) return place;
    ray.org = place.surface.ray_origin(ray.dir);
  }
  return std::nullopt;
}

}  // namespace

OpenSides::OpenSides(const World& world, std::uint32_t instance,
                     const std::vector<EmissionKind>& emission, std::size_t groups)
    : triangles_(world.accel->mesh(world.accel->instance(instance).mesh).triangles.size()),
      shares_(std::clamp<std::size_t>(groups, 1, triangles_)) {
  const auto is_open = [&](const geom::SurfacePoint& from, const Vec3& normal,
                           sampling::Sampler& sampler) {
    const auto lit = next_place(world, emission, from, normal, sampler.next_2d());
    if (!lit) return true;
    const geom::SurfacePoint& s = lit->surface;
    const Vec3 seen = dot(s.ng, from.p - s.p) < 0 ? -s.ng : s.ng;
    const auto back = next_place(world, emission, s, seen, sampler.next_2d());
    return !back || !back->emits;
  };
  parallel_for(shares_.size(), [&](std::size_t g) {
    // The triangles t with t * groups / triangles = g.
    const std::size_t begin = (g * triangles_ + shares_.size() - 1) / shares_.size(),
                      end = ((g + 1) * triangles_ + shares_.size() - 1) / shares_.size();
    for (std::uint32_t k = 0; k < kRays; ++k) {
      sampling::Sampler sampler(static_cast<int>(g), static_cast<int>(instance), k);
      geom::Hit hit;
      hit.instance = instance;
      hit.primitive = static_cast<std::uint32_t>(begin + k * (end - begin) / kRays);
      const Vec2 weights = sampling::sample_triangle(sampler.next_2d());
      hit.u = weights.x, hit.v = weights.y;
      hit.time = world.shutter.middle();
      geom::SurfacePoint from;
      world.accel->interpolate(hit, from);
      shares_[g].front += is_open(from, from.ng, sampler) ? 1.0f / kRays : 0;
      shares_[g].back += is_open(from, -from.ng, sampler) ? 1.0f / kRays : 0;
    }
  });
}

}  // namespace oriel
