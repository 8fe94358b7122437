// SPDX-License-Identifier: Apache-2.0
#include "render/eye_rays.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "render/path_integrator.h"
#include "runtime/shutter_time.h"
#include "transport/path/path_observer.h"

namespace oriel {
namespace {

/// The lens shaders from index `lens` on, followed by the scene. A lens shader that traces rays may
/// trace several; values other than colour come from the first path of a sample.
class LensChain final : public LensNext {
 public:
  /// Data shared by all lenses of a sample.
  struct Shared {
    const World& world;
    const Camera& camera;  ///< at that time
    float time;
    Vec2 raster;
    const Integrator& integrator;
    float paths_of_pixel;
    PathRecord& record;
    sampling::Sampler& sampler;
    RayCounts& counts;
    bool recorded = false;  ///< the first path has been traced
  };
  LensChain(Shared& shared, std::size_t lens) : s_(shared), lens_(lens) {}

  Seen trace(const Vec3& origin, const Vec3& direction) override {
    Camera::Ray ray = s_.camera.ray(s_.raster, s_.time);
    ray.origin = origin;
    ray.direction = direction;
    return trace(ray);
  }
  Vec2 next() override { return s_.sampler.next_2d(); }

  Seen trace(const Camera::Ray& ray) {
    const Seen seen = lens_ == s_.world.lens_rays.size() ? trace_scene(ray) : trace_lens(ray);
    if (!first_) first_ = seen;
    return seen;
  }

 private:
  Seen trace_lens(Camera::Ray ray) {
    const ShaderNode& node = *s_.world.lens_rays[lens_];
    LensChain behind(s_, lens_ + 1);
    ShadingPoint point;
    point.raster = s_.raster;
    point.world = &s_.world;
    point.ray_origin = ray.origin;
    point.ray_direction = ray.direction;
    if (node.spec().lens.trace) {
      const Rgba colour = node.with_params(
          point, [&](const Call& call) { return node.spec().lens.trace(call, behind); });
      const Seen first = behind.first_.value_or(Seen{});
      return {colour, first.distance, first.normal};
    }
    const Vec2 u = s_.sampler.next_2d();
    const Rgb weight = node.with_params(point, [&](const Call& call) {
      return node.spec().lens.bend_ray(call, s_.camera, u, ray);
    });
    Seen seen = behind.trace(ray);
    seen.colour *= Rgba(weight.x, weight.y, weight.z, 1);
    return seen;
  }

  Seen trace_scene(const Camera::Ray& ray) {
    // Each path of a sample needs its own random numbers.
    constexpr std::uint32_t kBranch = 5000;
    sampling::Sampler own = s_.sampler.split(0, 1, kBranch + s_.sampler.dimension());
    s_.sampler.skip();
    PathRecord other({}, s_.record.user_buffers, s_.record.observer);
    PathRecord& record = s_.recorded ? other : s_.record;
    s_.integrator.trace(ray, s_.raster, s_.paths_of_pixel, record, own, s_.counts);
    if (std::exchange(s_.recorded, true)) s_.record.note_first_surface(other.first);
    return {Rgba(record.radiance.x, record.radiance.y, record.radiance.z, record.alpha),
            record.depth, record.normal};
  }

  Shared& s_;
  std::size_t lens_;
  std::optional<Seen> first_;
};

bool asks_for_rays(const ShaderNode* node) { return node->spec().lens.trace != nullptr; }

/// Traces a sample through lenses, some of which compute its colour.
void trace_chain(const World& world, const Integrator& integrator, const Camera& camera, float time,
                 Vec2 raster, float paths_of_pixel, PathRecord& record, sampling::Sampler& sampler,
                 RayCounts& counts) {
  LensChain::Shared shared{world,          camera, time,    raster, integrator,
                           paths_of_pixel, record, sampler, counts};
  const LensNext::Seen seen = LensChain(shared, 0).trace(camera.ray(raster, time));
  record.radiance = rgb(seen.colour);
  record.alpha = clamp01(seen.colour.a);
}

/// Traces one of several paths through the lens. Returns its weight.
Rgb trace_through_lens(const World& world, const Integrator& integrator, const Camera& camera,
                       float time, Vec2 raster, float paths_of_pixel, float share,
                       PathRecord& record, sampling::Sampler& sampler, RayCounts& counts) {
  Rgb weight(1);
  Camera::Ray ray = camera.ray(raster, time);
  for (const ShaderNode* node : world.lens_rays) {
    ShadingPoint point;
    point.raster = raster;
    point.world = &world;
    point.ray_origin = ray.origin;
    point.ray_direction = ray.direction;
    const Vec2 u = sampler.next_2d();
    weight *= node->with_params(
        point, [&](const Call& call) { return node->spec().lens.bend_ray(call, camera, u, ray); });
  }
  if (is_black(weight)) return weight;  // no light passes
  if (record.observer) record.observer->set_weight(weight * share);
  integrator.trace(ray, raster, paths_of_pixel, record, sampler, counts);
  return weight;
}

}  // namespace

void trace_eye_rays(const World& world, const Integrator& integrator, Vec2 raster,
                    float samples_of_pixel, PathRecord& record, sampling::Sampler& sampler,
                    RayCounts& counts) {
  const float time = shutter_time(world.shutter, sampler);
  if (world.lens_rays.empty())
    return integrator.trace(world.camera.ray(raster, time), raster, samples_of_pixel, record,
                            sampler, counts);

  std::optional<Camera> moved;
  if (!world.camera.path.empty()) moved = world.camera.at(time);
  const Camera& camera = moved ? *moved : world.camera;
  if (std::any_of(world.lens_rays.begin(), world.lens_rays.end(), asks_for_rays))
    return trace_chain(world, integrator, camera, time, raster, samples_of_pixel, record, sampler,
                       counts);
  int rays = 1;
  for (const ShaderNode* node : world.lens_rays)
    rays = std::clamp(rays * std::clamp(node->spec().lens.ray_count(*node), 1, kMaxLensRays), 1,
                      kMaxLensRays);
  const auto n = static_cast<std::uint32_t>(rays);
  const float share = 1 / static_cast<float>(rays);
  const float paths_of_pixel = samples_of_pixel * static_cast<float>(rays);
  record.begin_mean();
  PathRecord path(record.requested, record.user_buffers, record.observer);
  for (std::uint32_t i = 0; i < n; ++i) {
    sampling::Sampler own = sampler.split(i, n, 0);
    path.reset();
    const Rgb weight = trace_through_lens(world, integrator, camera, time, raster, paths_of_pixel,
                                          share, path, own, counts);
    record.add_path(path, weight, share);
  }
  record.end_mean();
}

void trace_at_silhouette(const World& world, const Integrator& integrator, SilhouetteSample& sample,
                         float samples_of_pixel, PathRecord& record, sampling::Sampler& sampler,
                         RayCounts& counts) {
  constexpr std::uint32_t kChoiceBranch = 5001, kMissBranch = 5002;
  const float time = shutter_time(world.shutter, sampler);
  auto& places = sample.places;
  const auto rest = std::partition(places.begin(), places.end(), [&](const Vec2& place) {
    return meets_object(world, world.camera.ray(place, time));
  });
  sample.met = static_cast<std::size_t>(rest - places.begin());
  // Of the rays of a sample, one is its eye ray.
  const std::uint64_t eye_rays = counts.eye + 1;
  counts.probe += places.size();
  const float u = sampler.split(0, 1, kChoiceBranch).next_1d();
  record.begin_mean();
  PathRecord path(record.requested, record.user_buffers, record.observer);
  const auto trace_one = [&](auto from, auto to, sampling::Sampler& numbers) {
    path.reset();
    if (from == to) return Rgb(0);
    const auto count = static_cast<float>(to - from);
    const Vec2 place = from[static_cast<std::ptrdiff_t>(u * count)];
    const float share = count / static_cast<float>(places.size());
    if (record.observer) record.observer->set_weight(Rgb(share));
    integrator.trace(world.camera.ray(place, time), place, samples_of_pixel, path, numbers, counts);
    record.add_path(path, Rgb(1), share);
    // Each place counts as a path for what pixels show.
    for (auto other = from + 1; other < to; ++other) record.note_first_surface(path.first);
    return path.radiance;
  };
  sampling::Sampler of_rest = sampler.split(0, 1, kMissBranch);
  sample.of_met = trace_one(places.begin(), rest, sampler);
  sample.of_rest = trace_one(rest, places.end(), of_rest);
  counts.probe += counts.eye - eye_rays;
  counts.eye = eye_rays;
  record.end_mean();
}

PathResult trace_eye_rays(const World& world, Vec2 raster, sampling::Sampler& sampler,
                          RayCounts& counts) {
  PathRecord record;
  trace_eye_rays(world, PathIntegrator(world), raster, PathSettings{}.paths_of_pixel, record,
                 sampler, counts);
  return static_cast<const PathResult&>(record);
}

}  // namespace oriel
