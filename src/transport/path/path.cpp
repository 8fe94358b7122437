// SPDX-License-Identifier: Apache-2.0
// The loop of a path: from surface to surface, through cut-outs and media.
#include "transport/path/path.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "color/luminance.h"
#include "transport/path/path_walk.h"
#include "transport/scene_tracer.h"
#include "transport/shadow.h"

namespace oriel {
namespace {

/// Maximum number of vertices of a path, including cut-outs.
constexpr int kMaxVertices = 256;
/// Sample dimensions reserved for each vertex, so that a vertex uses the same dimensions in every
/// sample.
constexpr std::uint32_t kDrawsPerVertex = 12;

/// A ray of the camera between its clipping planes.
geom::Ray camera_ray(const Camera& camera, const Camera::Ray& eye) {
  geom::Ray ray;
  ray.org = eye.origin;
  ray.dir = eye.direction;
  ray.time = eye.time;
  ray.tnear = camera.clip_near > 0 ? camera.clip_near / eye.cos_to_film : 0;
  ray.tfar = camera.clip_far > 0 ? camera.clip_far / eye.cos_to_film : kInfinity;
  ray.mask = geom::RayMask::Camera;
  return ray;
}

}  // namespace

std::uint32_t Path::mask() const {
  switch (way_.kind) {
    case RayKind::Eye:
      return geom::RayMask::Camera;
    case RayKind::Reflect:
      return geom::RayMask::Reflection;
    case RayKind::Refract:
      return geom::RayMask::Refraction;
    case RayKind::Transparent:
      return geom::RayMask::Transparency;
    default:
      return geom::RayMask::FinalGather;
  }
}

void Path::count_ray() {
  switch (way_.kind) {
    case RayKind::Eye:
      ++counts_.eye;
      break;
    case RayKind::Reflect:
      ++counts_.reflect;
      break;
    case RayKind::Refract:
    case RayKind::Transparent:
      ++counts_.refract;
      break;
    default:
      ++counts_.gather;
      break;
  }
}

void Path::follow(const ShadingPoint& point, const Vec3& direction) {
  float reach = way_.medium.reach();
  if (way_.veil.black_distance > 0) reach = std::min(reach, way_.veil.black_distance);
  if (fading_.distance > 0) reach = std::min(reach, fading_.distance - from_.passed);
  reach = std::min(reach, way_.reach - from_.passed);
  way_.leave_surface(point, direction, reach, mask());
}

void Path::dim(const Rgb& factor) {
  light_.throughput *= factor;
  light_.lights *= factor;
}

/// Records the weights of the lobes at the surface that determines the AOVs.
void Path::meet_first(const Closure& closure) {
  aov_.fixed = true;
  aov_.at_surface = closure.outputs;
  if (!record_->aovs || !closure.outputs) return;
  AovValues& out = *record_->aovs;
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    // The highlight of a mirror shares the weight of the mirror.
    if (lobe.controls.mirrored) continue;
    switch (lobe.type) {
      case LobeType::Diffuse:
        out.level_of(Aov::Diffuse) += lobe.weight;
        break;
      case LobeType::Reflection:
        out.level_of(Aov::Reflection) += lobe.weight;
        out.level_of(Aov::Specular) += lobe.weight * closure.highlight_scale;
        break;
      case LobeType::Refraction:
        out.level_of(Aov::Refraction) += lobe.weight;
        break;
      case LobeType::Translucency:
        out.level_of(Aov::Translucency) += lobe.weight;
        break;
    }
  }
}

/// Cut-outs, and straight transparency behind a diffuse bounce. True: the ray continues unbent and
/// keeps the MIS weights of its last vertex. If the random choice is against transparency, the
/// transmitting lobes are removed from the closure.
bool Path::pass_straight(Closure& closure, const Material& material, ShadingPoint& point) {
  if (depth_.after_diffuse && material.may_transmit && material.filters_shadows())
    return pass_filter(closure, material, point);
  const bool keeps_weights = material.may_transmit && !material.filters_shadows();
  float u = 0;
  if (closure.opacity < 1)
    u = sampler_.next_1d();
  else
    sampler_.skip();
  Rgb factor(0);
  const bool culled = !closure.seen_from_back && way_.kind == RayKind::Eye && point.back_side;
  if (!culled && !aov_.fixed && record_->aovs && closure.outputs)
    record_->aovs->opacity = closure.opacity;
  if (culled) {
    factor = Rgb(1);
  } else if (u >= closure.opacity) {
    factor = Rgb(1);  // chosen with probability 1 - opacity
    if (!aov_.fixed) aov_.part = closure.outputs ? Aov::Background : Aov::Other;
    aov_.fixed = true;
  } else if (depth_.after_diffuse && keeps_weights && !bends_light(closure, world_.options)) {
    // The choice between straight transmission and everything else, by their weights.
    Rgb through(0), other(closure.emission);
    for (int i = 0; i < closure.count; ++i)
      (transmits(closure.lobes[i].kind) ? through : other) += closure.lobes[i].weight;
    const float wanted = luminance(through);
    if (wanted > 0) {
      const float p = wanted / (wanted + luminance(other));
      if (sampler_.next_1d() < p) {
        factor = through / p;
      } else {
        light_.throughput /= 1 - p;
        for (int i = 0; i < closure.count; ++i)
          if (transmits(closure.lobes[i].kind)) closure.lobes[i].weight = Rgb(0);
      }
    }
  }
  if (is_black(factor)) return false;
  dim(factor);
  way_.medium.leave_volume(closure, point, way_.ray.dir);
  if (!keeps_weights) from_.weighed = false;
  if (!culled && u < closure.opacity)
    way_.medium.pass_straight(closure, closure, point, way_.ray.dir,
                              straight_rays_fade(world_.options));
  from_.passed += point.ray_length;
  follow(point, way_.ray.dir);
  return true;
}

/// The same behind a diffuse bounce if shadow shaders other than the surface shader filter light.
/// They determine the straight transmission; the other lobes of the surface remain.
bool Path::pass_filter(Closure& closure, const Material& material, ShadingPoint& point) {
  sampler_.skip();
  Closure filter;
  const Rgb through = straight_through(material, point, world_.options, filter);
  Rgb other(closure.emission);
  for (int i = 0; i < closure.count; ++i) {
    Lobe& lobe = closure.lobes[i];
    if (transmits(lobe.kind)) lobe.weight = Rgb(0);
    other += lobe.weight;
  }
  const float wanted = luminance(through);
  const float p = wanted > 0 ? wanted / (wanted + luminance(other) * closure.opacity) : 0;
  if (sampler_.next_1d() >= p) {
    light_.throughput *= closure.opacity / (1 - p);
    return false;
  }
  dim(through / p);
  way_.medium.leave_volume(closure, point, way_.ray.dir);
  way_.medium.pass_straight(filter, closure, point, way_.ray.dir,
                            straight_rays_fade(world_.options));
  from_.passed += point.ray_length;
  follow(point, way_.ray.dir);
  return true;
}

/// Shades a hit. Afterwards the ray cone is that at the surface.
const Material& Path::shade_surface(const geom::Hit& hit, ShadingPoint& point, Closure& closure) {
  fill_point(world_, way_.ray, hit, way_.cone, way_.kind, point);
  point.raster = raster_;
  point.blurred = way_.blurred;
  point.unbent = depth_.after_diffuse;
  way_.cone.width = way_.cone.width_at(hit.t);
  const Material& material = material_of(world_, hit);
  SceneTracer tracer(world_, sampler_, counts_, this);
  point.tracer = &tracer;
  shade(material, point, closure);
  point.tracer = nullptr;
  return material;
}

/// Stores the first surface in the record, and for the shader that traces the path.
void Path::record_first_hit(const Closure& closure, const ShadingPoint& point,
                            const Material& material) {
  eye_hit_.pending = false;
  eye_hit_.alpha_open = true;
  record_->alpha = closure.alpha;
  record_->depth = length(point.position - eye_hit_.eye);
  record_->normal = point.normal;
  record_->albedo = closure.albedo;
  record_->first = {point.instance, &material};
  if (eye_hit_.met)
    *eye_hit_.met =
        Tracer::Met{record_->depth,  point.position, point.normal,   point.geometric_normal,
                    point.back_side, &material,      point.instance, point.primitive};
  if (record_->requested.irradiance) sense_irradiance(closure, point);
  (*record_)[SurfaceValue::Position] = point.position;
  if (record_->wants(SurfaceValue::Motion)) (*record_)[SurfaceValue::Motion] = raster_motion(point);
}

/// Handles a hit. False: the path ends here.
bool Path::shade_hit(const geom::Hit& hit, ShadingPoint& point) {
  Closure closure;
  const Material& material = shade_surface(hit, point, closure);
  const float distance = from_.passed + hit.t;

  // Absorption up to this surface. The medium is known from the surface where the ray entered, or
  // from this one if it is a back side.
  way_.medium.meet_surface(closure, point);
  if (!way_.medium.medium.clear() || !way_.veil.clear())
    dim(kept_over(length(point.position - way_.left)));
  // The segment in a volume ends at its boundary, even if the ray continues unbent.
  const bool in_volume = closure.volume || way_.medium.volume;
  bool turned = in_volume && pass_volume(point.position, distance);
  if (!turned && pass_straight(closure, material, point)) return true;

  way_.veil = {};
  if (way_.to_far_side && !point.back_side) return false;
  visibility_ = world_.instances[static_cast<std::size_t>(point.instance)].visibility;
  if (visitor_) return visitor_->on_surface(*this, closure, material, point);

  const bool aov_was_fixed = aov_.fixed;
  turned = turned || pass_volume(point.position, distance);
  if (!turned) {
    darken_near(distance);
    fade(distance);
    aov_.leaving = false;
  }
  if (!aov_was_fixed) meet_first(closure);
  if (eye_hit_.pending) record_first_hit(closure, point, material);
  if (turned) {
    aov_.at_surface = eye_hit_.alpha_open = false;
    return russian_roulette();
  }
  if (record_->observer) place_ = record_->observer->on_hit(place_, point, material, closure);
  if (!is_black(closure.emission))
    add(aov_.at_vertex(Aov::Added),
        light_.throughput * closure.emission * emission_weight(hit, point),
        layer_of_instance(point.instance));
  if (settings_.maps && settings_.maps->retrace > 0 && depth_.after_diffuse)
    too_near_for_cache_ = distance < settings_.maps->retrace * sampler_.next_1d();
  return closure.count > 0 && shade_vertex(closure, material, point);
}

void Path::walk() {
  // Of this surface, and of the vertex that the ray left; constructed where a surface is hit.
  union Place {
    Place() {}
    ShadingPoint point;
  } places[2];
  for (; depth_.vertex < kMaxVertices; ++depth_.vertex) {
    sampler_.set_dimension(kDrawsPerVertex * static_cast<std::uint32_t>(depth_.vertex + 1));
    geom::Hit hit;
    count_ray();
    const bool found = world_.accel->intersect(way_.ray, hit);
    AtLights lights = AtLights::Passed;
    if (world_.has_area_lights) lights = meet_lights(found ? hit.t : way_.ray.tfar);
    if (lights == AtLights::Ended) return;
    if (lights == AtLights::Passed && !found && way_.to_far_side) return;
    if (lights == AtLights::Scattered || (!found && pass_volume_to_infinity())) {
      eye_hit_.pending = false;
      if (!russian_roulette()) return;
      continue;
    }
    if (!found) {
      // A ray that ends within a medium that becomes black is black.
      if (std::isinf(way_.ray.tfar) || way_.kind == RayKind::Eye || fading_.distance > 0 ||
          !std::isinf(way_.reach))
        meet_environment();
      return;
    }
    ShadingPoint& point = places[from_.point == &places[0].point ? 1 : 0].point;
    std::construct_at(&point);
    if (!shade_hit(hit, point)) return;
  }
}

void Path::run(const Camera::Ray& eye) {
  eye_hit_.eye = eye.origin;
  way_.ray = camera_ray(world_.camera, eye);
  way_.cone = {eye.width, eye.spread};
  way_.begin(world_);
  walk();
}

void Path::gather_ray(const ShadingPoint& point, const Vec3& direction, float reach) {
  way_.kind = RayKind::FinalGather;
  depth_.after_diffuse = true;
  caustics_ = settings_.maps;
  depth_.bounces = 1;
  aov_.fixed = true;
  eye_hit_.eye = point.position;
  way_.cone.spread = kDiffuseSpread;
  from_.weighed = true;  // with no sampled lights: lights are invisible to the ray
  depth_.vertex = 1;
  way_.reach = reach;
  follow(point, direction);
  way_.medium.begin_in(volume_around(world_, way_.ray));
  walk();
}

void trace_gather_ray(const World& world, const ShadingPoint& point, const Vec3& direction,
                      float reach, const PathSettings& settings, PathRecord& record,
                      sampling::Sampler& sampler, RayCounts& counts) {
  Path(world, point.raster, settings, record, sampler, counts).gather_ray(point, direction, reach);
}

PathResult trace_gather_ray(const World& world, const ShadingPoint& point, const Vec3& direction,
                            float reach, const PathSettings& settings, sampling::Sampler& sampler,
                            RayCounts& counts) {
  PathRecord record;
  trace_gather_ray(world, point, direction, reach, settings, record, sampler, counts);
  return static_cast<const PathResult&>(record);
}

void trace_path(const World& world, const Camera::Ray& eye, Vec2 raster,
                const PathSettings& settings, PathRecord& record, sampling::Sampler& sampler,
                RayCounts& counts) {
  Path(world, raster, settings, record, sampler, counts).run(eye);
  record.note_first_surface(record.first);
}

PathResult trace_path(const World& world, const Camera::Ray& eye, Vec2 raster,
                      const PathSettings& settings, sampling::Sampler& sampler, RayCounts& counts) {
  PathRecord record;
  trace_path(world, eye, raster, settings, record, sampler, counts);
  return static_cast<const PathResult&>(record);
}

bool meets_object(const World& world, const Camera::Ray& eye) {
  return world.accel->occluded(camera_ray(world.camera, eye));
}

}  // namespace oriel
