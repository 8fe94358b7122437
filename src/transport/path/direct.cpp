// SPDX-License-Identifier: Apache-2.0
#include "transport/path/direct.h"

#include "lights/portal_table.h"
#include "runtime/environment_ray.h"
#include "transport/indirect_caches.h"
#include "transport/shadow.h"

namespace oriel {
namespace {

/// Sums the samples of one vertex.
class DirectSum {
 public:
  DirectSum(const World& world, ShadingPoint& point, const Closure& closure,
            const LobeChoice& lobes, const LitVertex& lights, const DirectRequest& request,
            RayCounts& counts, DirectShares* shares)
      : world_(world),
        sampler_(*world.light_sampler),
        point_(point),
        closure_(closure),
        lobes_(lobes),
        lights_(lights),
        request_(request),
        counts_(counts),
        shares_(shares),
        wo_(point.wo()),
        shadows_(receives_shadows(world, point)) {}

  /// One sample of a light.
  void add_light(const LightPick& pick, const Vec2& u);
  /// One sample of the environment, or none at random.
  void add_environment(const Vec2& u);
  const DirectLight& sum() const { return sum_; }

 private:
  void tell(int light, const Vec3& wi, float reach, const Rgb& unshadowed, const Rgb& open) const {
    if (request_.observer)
      request_.observer->on_light_sample(request_.place, point_,
                                         {light, wi, reach, unshadowed, open});
  }

  /// MIS weight of a light that LitSurfaces samples as well.
  float found_by_ray(int light, const Vec3& wi) const {
    const BesideLitSurfaces& beside = request_.beside;
    const float density = beside.surfaces->density(light, point_.position, wi);
    if (!(density > 0)) return 1;
    // The normal faces the viewer, and LitSurfaces must find the lit side.
    const float pdf = density * dot(point_.geometric_normal, wi) * beside.area_per_angle;
    if (!(pdf > 0)) return 1;
    return bsdf_sample_weight(request_.estimator, beside.pdf, pdf);
  }

  const World& world_;
  const LightSampler& sampler_;
  ShadingPoint& point_;
  const Closure& closure_;
  const LobeChoice& lobes_;
  const LitVertex& lights_;
  const DirectRequest& request_;
  RayCounts& counts_;
  DirectShares* shares_;
  Vec3 wo_;
  bool shadows_;
  DirectLight sum_;
};

void DirectSum::add_light(const LightPick& pick, const Vec2& u) {
  const int index = pick.light;
  const Light& light = world_.lights[static_cast<std::size_t>(index)];
  const auto s = sampler_.sample_picked(pick, point_, u);
  if (!s) return;
  const bool mirrored =
      light.visible && !closure_.highlights_of_visible_lights && !s->force_specular;
  Response r = evaluate_closure(closure_, lobes_, point_, wo_, s->wi, mirrored);
  // The light's factors for diffuse and specular lobes.
  r.diffuse.value *= s->affects_diffuse;
  for (Rgb* specular : {&r.reflection.value, &r.refraction.value, &r.highlight})
    *specular *= s->affects_specular;
  const bool looked_through = light.portal && !light.portal->visible;
  const LightInReflection in =
      looked_through ? hidden_portal_in_reflection(closure_)
                     : light_in_reflection(closure_, light.visible, s->force_specular);
  if (looked_through) r.refraction.value = Rgb(0);
  if (request_.mapped && request_.mapped->have_sharp(index, point_.instance, kByGloss))
    r.reflection.value = Rgb(0);
  const Rgb highlight = r.highlight * closure_.highlight_scale;
  const Rgb shown =
      r.diffuse.value + r.refraction.value + r.reflection.value * in.sum() + highlight;
  // Most surfaces have nothing else than their diffuse lobe.
  const bool specular =
      !is_black(r.reflection.value) || !is_black(r.refraction.value) || !is_black(r.highlight);
  if (is_black(shown)) return tell(index, s->wi, s->reach, Rgb(0), Rgb(1));
  const float kept = linear_fade(s->distance, request_.falloff_distance);
  DirectLight& sum =
      shares_ ? shares_->next(world_.light_layers.of_light[static_cast<std::size_t>(index)]) : sum_;
  Rgb arriving = s->irradiance;
  const bool blockable = shadows_ && s->shadow && s->shadow_factor == 0;
  if (request_.unblocked_only && !blockable) return;
  if (request_.beside.surfaces && blockable) arriving *= found_by_ray(index, s->wi);
  // Factor of tinted portals between the light and the point.
  Rgb view(1);
  if (request_.for_the_eye && world_.has_tinted_portals)
    view = portals_on_way(world_, point_.position, s->wi, s->distance * kShortOfPortal, point_.time)
               .view;
  if (request_.for_the_eye && light.portal && light.portal->visible)
    view *= light.portal->transparency;
  // Factors after shadows of light that rays could also find, and of light that they could not.
  const auto add = [&](const Rgb& diffuse, const Rgb& reflection, const Rgb& refraction,
                       const Rgb& highlights) {
    const bool behind = dot(s->wi, point_.geometric_normal) < 0;
    (behind ? sum.translucency : sum.diffuse) += r.diffuse.value * diffuse * arriving;
    if (!specular) return;
    sum.reflection += r.reflection.value * reflection * arriving * view * (in.as_reflection * kept);
    sum.specular +=
        (r.reflection.value * reflection * in.as_highlight + highlight * highlights) * arriving;
    sum.refraction += r.refraction.value * refraction * arriving * view;
  };
  if (!shadows_ || !s->shadow) {
    tell(index, s->wi, s->reach, shown * arriving, Rgb(1));
    return add(Rgb(1), Rgb(1), Rgb(1), Rgb(1));
  }

  const Transmittance open =
      request_.unblocked_only
          ? transparent_transmittance(world_, point_, s->wi, s->reach, counts_, index)
          : shadow_transmittance(world_, point_, s->wi, s->reach, counts_, index);
  tell(index, s->wi, s->reach, shown * arriving, open.all);
  // Light that rays of the lobe cannot find has weight 1.
  const auto weight = [&](const Response::Part& part, std::uint32_t shadowless) {
    if (!(s->pdf > 0) || is_black(part.value)) return 1.0f;
    if (hidden_from_rays(world_, point_, s->wi, s->reach, shadowless, counts_)) return 1.0f;
    return light_sample_weight(request_.estimator, s->pdf, part.pdf);
  };
  // Light that passes opaque objects cannot be found by rays.
  const Rgb leak = (Rgb(1) - open.all) * s->shadow_factor;
  const Rgb diffuse = open.all * weight(r.diffuse, geom::RayMask::ShadowlessFinalGather) + leak;
  if (!specular) return add(diffuse, Rgb(0), Rgb(0), Rgb(0));
  const Rgb straight = request_.rays_bend ? open.cut_outs : open.all;
  // Behind glass, rays of glossy lobes hit visible lights only.
  const bool bent_rays_find = light.visible && s->pdf > 0;
  const Rgb glass = request_.rays_bend ? open.clear - open.cut_outs : Rgb(0);
  const Rgb missed = (bent_rays_find ? Rgb(0) : glass) + leak;
  add(diffuse, straight * weight(r.reflection, geom::RayMask::ShadowlessReflection) + missed,
      straight * weight(r.refraction, geom::RayMask::ShadowlessRefraction) + missed,
      straight + glass + leak);
}

void DirectSum::add_environment(const Vec2& u) {
  const auto s =
      sampler_.sample_environment(lights_, u, request_.estimator == Estimator::LightOnly);
  if (!s) return;
  Response r = evaluate_closure(closure_, lobes_, point_, wo_, s->wi);
  if (!request_.environment_on_diffuse) r.diffuse.value = Rgb(0);
  Rgb reflection = request_.environment_in_reflections ? r.reflection.value : Rgb(0);
  if (!sampler_.portals().empty()) {
    const PortalsOnWay way =
        portals_on_way(world_, point_.position, s->wi, std::numeric_limits<float>::infinity(),
                       point_.time, request_.portals_mapped);
    if (way.ends_diffuse) r.diffuse.value = Rgb(0);
    Rgb view(way.ends_view ? 0.0f : 1.0f);
    if (request_.for_the_eye) view *= way.view;
    reflection *= view;
    r.refraction.value *= view;
  }
  if (!(s->pdf > 0) || is_black(r.diffuse.value + reflection + r.refraction.value)) return;
  const Transmittance open =
      shadow_transmittance(world_, point_, s->wi, std::numeric_limits<float>::infinity(), counts_);
  if (is_black(open.all) && !request_.observer) return;
  const Rgb straight = request_.rays_bend ? open.cut_outs : open.all;
  const Rgb radiance =
      sampler_.environment_radiance(
          {.origin = point_.position, .direction = s->wi, .raster = point_.raster}, *s) *
      volume_transmittance_to_light(world_, point_, s->wi, std::numeric_limits<float>::infinity());
  ++counts_.environment;
  constexpr float kFar = std::numeric_limits<float>::infinity();
  tell(-1, s->wi, kFar,
       (r.diffuse.value + reflection + r.refraction.value) * radiance * (1 / s->pdf), open.all);
  // Rays find the environment unless an object that they see occludes it, with or without shadow.
  const auto found = [&](const Rgb& value, float pdf, const Rgb& passes, std::uint32_t shadowless) {
    if (is_black(value) || hidden_from_rays(world_, point_, s->wi, kFar, shadowless, counts_))
      return Rgb(0);
    return value * passes * radiance *
           (light_sample_weight(request_.estimator, s->pdf, pdf) / s->pdf);
  };
  const bool behind = dot(s->wi, point_.geometric_normal) < 0;
  DirectLight& sum = shares_ ? shares_->next(world_.light_layers.environment) : sum_;
  (behind ? sum.environment_translucency : sum.environment) +=
      found(r.diffuse.value, r.diffuse.pdf, open.all, geom::RayMask::ShadowlessFinalGather);
  sum.reflection +=
      found(reflection, r.reflection.pdf, straight, geom::RayMask::ShadowlessReflection);
  sum.refraction +=
      found(r.refraction.value, r.refraction.pdf, straight, geom::RayMask::ShadowlessRefraction);
}

}  // namespace

Rgb light_of(const World& world, ShadingPoint& point, const Closure& closure, int light, Vec2 u,
             bool rays_bend, const IndirectCaches* mapped, RayCounts& counts) {
  const LitVertex at(world, point, closure);
  if (!(world.light_sampler->expected_samples(at, light) > 0)) return Rgb(0);
  const DirectRequest request{
      .rays_bend = rays_bend, .for_the_eye = rays_bend, .mapped = mapped, .unblocked_only = true};
  const LobeChoice lobes;
  DirectSum direct(world, point, closure, lobes, at, request, counts, nullptr);
  direct.add_light({light, 1}, u);
  const DirectLight& sum = direct.sum();
  return sum.diffuse + sum.translucency + sum.specular + sum.reflection + sum.refraction;
}

DirectLight direct_light(const World& world, ShadingPoint& point, const Closure& closure,
                         const LobeChoice& lobes, const LitVertex& lights,
                         const DirectRequest& request, sampling::Sampler& sampler,
                         RayCounts& counts, DirectShares* shares) {
  DirectSum direct(world, point, closure, lobes, lights, request, counts, shares);
  float u_light = 0;
  if (world.light_sampler->needs_random(lights))
    u_light = sampler.next_1d();
  else
    sampler.skip();
  world.light_sampler->sample(
      lights, u_light, [&](const LightPick& pick) { direct.add_light(pick, sampler.next_2d()); });
  if (lights.environment.samples > 0) direct.add_environment(sampler.next_2d());
  return direct.sum();
}

}  // namespace oriel
