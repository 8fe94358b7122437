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
  if (count_ > kMostWeighed) return lit_by(light) ? 1.0f / static_cast<float>(count_) : 0.0f;
  if (all_) return estimate_[light];
  return total_ > 0 ? estimate_[light] / total_ : 0;
}

float highlight_scale(const Closure& closure, const Light& light) {
  if (!light.visible) return closure.highlight_scale;
  // A visible light is reflected; its highlight comes on top only when the material asks.
  return closure.highlights_of_visible_lights ? 1 + closure.highlight_scale : 1;
}

Rgb direct_light(const World& world, ShadingPoint& point, const Closure& closure,
                 const LobeChoice& lobes, const LightChoice& lights, const DirectRequest& request,
                 sampling::Sampler& sampler, RayCounts& counts) {
  const Vec3 wo = point.wo();
  const bool shadows = takes_shadows(world, point);
  Rgb sum(0);
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
    const float scale = highlight_scale(closure, light);
    const Rgb diffuse = r.diffuse.for_lights(scale), glossy = r.glossy.for_lights(scale);
    const Rgb both = diffuse + glossy;
    if (is_black(both)) return;
    const Rgb arriving = s->irradiance / rate;
    if (!shadows || !s->shadow) {
      sum += both * arriving;
      return;
    }
    const Openness open = shadow_transmittance(world, point, s->wi, s->distance, counts);
    const auto weight = [&](float pdf) {
      return s->pdf > 0 ? light_sample_weight(request.estimator, s->pdf * rate, pdf) : 1.0f;
    };
    Rgb c = diffuse * open.all * weight(r.diffuse.pdf);
    if (request.rays_bend) {
      // Behind glass a ray of a glossy lobe meets only lights that are seen.
      const Rgb found = light.visible && s->pdf > 0 ? r.glossy.highlight * scale : glossy;
      c += glossy * open.cut_outs * weight(r.glossy.pdf) + found * (open.clear - open.cut_outs);
    } else {
      c += glossy * open.all * weight(r.glossy.pdf);
    }
    // What the light lets pass opaque blockers, no ray would find.
    sum += (c + both * (Rgb(1) - open.all) * s->shadow_factor) * arriving;
  });
  if (request.environment) {
    const auto s = world.environment.sample(sampler.next_2d());
    const Response r = evaluate_closure(closure, lobes, point, wo, s.wi);
    const Rgb diffuse = r.diffuse.for_rays(), glossy = r.glossy.for_rays();
    if (!is_black(diffuse + glossy) && s.pdf > 0) {
      const Openness open =
          shadow_transmittance(world, point, s.wi, std::numeric_limits<float>::infinity(), counts);
      const Rgb c =
          diffuse * open.all * light_sample_weight(request.estimator, s.pdf, r.diffuse.pdf) +
          glossy * (request.rays_bend ? open.cut_outs : open.all) *
              light_sample_weight(request.estimator, s.pdf, r.glossy.pdf);
      if (!is_black(c)) {
        const Rgb radiance = rgb(environment_radiance(world.environment.shaders(), world,
                                                      point.position, s.wi, RayKind::FinalGather));
        ++counts.environment;
        sum += c * radiance / s.pdf;
      }
    }
  }
  return sum;
}

}  // namespace oriel
