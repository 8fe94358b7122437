// SPDX-License-Identifier: Apache-2.0
#include "lights/find_openings.h"

#include <algorithm>
#include <utility>

#include "base/frame.h"
#include "base/parallel.h"
#include "lights/environment_light.h"
#include "lights/opening_plane.h"
#include "runtime/world.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"

namespace oriel {
namespace {

/// Camera rays along each side of the picture, and rays from each surface that they hit. About
/// 130,000 rays.
constexpr std::size_t kEyeRays = 32, kRaysPerPoint = 64;
/// Shares of rays that reach the environment between which openings are searched. With less, light
/// of the environment does not matter; with more, rays of lobes find it.
constexpr float kMinEscaping = 0.0005f, kMaxEscaping = 0.3f;
/// Share of the escaping rays that a rectangle explains, at least; that all of them explain, at
/// least; and at which the search ends.
constexpr float kMinGain = 0.01f, kMinExplained = 0.7f, kEnough = 0.95f;
/// Share of the rays through a rectangle that reach the environment, at least.
constexpr float kMinClear = 0.3f;

struct Start {
  Vec3 position{0}, normal{0};  ///< the normal on the side of the viewer
  float offset = 0;
  bool valid = false;
};

Start start_at(const World& world, const geom::Ray& ray, const geom::Hit& hit) {
  geom::SurfacePoint point;
  world.accel->interpolate(hit, point);
  return {point.p, dot(point.ng, ray.dir) > 0 ? -point.ng : point.ng, point.offset, true};
}

geom::Ray ray_from(const Start& start, Vec2 u) {
  geom::Ray ray;
  ray.org = start.position + start.normal * start.offset;
  ray.dir = Frame(start.normal).to_world(sampling::sample_cosine_hemisphere(u));
  ray.mask = geom::RayMask::Shadow;
  return ray;
}

/// Surfaces that the camera sees, each followed by one that a diffuse ray from it hits.
std::vector<Start> starts_of(const World& world) {
  const Camera& camera = world.camera;
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  std::vector<Start> found(kEyeRays * kEyeRays * 2);
  parallel_for(kEyeRays * kEyeRays, [&](std::size_t i) {
    const std::size_t column = i % kEyeRays, row = i / kEyeRays;
    const auto x = static_cast<float>(column), y = static_cast<float>(row);
    constexpr float kStep = 1.0f / kEyeRays;
    const Camera::Ray eye =
        camera.ray(Vec2((x + 0.5f) * kStep * width, (y + 0.5f) * kStep * height));
    geom::Ray ray;
    ray.org = eye.origin;
    ray.dir = eye.direction;
    ray.mask = geom::RayMask::Shadow;
    geom::Hit hit;
    if (!world.accel->intersect(ray, hit)) return;
    found[2 * i] = start_at(world, ray, hit);
    sampling::Sampler sampler(static_cast<int>(i), 0, 0);
    ray = ray_from(found[2 * i], sampler.next_2d());
    if (world.accel->intersect(ray, hit)) found[2 * i + 1] = start_at(world, ray, hit);
  });
  std::erase_if(found, [](const Start& s) { return !s.valid; });
  return found;
}

std::vector<RoomRay> rays_of(const World& world, const std::vector<Start>& starts) {
  std::vector<RoomRay> rays(starts.size() * kRaysPerPoint);
  parallel_for(starts.size(), [&](std::size_t i) {
    for (std::size_t k = 0; k < kRaysPerPoint; ++k) {
      sampling::Sampler sampler(static_cast<int>(i), 1, static_cast<std::uint32_t>(k));
      const geom::Ray ray = ray_from(starts[i], sampler.next_2d());
      geom::Hit hit;
      const bool found = world.accel->intersect(ray, hit);
      rays[i * kRaysPerPoint + k] = {ray.org, ray.dir, found ? normalize(hit.ng) : Vec3(0),
                                     found ? hit.t : ray.tfar};
    }
  });
  return rays;
}

struct BestCandidate {
  OpeningCandidate candidate;
  const OpeningPlane* plane = nullptr;
  float side = 1;
};

/// The candidate with the highest score on either side of any plane; of equal ones the first.
BestCandidate best_of(const std::vector<OpeningPlane>& planes, const std::vector<RoomRay>& rays,
                      const std::vector<std::uint32_t>& escaping) {
  std::vector<BestCandidate> sides(planes.size() * 2);
  parallel_for(sides.size(), [&](std::size_t i) {
    const OpeningPlane& plane = planes[i / 2];
    const float side = i % 2 == 0 ? 1.0f : -1.0f;
    sides[i] = {plane.best(rays, escaping, side), &plane, side};
  });
  BestCandidate best;
  for (const BestCandidate& side : sides)
    if (side.candidate.score > best.candidate.score) best = side;
  return best;
}

/// Accepts candidates, the best first, until they explain most of the escaping rays.
std::vector<OpeningRectangle> accepted(const std::vector<OpeningPlane>& planes,
                                       const std::vector<RoomRay>& rays,
                                       std::vector<std::uint32_t> escaping) {
  const auto total = static_cast<float>(escaping.size());
  std::vector<OpeningRectangle> found;
  while (found.size() < Openings::kMax &&
         static_cast<float>(escaping.size()) > (1 - kEnough) * total) {
    const auto [best, on, side] = best_of(planes, rays, escaping);
    if (!on || static_cast<float>(best.rays) < kMinGain * total) break;
    std::erase_if(escaping, [&, &best = best, &on = on, &side = side](std::uint32_t i) {
      const auto at = on->crossing(rays[i], side);
      return at && best.holds(*at);
    });
    if (on->clear_share(best, side, rays) >= kMinClear) found.push_back(on->rectangle(best, side));
  }
  if (static_cast<float>(escaping.size()) > (1 - kMinExplained) * total) found.clear();
  return found;
}

/// Adds tables of the environment behind the rectangles, and removes those with darkness behind.
void add_tables(const World& world, TableDetail detail, std::vector<OpeningRectangle>& rectangles) {
  for (std::size_t i = 0; i < rectangles.size(); ++i) {
    OpeningRectangle& r = rectangles[i];
    const auto parallel =
        std::find_if(rectangles.begin(), rectangles.begin() + static_cast<std::ptrdiff_t>(i),
                     [&](const OpeningRectangle& other) {
                       constexpr float kParallel = 1 - 1e-6f;
                       return dot(normalize(other.edge_u), normalize(r.edge_u)) > kParallel &&
                              dot(other.inward, r.inward) > kParallel;
                     });
    if (parallel != rectangles.begin() + static_cast<std::ptrdiff_t>(i))
      r.table = parallel->table;
    else
      r.table = std::make_shared<const PortalTable>(world.environment, world, RayKind::FinalGather,
                                                    normalize(r.edge_u), normalize(r.edge_v),
                                                    -r.inward, detail);
  }
  std::erase_if(rectangles, [](const OpeningRectangle& r) { return !r.table->lights(); });
}

/// The rectangles of the geometry that the camera sees; see find_openings().
std::vector<OpeningRectangle> search(const World& world) {
  const std::vector<RoomRay> rays = rays_of(world, starts_of(world));
  std::vector<std::uint32_t> escaping;
  geom::Box3 box;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (rays[i].escapes())
      escaping.push_back(static_cast<std::uint32_t>(i));
    else
      box.extendBy(rays[i].end());
  const float share = static_cast<float>(escaping.size()) / static_cast<float>(rays.size());
  if (!(share > kMinEscaping && share < kMaxEscaping)) return {};

  const std::vector<RoomPlane> planes = room_planes(rays, box);
  std::vector<OpeningPlane> candidates;
  candidates.reserve(planes.size());
  for (const RoomPlane& plane : planes) candidates.emplace_back(plane, planes, box);
  return accepted(candidates, rays, std::move(escaping));
}

}  // namespace

Openings find_openings(const World& world, const EnvironmentLight& environment,
                       OpeningSearch found) {
  if (!environment.lights() || world.accel->instance_count() == 0 ||
      std::any_of(world.lights.begin(), world.lights.end(),
                  [](const Light& light) { return light.portal != nullptr; }))
    return {{}, std::move(found)};
  if (!found) found = std::make_shared<const std::vector<OpeningRectangle>>(search(world));
  std::vector<OpeningRectangle> rectangles = *found;
  if (!environment.table().constant()) add_tables(world, environment.table().detail(), rectangles);
  return {std::move(rectangles), std::move(found)};
}

}  // namespace oriel
