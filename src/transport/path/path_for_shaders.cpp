// SPDX-License-Identifier: Apache-2.0
#include "transport/path/path_for_shaders.h"
#include "transport/gather/bounce_reads.h"

#include <utility>

#include "sampling/warp.h"
#include "transport/gather/bounce_reads.h"
#include "transport/path/path_walk.h"
#include "transport/scene_tracer.h"

namespace oriel {
namespace {

/// Maximum nesting of shader paths; deeper ones are black. Trace depths usually end them earlier.
constexpr int kMaxNested = 48;
/// Probability of evaluating irradiance after kRouletteDepth bounces. The reflectance of shaders is
/// unknown, so nothing else would end the recursion.
constexpr float kSurvival = 0.5f;  ///< an estimate between white and dark rooms

}  // namespace

Tracer::Depth PathForShaders::depth() const {
  return {path_.depth_.reflections, path_.depth_.refractions,
          std::min(1.0f, path_.depth_.importance)};
}

float PathForShaders::time() const { return path_.way_.ray.time; }

std::span<Rgba> PathForShaders::user_buffers() const {
  return path_.depth_.after_diffuse ? std::span<Rgba>() : path_.record_->user_buffers;
}

/// A separate path that starts at this vertex; its radiance has no weight.
Path PathForShaders::sub_path(const sampling::Sampler& stream, PathRecord& record) const {
  if (BounceReads* reads = path_.record_->bounce_reads) reads->complete = false;
  sampling::Sampler own = stream;
  Path sub(path_.world_, path_.raster_, path_.settings_, record, own, path_.counts_);
  sub.grid_ = nullptr;
  sub.depth_ = path_.depth_;
  ++sub.depth_.vertex;
  ++sub.depth_.nested;
  if (path_.visitor_ && path_.visitor_->visits_rays_of_shaders()) sub.visitor_ = path_.visitor_;
  sub.way_.cone = path_.way_.cone;
  sub.way_.kind = path_.way_.kind;
  sub.way_.blurred = path_.way_.blurred;
  sub.aov_.fixed = true;
  sub.eye_hit_.features_seen = true;
  sub.off_maps_ = path_.off_maps_;
  sub.caustics_ = path_.caustics_;
  return sub;
}

Tracer::Seen PathForShaders::trace(const ShadingPoint& point, const Tracer::SubRay& ray,
                                   const sampling::Sampler& stream) const {
  Tracer::Seen seen;
  if (path_.depth_.nested >= kMaxNested) return seen;
  PathRecord record({}, path_.record_->user_buffers);
  Path sub = sub_path(stream, record);
  sub.way_.kind = ray.kind;
  sub.depth_.reflections = ray.depth.reflections;
  sub.depth_.refractions = ray.depth.refractions;
  sub.depth_.importance = ray.depth.importance;
  sub.way_.reach = ray.reach;
  sub.eye_hit_.met = &seen.met;
  if (point.material && !point.material->environment.empty())
    sub.way_.environment = &point.material->environment;
  ShadingPoint from = point;
  if (!ray.from_surface) {
    from.position = ray.origin;
    from.ray_offset = 0;
  }
  sub.eye_hit_.eye = from.position;
  sub.follow(from, ray.direction);
  sub.way_.medium.begin_in(volume_around(path_.world_, sub.way_.ray));
  sub.walk();
  seen.colour = Rgba(record.radiance.x, record.radiance.y, record.radiance.z, record.alpha);
  return seen;
}

Rgb PathForShaders::irradiance(const ShadingPoint& point, const Vec3& normal,
                               sampling::Sampler stream) const {
  ShadingPoint at = point;
  at.geometric_normal = Path::facing(point.geometric_normal, normal);
  if (at.geometric_normal != point.geometric_normal) at.back_side = !at.back_side;
  at.normal = normal;
  if (path_.visitor_ && path_.visitor_->on_irradiance(at, normal)) return Rgb(0);
  Rgb sum(0);
  if (BounceReads* reads = path_.record_->bounce_reads) reads->complete = false;
  if (path_.reads_maps()) {
    if (path_.settings_.maps->caustic)
      sum += irradiance_at(*path_.settings_.maps->caustic, at, at.geometric_normal,
                           path_.settings_.maps->caustic_lookup);
    if (const SharpPhotons* rarely_found = path_.settings_.maps->rarely_found)
      sum += irradiance_at(rarely_found->map, at, at.geometric_normal, rarely_found->lookup);
    LightParts parts;
    if (const auto found = path_.mapped_irradiance(at, normal, parts)) return sum + *found;
  }
  const bool more =
      path_.settings_.indirect && path_.depth_.diffuse_bounces < path_.settings_.diffuse_bounces;
  if (!more || path_.depth_.nested >= kMaxNested) return sum;
  const float chance = path_.depth_.bounces < kRouletteDepth ? 1.0f : kSurvival;
  if (stream.next_1d() >= chance) return sum;
  const Vec3 w = Frame(normal).to_world(sampling::sample_cosine_hemisphere(stream.next_2d()));
  if (dot(w, at.geometric_normal) <= 0) return sum;

  PathRecord record({}, path_.record_->user_buffers);
  Path sub = sub_path(stream, record);
  sub.way_.kind = RayKind::FinalGather;
  sub.caustics_ = path_.maps_read_here();
  sub.depth_.after_diffuse = true;
  sub.way_.blurred = false;
  sub.depth_.reflections = sub.depth_.refractions = 0;
  ++sub.depth_.bounces;
  ++sub.depth_.diffuse_bounces;
  sub.way_.cone.spread = kDiffuseSpread;
  sub.from_.weighed = true;  // no lights were sampled: they are invisible to the ray
  sub.eye_hit_.eye = at.position;
  sub.follow(at, w);
  sub.way_.medium.begin_in(volume_around(path_.world_, sub.way_.ray));
  sub.walk();
  return sum + path_.indirect_factor() * record.radiance * (kPi / chance);
}

Rgba PathForShaders::shade(const NodeList& surface, ShadingPoint& point, AovValues* aovs,
                           const sampling::Sampler& stream) const {
  static const Material kNone;
  if (path_.depth_.nested >= kMaxNested) return Rgba(0, 0, 0, 1);
  const Material& material = point.material ? *point.material : kNone;
  PathRecord record({.aovs = aovs != nullptr}, path_.record_->user_buffers);
  Path sub = sub_path(stream, record);
  sub.grid_ = path_.grid_;
  sub.depth_.vertex = path_.depth_.vertex;
  sub.visitor_ = path_.visitor_;
  sub.aov_.fixed = aovs == nullptr;
  sub.way_.ray = path_.way_.ray;
  sub.way_.left = path_.way_.left;
  sub.way_.medium = path_.way_.medium;
  sub.way_.environment = path_.way_.environment;
  sub.from_ = path_.from_;
  if (point.instance >= 0)
    sub.visibility_ = path_.world_.instances[static_cast<std::size_t>(point.instance)].visibility;
  sub.sampler_.set_dimension(0);

  Closure closure;
  SceneTracer tracer(path_.world_, sub.sampler_, path_.counts_, &sub);
  Tracer* const outer = std::exchange(point.tracer, &tracer);
  oriel::shade(surface, point, closure);
  point.tracer = outer;
  bool continues = false;
  // Through a hole the alpha is that of what lies behind.
  const bool passes = sub.pass_straight(closure, material, point);
  sub.eye_hit_.pending = passes;
  sub.eye_hit_.alpha_open = !passes;
  if (!passes) record.alpha = closure.alpha;
  if (passes) {
    continues = true;
  } else if (sub.visitor_) {
    continues = sub.visitor_->on_surface(sub, closure, material, point);
  } else {
    if (aovs) sub.meet_first(closure);
    sub.add(sub.aov_.at_vertex(Aov::Added), closure.emission, sub.layer_of_rest());
    continues = closure.count > 0 && sub.shade_vertex(closure, material, point);
  }
  point.glossiness = ShadingPoint{}.glossiness;  // the caller is another material
  if (continues) {
    ++sub.depth_.vertex;
    sub.walk();
  }
  if (aovs) *aovs = *record.aovs;
  return Rgba(record.radiance.x, record.radiance.y, record.radiance.z, clamp01(record.alpha));
}

}  // namespace oriel
