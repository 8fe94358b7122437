// SPDX-License-Identifier: Apache-2.0
// Paths that shaders ask for while a surface is shaded: rays, irradiance, other materials.
#include <utility>

#include "sampling/warp.h"
#include "transport/gather/gather_points.h"
#include "transport/path/path_walk.h"
#include "transport/scene_tracer.h"

namespace oriel {
namespace {

/// Paths of shaders within paths of shaders; what lies deeper is black. Trace depths end most.
constexpr int kMostNested = 48;
/// Irradiance behind kRouletteDepth bounces is evaluated by chance: shaders do not say how much of
/// it they reflect, so that nothing else would end the recursion.
constexpr float kSurvival = 0.5f;  ///< a guess between the depth of white and of dark rooms

}  // namespace

Tracer::Depth Path::depth() const {
  return {reflections_, refractions_, std::min(1.0f, importance_)};
}

/// A path that goes on from this vertex for itself: its radiance is what it sees, unweighed.
Path Path::sub_path(const sampling::Sampler& stream, PathRecord& record) const {
  sampling::Sampler own = stream;
  Path sub(world_, raster_, settings_, record, own, counts_);
  sub.grid_ = nullptr;
  sub.vertex_ = vertex_ + 1;
  sub.nested_ = nested_ + 1;
  sub.visited_ = visited_;
  sub.cone_ = cone_;
  sub.kind_ = kind_;
  sub.blurred_ = blurred_;
  sub.after_diffuse_ = after_diffuse_;
  sub.aov_fixed_ = true;
  sub.features_seen_ = true;
  sub.off_maps_ = off_maps_;
  sub.importance_ = importance_;
  sub.reflections_ = reflections_;
  sub.refractions_ = refractions_;
  sub.bounces_ = bounces_;
  sub.diffuse_bounces_ = diffuse_bounces_;
  return sub;
}

Tracer::Seen Path::trace_for_shader(const ShadingPoint& point, const Tracer::SubRay& ray,
                                    const sampling::Sampler& stream) const {
  Tracer::Seen seen;
  if (nested_ >= kMostNested) return seen;
  PathRecord record({}, record_->user_buffers);
  Path sub = sub_path(stream, record);
  sub.kind_ = ray.kind;
  sub.reflections_ = ray.depth.reflections;
  sub.refractions_ = ray.depth.refractions;
  sub.importance_ = ray.depth.importance;
  sub.reach_ = ray.reach;
  sub.met_ = &seen.met;
  if (point.material && !point.material->environment.empty())
    sub.environment_ = &point.material->environment;
  ShadingPoint from = point;
  if (!ray.from_surface) {
    from.position = ray.origin;
    from.ray_offset = 0;
  }
  sub.eye_ = from.position;
  sub.follow(from, ray.direction);
  sub.walk();
  seen.colour = Rgba(record.radiance.x, record.radiance.y, record.radiance.z, record.alpha);
  return seen;
}

Rgb Path::irradiance_for_shader(const ShadingPoint& point, const Vec3& normal,
                                sampling::Sampler stream) const {
  ShadingPoint at = point;
  at.geometric_normal = facing(point.geometric_normal, normal);
  if (at.geometric_normal != point.geometric_normal) at.back_side = !at.back_side;
  at.normal = normal;
  if (visited_) {
    visited_->push_back({at, normal});
    return Rgb(0);
  }
  Rgb sum(0);
  if (reads_maps()) {
    if (settings_.maps->caustic)
      sum += irradiance_at(*settings_.maps->caustic, at, at.geometric_normal,
                           settings_.maps->caustic_lookup);
    LightParts parts;
    if (const auto found = mapped_irradiance(at, normal, parts)) return sum + *found;
  }
  const bool more = settings_.indirect && diffuse_bounces_ < settings_.diffuse_bounces;
  if (!more || nested_ >= kMostNested) return sum;
  const float chance = bounces_ < kRouletteDepth ? 1.0f : kSurvival;
  if (stream.next_1d() >= chance) return sum;
  const Vec3 w = Frame(normal).to_world(sampling::sample_cosine_hemisphere(stream.next_2d()));
  if (dot(w, at.geometric_normal) <= 0) return sum;

  PathRecord record({}, record_->user_buffers);
  Path sub = sub_path(stream, record);
  sub.kind_ = RayKind::FinalGather;
  sub.after_diffuse_ = true;
  sub.blurred_ = false;
  sub.reflections_ = sub.refractions_ = 0;
  ++sub.bounces_;
  ++sub.diffuse_bounces_;
  sub.cone_.spread = kDiffuseSpread;
  sub.from_.weighed = true;  // against no lights: it passes through them unseen
  sub.eye_ = at.position;
  sub.follow(at, w);
  sub.walk();
  return sum + indirect_factor() * record.radiance * (kPi / chance);
}

Rgba Path::shade_for_shader(const NodeList& surface, ShadingPoint& point, AovValues* aovs,
                            const sampling::Sampler& stream) const {
  static const Material kNone;
  if (nested_ >= kMostNested) return Rgba(0, 0, 0, 1);
  const Material& material = point.material ? *point.material : kNone;
  PathRecord record({.aovs = aovs != nullptr}, record_->user_buffers);
  Path sub = sub_path(stream, record);
  sub.grid_ = grid_;
  sub.vertex_ = vertex_;
  sub.grid_point_ = grid_point_;
  sub.grid_density_ = grid_density_;
  sub.aov_fixed_ = aovs == nullptr;
  sub.ray_ = ray_;
  sub.left_ = left_;
  sub.medium_ = medium_;
  sub.environment_ = environment_;
  sub.from_ = from_;
  if (point.instance >= 0)
    sub.visibility_ = world_.instances[static_cast<std::size_t>(point.instance)].visibility;
  sub.sampler_.set_dimension(0);

  Closure closure;
  SceneTracer tracer(world_, sub.sampler_, counts_, &sub);
  Tracer* const outer = std::exchange(point.tracer, &tracer);
  oriel::shade(surface, point, closure);
  point.tracer = outer;
  bool goes_on = false;
  // Through a hole the alpha is that of what lies behind.
  const bool passes = sub.pass_straight(closure, material, point);
  sub.first_ = passes;
  sub.alpha_open_ = !passes;
  if (!passes) record.alpha = closure.alpha;
  if (passes) {
    goes_on = true;
  } else if (sub.visited_) {
    goes_on = sub.note_gather_point(closure, material, point);
  } else if (sub.grid_point_) {
    sub.fill_grid_point(closure, material, point);
  } else {
    if (aovs) sub.meet_first(closure);
    sub.add(sub.at_vertex(Aov::Added), closure.emission, sub.layer_of_rest());
    goes_on = closure.count > 0 && sub.shade_vertex(closure, material, point);
  }
  point.glossiness = ShadingPoint{}.glossiness;  // the caller is another material
  if (goes_on) {
    ++sub.vertex_;
    sub.walk();
  }
  if (aovs) *aovs = *record.aovs;
  return Rgba(record.radiance.x, record.radiance.y, record.radiance.z, clamp01(record.alpha));
}

}  // namespace oriel
