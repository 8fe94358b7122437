// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/photon_edges.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "runtime/fill_point.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"

namespace oriel {
namespace {

/// Points of a disc.
constexpr std::uint32_t kSamples = 32;
/// The least share; below it a photon lies on a surface smaller than its disc in both directions,
/// and the points tell little.
constexpr float kLeastShare = 0.03f;
constexpr std::uint32_t kMask = geom::RayMask::FinalGather;

/// Whether a surface that faces like `normal` lies within `depth` below or above a point.
bool has_surface(const World& world, const Vec3& at, const Vec3& normal, float depth) {
  geom::Ray ray;
  ray.org = at + normal * depth;
  ray.dir = -normal;
  ray.tfar = 2 * depth;
  ray.mask = kMask;
  geom::Hit hit;
  if (!world.accel->intersect(ray, hit)) return false;
  geom::SurfacePoint surface;
  world.accel->interpolate(hit, surface);
  return std::abs(dot(surface.ng, normal)) >= PhotonMap::kMinAgreement;
}

struct Disc {
  float share = 1;  ///< on surfaces that the photon may light
  bool near_wall = false;
};

Disc disc_of(const World& world, const Photon& photon, float radius, std::uint32_t i) {
  const Frame frame(photon.normal);
  const Vec3 above = photon.position + photon.normal * (kWayHeight * radius);
  const float depth = radius / PhotonMap::kFlattening;
  std::uint32_t found = 0;
  Disc disc;
  for (std::uint32_t k = 0; k < kSamples; ++k) {
    const Vec2 d = sampling::sample_disc(
        sampling::Sampler(static_cast<int>(i & 0xffff), static_cast<int>(i >> 16), k).next_2d());
    const Vec3 aside = (frame.s * d.x + frame.t * d.y) * radius;
    const bool walled_off = is_walled_off(world, above, above + aside);
    disc.near_wall |= walled_off;
    found += !walled_off && has_surface(world, photon.position + aside, photon.normal, depth);
  }
  disc.share = static_cast<float>(found) / kSamples;
  return disc;
}

}  // namespace

bool is_walled_off(const World& world, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const float distance = length(way);
  if (!(distance > 0)) return false;
  geom::Ray ray;
  ray.org = from;
  ray.dir = way * (1 / distance);
  ray.tfar = distance;
  ray.mask = kMask;
  geom::Hit hit;
  return world.accel->intersect(ray, hit) && !material_of(world, hit).may_transmit;
}

void keep_light_at_edges(PhotonMap& map, const World& world, const PhotonLookup& lookup) {
  std::vector<float> factors(map.size());
  std::vector<std::uint8_t> near_wall(map.size());
  constexpr std::size_t kAtOnce = 256;
  parallel_for_blocks(map.size(), kAtOnce, [&](std::size_t i) {
    const Photon& photon = map.photons()[i];
    const float radius = map.radius(photon.position, photon.normal, lookup);
    const Disc disc =
        radius > 0 ? disc_of(world, photon, radius, static_cast<std::uint32_t>(i)) : Disc{};
    factors[i] = 1 / std::max(disc.share, kLeastShare);
    near_wall[i] = disc.near_wall;
  });
  for (std::size_t i = 0; i < factors.size(); ++i) map.scale_power(i, factors[i]);
  map.mark_walls(std::move(near_wall));
}

}  // namespace oriel
