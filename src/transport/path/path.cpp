// SPDX-License-Identifier: Apache-2.0
// The way of a path: from surface to surface, through holes and media.
#include "transport/path/path.h"

#include <algorithm>
#include <cmath>

#include "color/luminance.h"
#include "transport/path/path_walk.h"
#include "transport/scene_tracer.h"
#include "transport/shadow.h"

namespace oriel {
namespace {

/// Vertices of any kind, cut-outs included, before a path is given up.
constexpr int kMostVertices = 256;
/// Draws reserved for each vertex, so that a vertex uses the same dimensions in every sample.
constexpr std::uint32_t kDrawsPerVertex = 12;

}  // namespace

std::uint32_t Path::mask() const {
  switch (kind_) {
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
  switch (kind_) {
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
  float reach = medium_.reach();
  if (veil_.black_distance > 0) reach = std::min(reach, veil_.black_distance);
  if (fading_.distance > 0) reach = std::min(reach, fading_.distance - from_.passed);
  reach = std::min(reach, reach_ - from_.passed);
  ray_ = leave(point, direction, reach, mask());
  left_ = point.position;
}

void Path::dim(const Rgb& factor) {
  throughput_ *= factor;
  lights_ *= factor;
}

/// The surface by which the outputs are told apart.
void Path::meet_first(const Closure& closure) {
  aov_fixed_ = true;
  at_aov_surface_ = closure.outputs;
  if (!record_->aovs || !closure.outputs) return;
  AovValues& out = *record_->aovs;
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    // The highlight beside a mirror has the mirror's level.
    if (lobe.controls.mirrored) continue;
    switch (lobe.type) {
      case LobeType::Diffuse:
        out.level_of(Aov::Diffuse) += lobe.level;
        break;
      case LobeType::Reflection:
        out.level_of(Aov::Reflection) += lobe.level;
        out.level_of(Aov::Specular) += lobe.level * closure.highlight_scale;
        break;
      case LobeType::Refraction:
        out.level_of(Aov::Refraction) += lobe.level;
        break;
      case LobeType::Translucency:
        out.level_of(Aov::Translucency) += lobe.level;
        break;
    }
  }
}

/// Cut-outs, and transparency as rays behind a diffuse bounce see it. True when the ray goes on
/// unbent, with the weights of the vertex it came from; when by chance it does not, the
/// transmitting lobes are taken out of the closure.
bool Path::pass_straight(Closure& closure, const Material& material, ShadingPoint& point) {
  if (after_diffuse_ && material.may_transmit && material.filters_shadows())
    return pass_filter(closure, material, point);
  const bool keeps_weights = material.may_transmit && !material.filters_shadows();
  float u = 0;
  if (closure.opacity < 1)
    u = sampler_.next_1d();
  else
    sampler_.skip();
  Rgb factor(0);
  const bool culled = !closure.seen_from_back && kind_ == RayKind::Eye && point.back_side;
  if (!culled && !aov_fixed_ && record_->aovs && closure.outputs)
    record_->aovs->opacity = closure.opacity;
  if (culled) {
    factor = Rgb(1);
  } else if (u >= closure.opacity) {
    factor = Rgb(1);  // chosen with probability 1 - opacity
    if (!aov_fixed_) aov_ = closure.outputs ? Aov::Background : Aov::Other;
    aov_fixed_ = true;
  } else if (after_diffuse_ && keeps_weights &&
             !(closure.refractive_caustics && world_.options.brings_caustics())) {
    // Straight transmission against everything else, by their levels.
    Rgb through(0), other(closure.emission);
    for (int i = 0; i < closure.count; ++i)
      (transmits(closure.lobes[i].kind) ? through : other) += closure.lobes[i].level;
    const float wanted = luminance(through);
    if (wanted > 0) {
      const float p = wanted / (wanted + luminance(other));
      if (sampler_.next_1d() < p) {
        factor = through / p;
      } else {
        throughput_ /= 1 - p;
        for (int i = 0; i < closure.count; ++i)
          if (transmits(closure.lobes[i].kind)) closure.lobes[i].level = Rgb(0);
      }
    }
  }
  if (is_black(factor)) return false;
  dim(factor);
  medium_.leave_volume(closure, point, ray_.dir);
  if (!keeps_weights) from_.weighed = false;
  if (!culled && u < closure.opacity && !closure.thin_walled) {
    if (straight_rays_fade())
      medium_.leave(closure, point, ray_.dir);
    else
      medium_.ignore();
  }
  from_.passed += point.ray_length;
  follow(point, ray_.dir);
  return true;
}

/// The same behind a diffuse bounce where other shaders than the surface's filter shadows. They
/// stand for all that passes straight; the rest of the surface is seen beside it.
bool Path::pass_filter(Closure& closure, const Material& material, ShadingPoint& point) {
  sampler_.skip();
  Closure filter;
  const Rgb through = straight_through(material, point, world_.options, filter);
  Rgb other(closure.emission);
  for (int i = 0; i < closure.count; ++i) {
    Lobe& lobe = closure.lobes[i];
    if (transmits(lobe.kind)) lobe.level = Rgb(0);
    other += lobe.level;
  }
  const float wanted = luminance(through);
  const float p = wanted > 0 ? wanted / (wanted + luminance(other) * closure.opacity) : 0;
  if (sampler_.next_1d() >= p) {
    throughput_ *= closure.opacity / (1 - p);
    return false;
  }
  dim(through / p);
  medium_.leave_volume(closure, point, ray_.dir);
  if (!filter.thin_walled && straight_rays_fade())
    medium_.leave(filter, point, ray_.dir);
  else if (!closure.thin_walled)
    medium_.ignore();
  from_.passed += point.ray_length;
  follow(point, ray_.dir);
  return true;
}

/// At a surface. False: the path ends here.
bool Path::shade_hit(const geom::Hit& hit) {
  ShadingPoint point;
  fill_point(world_, ray_, hit, cone_, kind_, point);
  point.raster = raster_;
  point.blurred = blurred_;
  cone_.width = cone_.width_at(hit.t);
  const Material& material = material_of(world_, hit);
  Closure closure;
  SceneTracer tracer(world_, sampler_, counts_, this);
  point.tracer = &tracer;
  shade(material, point, closure);
  point.tracer = nullptr;

  // Absorption on the way here: known from where the ray entered, or from the wall it ends at.
  medium_.meet_surface(closure, point);
  if (!medium_.medium.clear() || !veil_.clear()) dim(kept_over(length(point.position - left_)));
  // Where a volume begins or ends the ray's air does, whether or not it goes on unbent.
  const bool in_volume = closure.volume || medium_.volume;
  bool turned = in_volume && pass_volume(point, from_.passed + hit.t);
  if (!turned && pass_straight(closure, material, point)) return true;
  veil_ = {};
  if (to_far_side_ && !point.back_side) return false;
  visibility_ = world_.instances[static_cast<std::size_t>(point.instance)].visibility;
  if (visited_) return note_gather_point(closure, material, point);
  if (grid_point_) {
    fill_grid_point(closure, material, point);
    return false;
  }

  const bool parted = aov_fixed_;
  turned = turned || pass_volume(point, from_.passed + hit.t);
  if (!turned) {
    darken_near(from_.passed + hit.t);
    fade(from_.passed + hit.t);
    leaving_aov_surface_ = false;
  }
  if (!parted) meet_first(closure);
  if (first_) {
    first_ = false;
    record_->alpha = closure.alpha;
    record_->depth = length(point.position - eye_);
    record_->normal = point.normal;
    record_->albedo = closure.albedo;
    record_->first = {point.instance, &material};
    alpha_open_ = true;
    if (met_)
      *met_ = Tracer::Met{record_->depth,  point.position, point.normal,   point.geometric_normal,
                          point.back_side, &material,      point.instance, point.primitive};
    if (record_->requested.irradiance) sense_irradiance(closure, point);
    if (record_->requested.motion) record_->motion = raster_motion(point);
  }
  if (turned) {
    at_aov_surface_ = alpha_open_ = false;
    return russian_roulette();
  }
  if (record_->observer) place_ = record_->observer->on_hit(place_, point, material, closure);
  if (!is_black(closure.emission))
    add(at_vertex(Aov::Added), throughput_ * closure.emission * emission_weight(hit, point),
        layer_of_instance(point.instance));
  return closure.count > 0 && shade_vertex(closure, material, point);
}

void Path::walk() {
  for (; vertex_ < kMostVertices; ++vertex_) {
    sampler_.set_dimension(kDrawsPerVertex * static_cast<std::uint32_t>(vertex_ + 1));
    geom::Hit hit;
    count_ray();
    const bool found = world_.accel->intersect(ray_, hit);
    bool ended = false;
    if (world_.has_area_lights) meet_lights(found ? hit.t : ray_.tfar, ended);
    if (ended || (!found && to_far_side_)) return;
    if (!found && pass_volume_to_infinity()) {
      first_ = false;
      if (!russian_roulette()) return;
      continue;
    }
    if (!found) {
      // Nothing within the reach of a medium that turns black is black.
      if (std::isinf(ray_.tfar) || kind_ == RayKind::Eye || fading_.distance > 0 ||
          !std::isinf(reach_))
        meet_environment();
      return;
    }
    if (!shade_hit(hit)) return;
  }
}

void Path::run(const Camera::Ray& eye) {
  eye_ = ray_.org = left_ = eye.origin;
  ray_.dir = eye.direction;
  ray_.time = eye.time;
  const Camera& camera = world_.camera;
  ray_.tnear = camera.clip_near > 0 ? camera.clip_near / eye.cos_to_film : 0;
  ray_.tfar = camera.clip_far > 0 ? camera.clip_far / eye.cos_to_film : kInfinity;
  ray_.mask = mask();
  cone_ = {eye.width, eye.spread};
  medium_.begin_in(volume_around(world_, ray_));
  walk();
}

void Path::gather_ray(const ShadingPoint& point, const Vec3& direction, float reach) {
  kind_ = RayKind::FinalGather;
  after_diffuse_ = true;
  bounces_ = 1;
  aov_fixed_ = true;
  eye_ = point.position;
  cone_.spread = kDiffuseSpread;
  from_.weighed = true;  // against no lights: it passes through them unseen
  vertex_ = 1;
  reach_ = reach;
  follow(point, direction);
  medium_.begin_in(volume_around(world_, ray_));
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
  return record;
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
  return record;
}

}  // namespace oriel
