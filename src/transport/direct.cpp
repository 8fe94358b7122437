// SPDX-License-Identifier: Apache-2.0
#include "transport/direct.h"

#include <algorithm>

#include "sampling/warp.h"
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

bool LightChoice::lit_by(const World& world, const ShadingPoint& point, const Closure& closure,
                         int i) const {
  if (closure.light_mode == 1) return contains(closure.lights, i);
  if (closure.light_mode == 2) return !contains(closure.lights, i);
  if (closure.light_mode == 0 && closure.lights.size > 0) return contains(closure.lights, i);
  if (point.instance < 0) return true;
  const InstanceData& instance = world.instances[static_cast<std::size_t>(point.instance)];
  if (!instance.linked) return true;
  const bool named = std::count(instance.lights.begin(), instance.lights.end(), i) > 0;
  return named != instance.lights_exclusive;
}

LightChoice::LightChoice(const World& world, ShadingPoint& point, const Closure& closure)
    : world_(&world) {
  const int lights = static_cast<int>(world.lights.size());
  count_ = lights;
  all_ = lights <= kSampleAll;
  if (lights > kMostWeighed) return;
  for (int i = 0; i < lights; ++i) {
    const auto index = static_cast<std::size_t>(i);
    estimate_[i] = 0;
    if (!lit_by(world, point, closure, i)) continue;
    estimate_[i] = all_ ? 1 : estimate_irradiance(world.lights[index], point);
    total_ += estimate_[i];
  }
  if (all_) return;
  const float least = kLeastShare * total_ / static_cast<float>(lights);
  total_ = 0;
  for (int i = 0; i < lights; ++i) {
    if (!lit_by(world, point, closure, i)) continue;
    estimate_[i] = std::max(estimate_[i], std::max(least, 1e-20f));
    total_ += estimate_[i];
  }
}

float LightChoice::rate(int light) const {
  if (count_ > kMostWeighed) return 1.0f / static_cast<float>(count_);
  if (all_) return estimate_[light];
  return total_ > 0 ? estimate_[light] / total_ : 0;
}

float highlight_scale(const Closure& closure, const Light& light) {
  if (!light.visible) return closure.highlight_scale;
  // A visible light is reflected; its highlight comes on top only when the material asks.
  return closure.highlights_of_visible_lights ? 1 + closure.highlight_scale : 1;
}

Rgb direct_light(const World& world, ShadingPoint& point, const Closure& closure,
                 const LobeChoice& lobes, const LightChoice& lights, bool with_environment,
                 sampling::Sampler& sampler, RayCounts& counts, Estimator estimator) {
  const Vec3 wo = point.wo();
  Rgb sum(0);
  const float u_light = sampler.next_1d();
  lights.sample(u_light, [&](int index, float rate) {
    const Light& light = world.lights[static_cast<std::size_t>(index)];
    const auto s = sample_light(light, point, sampler.next_2d());
    if (!s) return;
    const Response r = evaluate_closure(closure, lobes, point, wo, s->wi);
    Rgb c = r.for_lights(highlight_scale(closure, light)) * s->irradiance / rate;
    if (is_black(c)) return;
    if (s->pdf > 0) c *= light_sample_weight(estimator, s->pdf * rate, r.pdf);
    if (s->shadow) {
      const Rgb open = shadow_transmittance(world, point, s->wi, s->distance, counts);
      c *= open + (Rgb(1) - open) * s->shadow_factor;
    }
    sum += c;
  });
  if (with_environment) {
    const auto s = world.environment.sample(sampler.next_2d());
    const Response r = evaluate_closure(closure, lobes, point, wo, s.wi);
    const Rgb f = r.for_rays();
    if (!is_black(f) && s.pdf > 0) {
      const Rgb open =
          shadow_transmittance(world, point, s.wi, std::numeric_limits<float>::infinity(), counts);
      if (!is_black(open)) {
        const Rgb radiance = rgb(environment_radiance(world.environment.shaders(), world,
                                                      point.position, s.wi, RayKind::FinalGather));
        ++counts.environment;
        sum += f * radiance * open * (light_sample_weight(estimator, s.pdf, r.pdf) / s.pdf);
      }
    }
  }
  return sum;
}

}  // namespace oriel
