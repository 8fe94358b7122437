// SPDX-License-Identifier: Apache-2.0
#include "render/eye_rays.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "runtime/shutter_time.h"
#include "transport/path/path_observer.h"

namespace oriel {
namespace {

/// The lens shaders from `lens` on, and behind the last of them the scene. Lenses that ask for rays
/// themselves may ask for several: the first path of a sample brings what is no colour.
class LensChain final : public LensNext {
 public:
  /// What all lenses of a sample share.
  struct Shared {
    const World& world;
    const Camera& camera;  ///< at that time
    float time;
    Vec2 raster;
    const PathSettings& settings;
    sampling::Sampler& sampler;
    RayCounts& counts;
    std::optional<PathResult> first = std::nullopt;
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
    if (node.spec().lens_eye) {
      const Rgba colour = node.with_params(
          point, [&](const Call& call) { return node.spec().lens_eye(call, behind); });
      const Seen first = behind.first_.value_or(Seen{});
      return {colour, first.distance, first.normal};
    }
    const Vec2 u = s_.sampler.next_2d();
    const Rgb weight = node.with_params(
        point, [&](const Call& call) { return node.spec().lens_ray(call, s_.camera, u, ray); });
    Seen seen = behind.trace(ray);
    seen.colour *= Rgba(weight.x, weight.y, weight.z, 1);
    return seen;
  }

  Seen trace_scene(const Camera::Ray& ray) {
    // Every path of a sample needs numbers of its own.
    constexpr std::uint32_t kBranch = 5000;
    sampling::Sampler own = s_.sampler.split(0, 1, kBranch + s_.sampler.dimension());
    s_.sampler.skip();
    PathSettings settings = s_.settings;
    if (s_.first)
      settings.outputs = nullptr, settings.by_light = nullptr, settings.motion = nullptr;
    const PathResult path = trace_path(s_.world, ray, s_.raster, settings, own, s_.counts);
    if (!s_.first) s_.first = path;
    return {Rgba(path.radiance.x, path.radiance.y, path.radiance.z, path.alpha), path.depth,
            path.normal};
  }

  Shared& s_;
  std::size_t lens_;
  std::optional<Seen> first_;
};

bool asks_for_rays(const ShaderNode* node) { return node->spec().lens_eye != nullptr; }

/// A sample through lenses some of which make its colour themselves.
PathResult trace_chain(const World& world, const Camera& camera, float time, Vec2 raster,
                       const PathSettings& settings, sampling::Sampler& sampler,
                       RayCounts& counts) {
  LensChain::Shared shared{world, camera, time, raster, settings, sampler, counts};
  const LensNext::Seen seen = LensChain(shared, 0).trace(camera.ray(raster, time));
  PathResult result = shared.first.value_or(PathResult{});
  result.radiance = rgb(seen.colour);
  result.alpha = clamp01(seen.colour.a);
  return result;
}

/// A path through the lens, one of many, and its weight.
PathResult trace_through_lens(const World& world, const Camera& camera, float time, Vec2 raster,
                              const PathSettings& settings, float share, sampling::Sampler& sampler,
                              RayCounts& counts, Rgb& weight) {
  Camera::Ray ray = camera.ray(raster, time);
  for (const ShaderNode* node : world.lens_rays) {
    ShadingPoint point;
    point.raster = raster;
    point.world = &world;
    point.ray_origin = ray.origin;
    point.ray_direction = ray.direction;
    const Vec2 u = sampler.next_2d();
    weight *= node->with_params(
        point, [&](const Call& call) { return node->spec().lens_ray(call, camera, u, ray); });
  }
  if (is_black(weight)) {  // no light comes this way
    if (settings.firsts) settings.firsts->emplace_back();
    return {};
  }
  if (settings.observer) settings.observer->set_weight(weight * share);
  return trace_path(world, ray, raster, settings, sampler, counts);
}

void add_outputs(AovValues& sum, const AovValues& part, const Rgb& weight, float share) {
  for (std::size_t i = 0; i < kAovs; ++i) sum.result[i] += part.result[i] * weight * share;
  for (std::size_t i = 0; i < kLevels; ++i) sum.level[i] += part.level[i] * share;
  sum.occlusion += part.occlusion * share;
  sum.dimming += part.dimming * share;
  sum.opacity += part.opacity * share;
}

}  // namespace

PathResult trace_eye_rays(const World& world, Vec2 raster, const PathSettings& settings,
                          sampling::Sampler& sampler, RayCounts& counts) {
  const float time = shutter_time(world.shutter, sampler);
  if (world.lens_rays.empty())
    return trace_path(world, world.camera.ray(raster, time), raster, settings, sampler, counts);

  std::optional<Camera> moved;
  if (!world.camera.path.empty()) moved = world.camera.at(time);
  const Camera& camera = moved ? *moved : world.camera;
  if (std::any_of(world.lens_rays.begin(), world.lens_rays.end(), asks_for_rays))
    return trace_chain(world, camera, time, raster, settings, sampler, counts);
  int rays = 1;
  for (const ShaderNode* node : world.lens_rays)
    rays = std::clamp(rays * std::clamp(node->spec().lens_rays(*node), 1, kMostLensRays), 1,
                      kMostLensRays);
  const auto n = static_cast<std::uint32_t>(rays);
  const float share = 1 / static_cast<float>(rays);
  PathSettings each = settings;
  each.paths_of_pixel *= static_cast<float>(rays);
  PathResult sum;
  AovValues parts;
  parts.occlusion = parts.dimming = Rgb(0), parts.opacity = 0;
  LightParts own_lights;
  const std::size_t layers = settings.by_light ? world.light_layers.count() : 0;
  float hits = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    sampling::Sampler own = sampler.split(i, n, 0);
    if (i > 0) each.motion = nullptr;
    AovValues part;
    if (settings.outputs) each.outputs = &part;
    own_lights.clear(layers);
    if (layers > 0) each.by_light = own_lights.data();
    Rgb weight(1);
    const PathResult path =
        trace_through_lens(world, camera, time, raster, each, share, own, counts, weight);
    sum.radiance += path.radiance * weight * share;
    sum.alpha += path.alpha * share;
    sum.normal += path.normal * share;
    sum.albedo += path.albedo * share;
    if (path.depth > 0) sum.depth += path.depth, sum.irradiance += path.irradiance, ++hits;
    if (settings.outputs) add_outputs(parts, part, weight, share);
    for (std::size_t k = 0; k < layers; ++k)
      settings.by_light[k] += own_lights.of[k] * weight * share;
  }
  if (hits > 0) sum.depth /= hits, sum.irradiance /= hits;
  if (settings.outputs) *settings.outputs = parts;
  return sum;
}

}  // namespace oriel
