// SPDX-License-Identifier: Apache-2.0
#include "transport/path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "color/luminance.h"
#include "sampling/warp.h"
#include "transport/direct.h"
#include "transport/lobes.h"
#include "transport/shadow.h"
#include "transport/surface.h"

namespace oriel {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Vertices before a path may be ended by chance.
constexpr int kRouletteDepth = 3;
/// Vertices of any kind, cut-outs included, before a path is given up.
constexpr int kMostVertices = 256;
/// Draws reserved for each vertex, so that a vertex uses the same dimensions in every sample.
constexpr std::uint32_t kDrawsPerVertex = 12;
/// Spread a glossy bounce adds to the ray's cone, per unit of roughness (radians); a guess that
/// keeps textures sharper than the lobe is wide.
constexpr float kSpreadPerRoughness = 0.5f;
/// Spread after a diffuse bounce (radians): textures seen by final gather rays need no detail.
constexpr float kDiffuseSpread = 0.2f;

/// One path under way.
class Path {
 public:
  Path(const World& world, Vec2 raster, bool indirect, sampling::Sampler& sampler,
       RayCounts& counts, Estimator estimator)
      : world_(world),
        raster_(raster),
        indirect_(indirect),
        estimator_(estimator),
        sampler_(sampler),
        counts_(counts) {}

  PathResult run(const Camera::Ray& eye);

 private:
  /// Where the ray came from, to weigh lights and environment it meets.
  struct Vertex {
    bool weighed = false;  ///< a non-delta vertex that sampled lights
    ShadingPoint point;
    LightChoice lights;
    bool environment_sampled = false;
    float pdf = 0;
    float highlight_scale = 1;  ///< for invisible lights
    float highlight_scale_visible = 1;
    bool shadows = true;
    float passed = 0;  ///< way of the ray since, through what let it pass straight
  };

  void meet_lights(float t_surface, bool& ended);
  void meet_environment();
  bool pass_straight(Closure& closure, const Material& material, ShadingPoint& point);
  void choose_lobes(const Closure& closure, LobeChoice& choice) const;
  void scatter(const Closure& closure, const Material& material, ShadingPoint& point,
               const ClosureSample& sample);
  bool depth_reached(LobeKind kind) const;
  std::uint32_t mask() const;
  void count_ray();
  void follow(const ShadingPoint& point, const Vec3& direction);
  bool gather(Closure& closure, const Material& material, ShadingPoint& point);
  bool survive();
  /// Rays that go straight through glass are dimmed by it only where shadow rays are.
  bool straight_rays_fade() const { return world_.options.shadow == scene::ShadowMode::Segments; }

  const World& world_;
  Vec2 raster_;
  bool indirect_;
  Estimator estimator_;
  sampling::Sampler& sampler_;
  RayCounts& counts_;

  PathResult result_;
  geom::Ray ray_;
  RayCone cone_;
  RayKind kind_ = RayKind::Eye;
  bool blurred_ = false;
  bool after_diffuse_ = false;
  bool first_ = true;           ///< no surface has been seen yet
  bool features_seen_ = false;  ///< normal and albedo are those of a surface that scatters
  Rgb throughput_{1};
  Rgb plain_{1}, reflective_{0}, highlight_{0};  ///< of the last scattering, for lights
  Vertex from_;
  const NodeList* environment_ = nullptr;
  Medium medium_;
  Vec3 left_{0};  ///< where the ray left; its origin is a little off the surface, glass may be thin
  bool medium_known_ = false;
  int reflections_ = 0, refractions_ = 0, bounces_ = 0;
};

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
  const float reach =
      medium_known_ && medium_.black_distance > 0 ? medium_.black_distance : kInfinity;
  ray_ = leave(point, direction, reach, mask());
  left_ = point.position;
}

/// Lights with a shape that the ray meets before the surface. A visible light ends rays that see it
/// as an object (camera and mirrors); bundles only collect its weighed light and go on, since
/// lights do not shadow each other.
void Path::meet_lights(float t_surface, bool& ended) {
  const bool sees = !from_.weighed;
  float nearest = t_surface;
  ShadingPoint origin;
  origin.position = ray_.org;
  origin.world = &world_;
  Rgb seen(0);
  for (std::size_t i = 0; i < world_.lights.size(); ++i) {
    const Light& light = world_.lights[i];
    if (light.shape == LightShape::Point || light.shape == LightShape::Directional) continue;
    if (sees && !light.visible) continue;
    if (sees) {
      const auto hit = intersect_light(light, origin, ray_.dir, nearest);
      if (!hit) continue;
      nearest = hit->t;
      seen = hit->radiance;
      ended = true;
      continue;
    }
    const float rate = from_.lights.rate(static_cast<int>(i));
    if (rate <= 0) continue;
    const auto hit = intersect_light(light, from_.point, ray_.dir, from_.passed + t_surface);
    if (!hit || hit->t < from_.passed || !hit->shadow || !from_.shadows) continue;
    const float scale = light.visible ? from_.highlight_scale_visible : from_.highlight_scale;
    const float weight = bsdf_sample_weight(estimator_, from_.pdf, hit->pdf * rate);
    result_.radiance += (plain_ + (reflective_ + highlight_) * scale) * hit->radiance *
                        transmittance(medium_, hit->t - from_.passed) * weight;
  }
  if (ended) {
    result_.radiance += throughput_ * seen * transmittance(medium_, nearest);
    if (first_) result_.alpha = 1;
  }
}

void Path::meet_environment() {
  const NodeList& shaders = environment_ ? *environment_ : world_.environment.shaders();
  if (shaders.empty()) return;
  ++counts_.environment;
  const Vec3 origin = ray_.org, direction = ray_.dir;
  const RayKind kind = after_diffuse_ ? RayKind::FinalGather : kind_;
  const Rgba c = environment_radiance(shaders, world_, origin, direction, kind, blurred_);
  if (first_) result_.alpha = clamp01(c.a);
  Rgb radiance = rgb(c);
  if (from_.weighed && from_.environment_sampled && !environment_) {
    // What the environment's own sampling can find is weighed; the rest (glow) stands alone.
    const float weight =
        bsdf_sample_weight(estimator_, from_.pdf, world_.environment.pdf(direction));
    if (kind == RayKind::FinalGather) {
      radiance *= weight;
    } else {
      const Rgb even =
          rgb(environment_radiance(shaders, world_, origin, direction, RayKind::FinalGather));
      radiance = radiance - even * (1 - weight);
    }
  }
  result_.radiance += throughput_ * radiance;
}

bool Path::depth_reached(LobeKind kind) const {
  const scene::TraceDepth& depth = world_.options.trace_depth;
  if (reflections_ + refractions_ >= depth.sum) return true;
  return transmits(kind) ? refractions_ >= depth.refraction : reflections_ >= depth.reflection;
}

void Path::choose_lobes(const Closure& closure, LobeChoice& choice) const {
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    choice.probability[i] = 0;
    if (lobe.controls.highlights_only || !world_.options.trace) continue;
    if (is_diffuse(lobe.kind) && !indirect_) continue;
    // Reflections beyond the material's own depth are highlights only.
    if (lobe.channel == Channel::Reflection && lobe.controls.depth > 0 &&
        reflections_ >= lobe.controls.depth)
      continue;
    choice.probability[i] = std::max(0.0f, luminance(lobe.level));
    choice.total += choice.probability[i];
  }
  if (choice.total > 0)
    for (int i = 0; i < closure.count; ++i) choice.probability[i] /= choice.total;
}

/// Cut-outs, and transparency as rays behind a diffuse bounce see it. True when the ray goes on
/// unbent, with the weights of the vertex it came from; when by chance it does not, the
/// transmitting lobes are taken out of the closure.
bool Path::pass_straight(Closure& closure, const Material& material, ShadingPoint& point) {
  const bool keeps_weights = material.may_transmit;
  float u = 0;
  if (closure.opacity < 1)
    u = sampler_.next_1d();
  else
    sampler_.skip();
  Rgb factor(0);
  const bool culled = !closure.seen_from_back && kind_ == RayKind::Eye && point.back_side;
  if (culled) {
    factor = Rgb(1);
  } else if (u >= closure.opacity) {
    factor = Rgb(1);  // chosen with probability 1 - opacity
  } else if (after_diffuse_ && keeps_weights &&
             !(closure.refractive_caustics && world_.options.caustic.on)) {
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
  throughput_ *= factor;
  plain_ *= factor;
  reflective_ *= factor;
  highlight_ *= factor;
  if (!keeps_weights) from_.weighed = false;
  if (!culled && u < closure.opacity && !closure.thin_walled) {
    medium_ = point.back_side || !straight_rays_fade() ? Medium{} : closure.inside;
    medium_known_ = true;
  }
  from_.passed += point.ray_length;
  follow(point, ray_.dir);
  return true;
}

void Path::scatter(const Closure& closure, const Material& material, ShadingPoint& point,
                   const ClosureSample& sample) {
  const Lobe& lobe = closure.lobes[sample.lobe];
  const bool crosses = dot(sample.wi, point.geometric_normal) < 0;
  if (!closure.thin_walled) {
    if (crosses) {
      medium_ = point.back_side ? Medium{} : closure.inside;
      medium_known_ = true;
    } else if (point.back_side && !medium_known_) {
      medium_ = closure.inside;
      medium_known_ = true;
    }
  }
  switch (lobe.kind) {
    case LobeKind::Diffuse:
    case LobeKind::Translucency:
      kind_ = RayKind::FinalGather;
      after_diffuse_ = true;
      blurred_ = false;
      reflections_ = refractions_ = 0;
      if (!straight_rays_fade()) medium_ = Medium{}, medium_known_ = true;
      cone_.spread = std::max(cone_.spread, kDiffuseSpread);
      ++bounces_;
      break;
    case LobeKind::Mirror:
    case LobeKind::GlossyReflection:
      kind_ = RayKind::Reflect;
      ++reflections_;
      break;
    case LobeKind::ThinTransmission:
    case LobeKind::GlossyThin:
      kind_ = RayKind::Transparent;
      ++refractions_;
      break;
    default:
      // Total reflection on the inside stays a refraction of the material, as its level is.
      kind_ = crosses ? RayKind::Refract : RayKind::Reflect;
      ++refractions_;
      break;
  }
  if (!sample.delta && kind_ != RayKind::FinalGather) {
    blurred_ = true;
    cone_.spread += kSpreadPerRoughness * std::max(lobe.alpha_x, lobe.alpha_y);
    ++bounces_;
  }
  plain_ = throughput_ * sample.response.plain;
  reflective_ = throughput_ * sample.response.reflective;
  highlight_ = throughput_ * sample.response.highlight;
  throughput_ = plain_ + reflective_;
  environment_ = material.environment.empty() ? nullptr : &material.environment;
  from_.weighed = !sample.delta;
  from_.pdf = sample.pdf;
  from_.passed = 0;
  follow(point, sample.wi);
}

bool Path::survive() {
  if (bounces_ < kRouletteDepth) return max_component(throughput_) > 0;
  const float p = clamp(max_component(throughput_), 0.05f, 0.95f);
  if (sampler_.next_1d() >= p) return false;
  throughput_ /= p;
  plain_ /= p;
  reflective_ /= p;
  highlight_ /= p;
  return true;
}

/// Light at a vertex and the way on from it. False: the path ends here.
bool Path::gather(Closure& closure, const Material& material, ShadingPoint& point) {
  LobeChoice choice;
  make_ready(closure, point.wo());
  choose_lobes(closure, choice);
  std::construct_at(&from_.lights, world_, point, closure);  // in place: it is large
  const bool environment = indirect_ && world_.environment.lights() && material.environment.empty();
  bool scatters_light = false;
  for (int i = 0; i < closure.count; ++i)
    if (!is_delta(closure.lobes[i].kind)) scatters_light = true;
  if (scatters_light && !features_seen_ && !from_.weighed) {
    features_seen_ = true;
    result_.normal = point.normal;
    result_.albedo = closure.albedo;
  }
  if (scatters_light && (!from_.lights.empty() || environment))
    result_.radiance += throughput_ * direct_light(world_, point, closure, choice, from_.lights,
                                                   {.environment = environment,
                                                    .rays_bend = !after_diffuse_,
                                                    .estimator = estimator_},
                                                   sampler_, counts_);
  if (choice.total <= 0) return false;

  const float u_lobe = sampler_.next_1d();
  const auto sample =
      sample_closure(closure, choice, point, point.wo(), u_lobe, sampler_.next_2d());
  if (!sample) return false;
  const Lobe& lobe = closure.lobes[sample->lobe];
  // The material's own refraction depth ends in black, the scene's depth in the environment.
  if (transmits(lobe.kind) && lobe.controls.depth > 0 && refractions_ >= lobe.controls.depth)
    return false;
  const bool too_deep = !is_diffuse(lobe.kind) && depth_reached(lobe.kind);

  if (world_.has_area_lights) from_.point = point;
  from_.environment_sampled = environment;
  from_.shadows = takes_shadows(world_, point);
  from_.highlight_scale = closure.highlight_scale;
  from_.highlight_scale_visible =
      closure.highlights_of_visible_lights ? 1 + closure.highlight_scale : 1;
  scatter(closure, material, point, *sample);
  if (too_deep) {
    bool seen = false;
    if (world_.has_area_lights) meet_lights(kInfinity, seen);
    if (!seen) meet_environment();
    return false;
  }
  return survive();
}

PathResult Path::run(const Camera::Ray& eye) {
  ray_.org = left_ = eye.origin;
  ray_.dir = eye.direction;
  const Camera& camera = world_.camera;
  ray_.tnear = camera.clip_near > 0 ? camera.clip_near / eye.cos_to_film : 0;
  ray_.tfar = camera.clip_far > 0 ? camera.clip_far / eye.cos_to_film : kInfinity;
  ray_.mask = mask();
  cone_ = {eye.width, eye.spread};

  for (int vertex = 0; vertex < kMostVertices; ++vertex) {
    sampler_.set_dimension(kDrawsPerVertex * static_cast<std::uint32_t>(vertex + 1));
    geom::Hit hit;
    count_ray();
    const bool found = world_.accel->intersect(ray_, hit);
    bool ended = false;
    if (world_.has_area_lights) meet_lights(found ? hit.t : ray_.tfar, ended);
    if (ended) break;
    if (!found) {
      // Nothing within the reach of a medium that turns black is black.
      if (std::isinf(ray_.tfar) || kind_ == RayKind::Eye) meet_environment();
      break;
    }

    ShadingPoint point;
    fill_point(world_, ray_, hit, cone_, kind_, point);
    point.raster = raster_;
    point.blurred = blurred_;
    cone_.width = cone_.width_at(hit.t);
    const Material& material = material_of(world_, hit);
    Closure closure;
    shade(material, point, closure);

    // Absorption on the way here: known from where the ray entered, or from the wall it ends at.
    if (!medium_known_ && point.back_side && !closure.thin_walled) medium_ = closure.inside;
    if (!medium_.clear()) {
      const Rgb t = transmittance(medium_, length(point.position - left_));
      throughput_ *= t;
      plain_ *= t;
      reflective_ *= t;
      highlight_ *= t;
    }
    if (pass_straight(closure, material, point)) continue;

    if (first_) {
      first_ = false;
      result_.alpha = 1;
      result_.depth = length(point.position - eye.origin);
      result_.normal = point.normal;
      result_.albedo = closure.albedo;
    }
    result_.radiance += throughput_ * closure.emission;
    if (closure.count == 0) break;

    if (!gather(closure, material, point)) break;
  }
  return result_;
}

}  // namespace

PathResult trace_path(const World& world, const Camera::Ray& eye, Vec2 raster, bool indirect,
                      sampling::Sampler& sampler, RayCounts& counts, Estimator estimator) {
  return Path(world, raster, indirect, sampler, counts, estimator).run(eye);
}

}  // namespace oriel
