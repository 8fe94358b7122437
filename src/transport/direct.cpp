// SPDX-License-Identifier: Apache-2.0
#include "transport/direct.h"

#include <algorithm>

#include "transport/shadow.h"

namespace oriel {
namespace {

/// Share of the mean estimate every light gets in addition: estimates ignore shadows and may be 0
/// where light arrives all the same.
constexpr float kLeastShare = 0.02f;

bool contains(const ArrayView<LightRef>& list, int light) {
  return std::any_of(list.begin(), list.end(), [&](LightRef l) { return l.index == light; });
}

}  // namespace

bool LightChoice::lit_by(int light) const {
  if (mode_ == 1) return contains(listed_, light);
  if (mode_ == 2) return !contains(listed_, light);
  if (mode_ == 0 && listed_.size > 0) return contains(listed_, light);
  if (!instance_ || !instance_->linked) return true;
  const std::vector<int>& linked = instance_->lights;
  const bool named = std::find(linked.begin(), linked.end(), light) != linked.end();
  return named != instance_->lights_exclusive;
}

LightChoice::LightChoice(const World& world, ShadingPoint& point, const Closure& closure)
    : world_(&world),
      instance_(point.instance < 0 ? nullptr
                                   : &world.instances[static_cast<std::size_t>(point.instance)]),
      mode_(closure.light_mode),
      listed_(closure.lights) {
  const int lights = static_cast<int>(world.lights.size());
  count_ = lights;
  all_ = lights <= kSampleAll;
  if (lights > kMostWeighed) return;
  for (int i = 0; i < lights; ++i) {
    estimate_[i] = 0;
    if (!lit_by(i)) continue;
    estimate_[i] = all_ ? 1 : estimate_irradiance(world.lights[static_cast<std::size_t>(i)], point);
    total_ += estimate_[i];
  }
  if (all_) return;
  const float least = kLeastShare * total_ / static_cast<float>(lights);
  total_ = 0;
  for (int i = 0; i < lights; ++i) {
    if (!lit_by(i)) continue;
    estimate_[i] = std::max(estimate_[i], std::max(least, 1e-20f));
    total_ += estimate_[i];
  }
}

float LightChoice::rate(int light) const {
  if (count_ == 0) return 0;
  if (count_ > kMostWeighed) return lit_by(light) ? 1.0f / static_cast<float>(count_) : 0.0f;
  if (all_) return estimate_[light];
  return total_ > 0 ? estimate_[light] / total_ : 0;
}

LightInReflection light_in_reflection(const Closure& closure, bool visible) {
  if (!visible) return {0, closure.highlight_scale};
  // A visible light is reflected; its highlight comes on top only when the material asks.
  return {1, closure.highlights_of_visible_lights ? closure.highlight_scale : 0};
}

DirectLight direct_light(const World& world, ShadingPoint& point, const Closure& closure,
                         const LobeChoice& lobes, const LightChoice& lights,
                         const DirectRequest& request, sampling::Sampler& sampler,
                         RayCounts& counts) {
  const Vec3 wo = point.wo();
  const bool shadows = takes_shadows(world, point);
  DirectLight sum;
  float u_light = 0;
  if (lights.draws())
    u_light = sampler.next_1d();
  else
    sampler.skip();
  lights.sample(u_light, [&](int index, float rate) {
    const Light& light = world.lights[static_cast<std::size_t>(index)];
    const auto s = sample_light(light, point, sampler.next_2d());
    if (!s) return;
    const Response r = evaluate_closure(closure, lobes, point, wo, s->wi,
                                        light.visible && !closure.highlights_of_visible_lights);
    const LightInReflection in = light_in_reflection(closure, light.visible);
    const Rgb highlight = r.highlight * closure.highlight_scale;
    if (is_black(r.diffuse.value + r.refraction.value + r.reflection.value * in.sum() + highlight))
      return;
    const float kept = linear_fade(s->distance, request.falloff_distance);
    const Rgb arriving = s->irradiance / rate;
    // Factors of what rays could have found and of what they could not, after shadows.
    const auto add = [&](const Rgb& diffuse, const Rgb& reflection, const Rgb& refraction,
                         const Rgb& highlights) {
      const bool behind = dot(s->wi, point.geometric_normal) < 0;
      (behind ? sum.translucency : sum.diffuse) += r.diffuse.value * diffuse * arriving;
      sum.reflection += r.reflection.value * reflection * arriving * (in.as_reflection * kept);
      sum.specular +=
          (r.reflection.value * reflection * in.as_highlight + highlight * highlights) * arriving;
      sum.refraction += r.refraction.value * refraction * arriving;
    };
    if (!shadows || !s->shadow) return add(Rgb(1), Rgb(1), Rgb(1), Rgb(1));

    const Openness open = shadow_transmittance(world, point, s->wi, s->distance, counts);
    const auto weight = [&](const Response::Part& part) {
      return s->pdf > 0 ? light_sample_weight(request.estimator, s->pdf * rate, part.pdf) : 1.0f;
    };
    // What the light lets pass opaque blockers, no ray would find.
    const Rgb leak = (Rgb(1) - open.all) * s->shadow_factor;
    const Rgb straight = request.rays_bend ? open.cut_outs : open.all;
    // Behind glass a ray of a glossy lobe meets only lights that are seen.
    const bool bent_rays_find = light.visible && s->pdf > 0;
    const Rgb glass = request.rays_bend ? open.clear - open.cut_outs : Rgb(0);
    const Rgb missed = (bent_rays_find ? Rgb(0) : glass) + leak;
    add(open.all * weight(r.diffuse) + leak, straight * weight(r.reflection) + missed,
        straight * weight(r.refraction) + missed, straight + glass + leak);
  });
  if (request.environment) {
    const auto s = world.environment.sample(sampler.next_2d());
    Response r = evaluate_closure(closure, lobes, point, wo, s.wi);
    if (!request.environment_on_diffuse) r.diffuse.value = Rgb(0);
    const Rgb reflection = request.environment_in_reflections ? r.reflection.value : Rgb(0);
    if (!is_black(r.diffuse.value + reflection + r.refraction.value) && s.pdf > 0) {
      const Openness open =
          shadow_transmittance(world, point, s.wi, std::numeric_limits<float>::infinity(), counts);
      const Rgb straight = request.rays_bend ? open.cut_outs : open.all;
      if (!is_black(open.all)) {
        const Rgb radiance = rgb(environment_radiance(world.environment.shaders(), world,
                                                      point.position, s.wi, RayKind::FinalGather));
        ++counts.environment;
        const auto found = [&](const Rgb& value, float pdf, const Rgb& passes) {
          return value * passes * radiance *
                 (light_sample_weight(request.estimator, s.pdf, pdf) / s.pdf);
        };
        const bool behind = dot(s.wi, point.geometric_normal) < 0;
        (behind ? sum.environment_translucency : sum.environment) +=
            found(r.diffuse.value, r.diffuse.pdf, open.all);
        sum.reflection += found(reflection, r.reflection.pdf, straight);
        sum.refraction += found(r.refraction.value, r.refraction.pdf, straight);
      }
    }
  }
  return sum;
}

}  // namespace oriel
