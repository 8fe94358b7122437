// SPDX-License-Identifier: Apache-2.0
#include "transport/scene_tracer.h"

#include "lights/light_sampler.h"
#include "lights/sample_light.h"
#include "transport/path/path_for_shaders.h"
#include "transport/path/resolve_outputs.h"
#include "transport/shadow.h"
#include "transport/surface.h"

namespace oriel {
namespace {

/// Tells its stream from those of lobes, which number from 0, and of occlusion.
constexpr std::uint32_t kTracerBranch = 2000;
/// The same for the paths that shaders ask for; they number from here, vertex by vertex.
constexpr std::uint32_t kSubPathBranch = 100000, kSubPathsOfVertex = 4096;
/// Holes on one ray before the rest counts as free.
constexpr int kMaxHoles = 64;

}  // namespace

Vec2 SceneTracer::next() {
  if (!own_) own_ = sampler_.split(0, 1, kTracerBranch + sampler_.dimension());
  return own_->next_2d();
}

sampling::Sampler SceneTracer::next_stream() {
  const std::uint32_t index = streams_++ % kSubPathsOfVertex;
  sampling::Sampler stream =
      sampler_.split(0, 1, kSubPathBranch + kSubPathsOfVertex * sampler_.dimension() + index);
  stream.set_dimension(0);
  return stream;
}

Tracer::Depth SceneTracer::depth() const {
  return path_ ? PathForShaders(*path_).depth() : Depth{};
}

Tracer::Seen SceneTracer::trace(const ShadingPoint& from, const SubRay& ray) {
  return path_ ? PathForShaders(*path_).trace(from, ray, next_stream()) : Seen{};
}

Rgb SceneTracer::irradiance(const ShadingPoint& point, const Vec3& normal) {
  return path_ ? PathForShaders(*path_).irradiance(point, normal, next_stream()) : Rgb(0);
}

Rgba SceneTracer::shade(const NodeList& surface, ShadingPoint& point, MaterialOutputs* outputs) {
  if (!path_) return Rgba(0);
  AovValues parts;
  const Rgba colour =
      PathForShaders(*path_).shade(surface, point, outputs ? &parts : nullptr, next_stream());
  if (outputs) *outputs = resolve_outputs(parts, rgb(colour));
  return colour;
}

bool SceneTracer::write_buffer(std::size_t slot, const Rgba& value) {
  const std::span<Rgba> buffers = path_ ? PathForShaders(*path_).user_buffers() : std::span<Rgba>();
  if (slot >= buffers.size()) return false;
  buffers[slot] = value;
  return true;
}

std::optional<Rgba> SceneTracer::read_buffer(std::size_t slot) const {
  const std::span<const Rgba> buffers =
      path_ ? PathForShaders(*path_).user_buffers() : std::span<Rgba>();
  if (slot >= buffers.size()) return std::nullopt;
  return buffers[slot];
}

std::optional<Tracer::Met> SceneTracer::follow(geom::Ray ray, float reach) {
  float passed = 0;
  for (int i = 0; i < kMaxHoles; ++i) {
    geom::Hit hit;
    ++counts_.probe;
    if (!world_.accel->intersect(ray, hit)) return std::nullopt;
    ShadingPoint point;
    fill_point(world_, ray, hit, {}, RayKind::Probe, point);
    const Material& material = material_of(world_, hit);
    bool there = true;
    if (material.may_have_holes) {
      Closure closure;
      oriel::shade(material, point, closure);
      there = next().x < closure.opacity;
    }
    if (there)
      return Met{passed + hit.t,  point.position, point.normal,   point.geometric_normal,
                 point.back_side, &material,      point.instance, point.primitive};
    passed += hit.t;
    ray = leave(point, ray.dir, reach - passed, geom::RayMask::Probe);
  }
  return std::nullopt;
}

std::optional<Tracer::Met> SceneTracer::probe(const Vec3& origin, const Vec3& direction,
                                              float reach) {
  geom::Ray ray;
  ray.org = origin;
  ray.dir = direction;
  ray.tfar = reach;
  ray.mask = geom::RayMask::Probe;
  ray.time = path_ ? PathForShaders(*path_).time() : world_.shutter.middle();
  return follow(ray, reach);
}

std::optional<Tracer::Met> SceneTracer::probe_from(const ShadingPoint& point, const Vec3& direction,
                                                   float reach) {
  return follow(leave(point, direction, reach, geom::RayMask::Probe), reach);
}

std::optional<Tracer::Arriving> SceneTracer::light(int index, ShadingPoint& point) {
  if (index < 0 || index >= static_cast<int>(world_.lights.size())) return std::nullopt;
  const auto s = sample_light(world_.lights[static_cast<std::size_t>(index)], point, next());
  if (!s) return std::nullopt;
  Rgb open(1);
  if (s->shadow && receives_shadows(world_, point)) {
    const Rgb all = shadow_transmittance(world_, point, s->wi, s->reach, counts_, index).all;
    open = all + (Rgb(1) - all) * s->shadow_factor;
  }
  const Rgb unshadowed = s->irradiance * kInvPi;
  return Arriving{unshadowed * open,   unshadowed,        s->wi,    s->distance, s->affects_diffuse,
                  s->affects_specular, s->force_specular, s->is_sun};
}

Tracer::PickedLights SceneTracer::pick_lights(const Vec3& place) {
  const LightSampler& lights = *world_.light_sampler;
  PickedLights picked;
  lights.sample_in_volume(place, lights.chooses() ? next().x : 0, [&](const LightPick& pick) {
    picked.add(pick.light, pick.expected_samples);
  });
  return picked;
}

}  // namespace oriel
