// SPDX-License-Identifier: Apache-2.0
#include "lights/photon_source.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/math.h"
#include "color/luminance.h"
#include "lights/light_sampler.h"
#include "lights/light_shape.h"
#include "lights/moved_light.h"
#include "lights/portal_table.h"
#include "runtime/environment.h"
#include "runtime/shutter_time.h"
#include "sampling/warp.h"

namespace oriel {
namespace {

constexpr float kFarAway = std::numeric_limits<float>::infinity();
/// Photons by which a shader's flux is known when `energy` replaces it.
constexpr int kFluxSamples = 4096;
/// Photons from afar begin this much outside of the scene, so that what lies on its rim is met.
constexpr float kOutside = 1.001f;

/// Cosine of the widest angle at which a light sends.
float least_cosine(const Light& light) { return light.spread < -1 ? -1.0f : light.spread; }

ShadingPoint lit_point(const World& world, const Vec3& position, const Vec3& direction) {
  ShadingPoint point;
  point.position = position;
  point.ray_direction = direction;
  point.normal = point.geometric_normal = -direction;
  point.world = &world;
  point.time = kAsWritten;
  return point;
}

/// Radiance of a flat light at its centre, at that cosine.
float flat_radiance(const World& world, const Light& light, float cosine, float distance) {
  const Frame frame(light.direction);
  const Vec3 direction = frame.to_world(Vec3(std::sqrt(1 - sqr(cosine)), 0, cosine));
  ShadingPoint point = lit_point(world, light.position + direction * distance, direction);
  const auto hit =
      intersect_light(light, point, -direction, kFarAway, RayKind::PhotonEmitGlobillum);
  return hit ? luminance(hit->radiance) : 0;
}

/// Whether a flat light's radiance grows toward grazing angles as it does when its shader has no
/// cosine; photons by the cosine would then carry very different powers.
bool lacks_cosine(const World& world, const Light& light) {
  constexpr float kSlant = 0.5f;  // radiance doubles there without a cosine
  const float distance = std::sqrt(light.area);
  const float cosine = std::max(kSlant, 0.5f + 0.5f * least_cosine(light));
  return flat_radiance(world, light, cosine, distance) * cosine >
         0.9f * flat_radiance(world, light, 1, distance);
}

}  // namespace

PhotonSource::PhotonSource(const World& world, const EmissionRequest& request) : world_(&world) {
  aim_at(request.aim);
}

PhotonSource::PhotonSource(const World& world, const Light& light, const EmissionRequest& request)
    : world_(&world), light_(&light) {
  aim_at(request.aim);
  // A portal's photons are as strong as what is behind it, whatever the element says.
  if (light.portal) return;
  if (is_flat(light.shape)) by_cosine_ = !lacks_cosine(world, light);
  by_emitter_ = light.emitter && light.emitter->spec().photon.emit;
  if (by_emitter_) {
    power_of_all_ = request.energy ? *request.energy * kPi : estimate_flux(kFluxSamples);
    return;
  }
  if (!request.energy) return;
  mean_luminance_ = luminance(estimate_flux(kFluxSamples));
  // By the same convention as a colour (runtime/light.h): physical_light sends pi times its colour.
  power_of_all_ = *request.energy * kPi;
}

void PhotonSource::aim_at(const std::optional<AimBox>& box) {
  const geom::Box3 scene = world_->accel->bounds();
  if (scene.isEmpty()) return;
  scene_centre_ = aim_centre_ = scene.center();
  scene_radius_ = aim_radius_ = length(scene.size()) / 2;
  if (!box) return;
  aim_centre_ = box->centre;
  aim_radius_ = 0;
  for (const Vec3& h : box->half) aim_radius_ += length(h);
  if (!light_ || light_->path.empty()) aim_ = box;
}

EmittedPhoton PhotonSource::emit_from_afar(const Vec3& direction, Vec2 u) const {
  if (aim_) return emit_through_silhouette(*aim_, direction, u);
  const Frame frame(direction);
  const Vec2 d = sampling::sample_disc(u) * aim_radius_;
  const Vec3 place = aim_centre_ + frame.s * d.x + frame.t * d.y;
  return {outside(place, direction), direction, kPi * sqr(aim_radius_), Vec2(0)};
}

/// The silhouette of a box is that of the three sides that face the light, which do not overlap: a
/// place on one of them, chosen by its area as the direction sees it.
EmittedPhoton PhotonSource::emit_through_silhouette(const AimBox& box, const Vec3& direction,
                                                    Vec2 u) const {
  float areas[3], all = 0;
  for (int k = 0; k < 3; ++k) {
    areas[k] = 4 * std::abs(dot(cross(box.half[(k + 1) % 3], box.half[(k + 2) % 3]), direction));
    all += areas[k];
  }
  if (!(all > 0)) return {box.centre, direction, 0, Vec2(0)};
  int side = 0;
  float at = u.x * all;
  while (side < 2 && at >= areas[side]) at -= areas[side++];
  while (side > 0 && !(areas[side] > 0)) --side;
  const float v = areas[side] > 0 ? std::min(at / areas[side], 1.0f) : 0.0f;
  const Vec3& out = box.half[side];
  const Vec3 place = box.centre + (dot(out, direction) > 0 ? -out : out) +
                     box.half[(side + 1) % 3] * (2 * v - 1) +
                     box.half[(side + 2) % 3] * (2 * u.y - 1);
  return {outside(place, direction), direction, all, Vec2(0)};
}

/// Back from a place, against the direction, to outside of the scene.
Vec3 PhotonSource::outside(const Vec3& place, const Vec3& direction) const {
  const float back = dot(scene_centre_ - place, direction) - scene_radius_ * kOutside;
  return place + direction * std::min(0.0f, back);
}

/// The direction first; then a place on the shape, uniform in the area that the direction sees, so
/// that all photons of a profile's light are equally strong.
EmittedPhoton PhotonSource::emit_by_profile(Vec2 u_place, Vec2 u_direction) const {
  const Light& light = *light_;
  const auto s = light.profile_placement.profile->sample(u_direction);
  EmittedPhoton photon;
  photon.origin = light.position;
  photon.direction = light.profile_placement.to_world(s.direction);
  if (!(s.pdf > 0)) return photon;
  const auto place = point_seen_along(light, photon.direction, u_place);
  if (!place) return photon;
  photon.origin = place->position;
  photon.weight = place->area / s.pdf;
  return photon;
}

EmittedPhoton PhotonSource::emit_by_shader(Vec2 u_place, Vec2 u_direction, RayKind kind) const {
  /// Takes what the shader sends. Its energies are as colours of lights: pi times less than power.
  class Emission final : public PhotonEmission {
   public:
    Emission(const Rgb& power, Vec2 u_place, Vec2 u_direction, EmittedPhoton& photon)
        : energy_(power * kInvPi), u_{u_direction, u_place}, photon_(photon) {}
    Rgb energy() const override { return energy_; }
    void send(const Rgb& energy, const Vec3& origin, const Vec3& direction) override {
      if (!is_finite(energy) || !is_finite(origin) || !is_finite(direction)) return;
      photon_.origin = origin;
      photon_.direction = direction;
      photon_.sent = energy * kPi;
    }
    Vec2 next() override {
      if (drawn_ < 2) return u_[drawn_++];
      // More than a light needs: told from each other by their order.
      const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
      if (!further_)
        further_.emplace(0, 0, 0,
                         static_cast<std::uint32_t>(sampling::mix_bits(
                             bits(u_[0].x) << 32 ^ bits(u_[0].y) ^ bits(u_[1].x) << 16)));
      return further_->next_2d();
    }

   private:
    Rgb energy_;
    Vec2 u_[2];
    int drawn_ = 0;
    std::optional<sampling::Sampler> further_;
    EmittedPhoton& photon_;
  };
  const Light& light = *light_;
  EmittedPhoton photon;
  photon.origin = light.position;
  photon.direction = light.direction;
  photon.kind = kind;
  Emission emission(*power_of_all_, u_place, u_direction, photon);
  ShadingPoint point = lit_point(*world_, light.position, light.direction);
  point.ray_kind = kind;
  light.emitter->with_params(
      point, [&](const Call& call) { light.emitter->spec().photon.emit(call, light, emission); });
  return photon;
}

EmittedPhoton PhotonSource::emit(Vec2 u_place, Vec2 u_direction, RayKind kind) const {
  if (by_emitter_) return emit_by_shader(u_place, u_direction, kind);
  EmittedPhoton photon = emit_by_light(u_place, u_direction);
  photon.kind = kind;
  return photon;
}

EmittedPhoton PhotonSource::emit_by_light(Vec2 u_place, Vec2 u_direction) const {
  if (!light_) {
    const EnvironmentLight::Sample s =
        world_->light_sampler->environment().sample_alone(u_direction);
    EmittedPhoton photon = emit_from_afar(-s.wi, u_place);
    photon.weight /= s.pdf;
    return photon;
  }
  const Light& light = *light_;
  if (light.shape == LightShape::Directional) {
    ShadingPoint point = lit_point(*world_, aim_centre_, light.direction);
    const auto s = sample_light(light, point, u_direction);
    EmittedPhoton photon = emit_from_afar(s ? -s->wi : light.direction, u_place);
    photon.u = u_direction;
    return photon;
  }

  if (light.profile_placement) return emit_by_profile(u_place, u_direction);
  EmittedPhoton photon;
  float cone = 1 - std::min(least_cosine(light), 1.0f);  // 1 - its cosine
  if (light.shape == LightShape::Point) {
    photon.origin = light.position;
    photon.direction = Frame(light.direction).to_world(sampling::sample_cone(u_direction, cone));
    photon.weight = kTwoPi * cone;
    return photon;
  }
  const auto [place, normal, area] = point_on_shape(light, u_place);
  photon.origin = place;
  if (light.portal && light.portal->table) {
    const PortalDirection d = sample_portal_direction(light, u_direction);
    photon.direction = -d.outward;
    photon.weight = d.pdf > 0 ? area * dot(photon.direction, normal) / d.pdf : 0;
    photon.origin -= photon.direction * light.portal->shadow_extension;
    return photon;
  }
  // A spread limits flat lights around their normal, round ones not around every normal.
  cone = is_flat(light.shape) ? std::min(cone, 1.0f) : 1.0f;
  Vec3 local;
  if (by_cosine_) {
    const float sin2 = cone * (2 - cone);
    const Vec2 d = sampling::sample_disc(u_direction) * std::sqrt(sin2);
    local = Vec3(d.x, d.y, std::sqrt(std::max(1e-12f, 1 - d.x * d.x - d.y * d.y)));
    photon.weight = area * kPi * sin2;
  } else {
    local = sampling::sample_cone(u_direction, cone);
    photon.weight = area * kTwoPi * cone * local.z;
  }
  photon.direction = Frame(normal).to_world(local);
  if (light.portal) photon.origin -= photon.direction * light.portal->shadow_extension;
  return photon;
}

Rgb PhotonSource::power_by_shader(const EmittedPhoton& photon, float distance) const {
  if (!light_ || is_at_rest(*light_, photon.time) || light_->shape == LightShape::Directional)
    return power_at_rest(photon, distance, nullptr);
  const MovedLight moved(*light_, photon.time);
  const Rgb power = power_at_rest(photon, distance / moved.stretch(photon.direction), &moved);
  return has_extent(light_->shape) ? power * moved.flux(photon.direction) : power;
}

/// `moved`: where the light is in truth, null: where it is written.
Rgb PhotonSource::power_at_rest(const EmittedPhoton& photon, float distance,
                                const MovedLight* moved) const {
  if (!(scene_radius_ > 0) || !(distance > 0)) return Rgb(0);
  if (!light_) {
    if (!world_->light_sampler->environment().lights()) return Rgb(0);
    return world_->light_sampler->environment_radiance(
               {.origin = aim_centre_, .direction = -photon.direction}) *
           photon.weight;
  }
  const Light& light = *light_;
  ShadingPoint point =
      lit_point(*world_, photon.origin + photon.direction * distance, photon.direction);
  if (light.shape == LightShape::Point || light.shape == LightShape::Directional) {
    const auto s = sample_light(light, point, photon.u, photon.kind);
    if (!s) return Rgb(0);
    const float spreads = light.shape == LightShape::Point ? sqr(s->distance) : 1.0f;
    return s->irradiance * (spreads * photon.weight);
  }
  if (light.portal) {
    // Nothing arrives on this side of where it begins, inside or out.
    const float cosine = dot(photon.direction, light.direction);
    const float way = dot(point.position - light.position, light.direction) / cosine;
    if (!(way > 0) || !(cosine > 0)) return Rgb(0);
    const Vec3 from = moved ? moved->place(point.position) : point.position;
    const Vec3 direction = moved ? moved->direction(photon.direction) : photon.direction;
    return portal_radiance(light, from, -direction, way, cosine) * photon.weight;
  }
  auto hit = intersect_light(light, point, -photon.direction, kFarAway, photon.kind);
  if (!hit) {
    // Rounding may pass the rim of the shape: look a little farther in.
    constexpr float kInward = 1e-3f;
    Vec3 centre = light.position;
    if (light.shape == LightShape::Cylinder)
      centre += light.edge_u * (dot(photon.origin - light.position, light.edge_u) /
                                dot(light.edge_u, light.edge_u));
    const Vec3 inner = photon.origin + (centre - photon.origin) * kInward;
    hit = intersect_light(light, point, normalize(inner - point.position), kFarAway, photon.kind);
  }
  return hit ? hit->radiance * photon.weight : Rgb(0);
}

/// Near end of the first segment, as share of the scene's radius: what lies in the plane of an
/// area light does not stop its photons.
constexpr float kOffTheLight = 1e-5f;

geom::Ray PhotonSource::first_ray(EmittedPhoton& photon, const sampling::Sampler& sampler) const {
  geom::Ray ray;
  ray.org = photon.origin;
  ray.dir = photon.direction;
  ray.tnear = kOffTheLight * scene_radius_;
  ray.mask = geom::RayMask::FinalGather | geom::RayMask::Shadow | geom::RayMask::ShadowTransparent;
  ray.time = shutter_time(world_->shutter, sampler);
  photon.time = ray.time;
  if (!light_ || light_->path.empty()) return ray;
  const MovedLight moved(*light_, ray.time);
  ray.dir = moved.direction(photon.direction);
  if (light_->shape == LightShape::Directional && !by_emitter_) {
    // The disc turns about what it aims at: where such a light stands means nothing.
    const Vec3 from_aim = photon.origin - aim_centre_;
    const Vec3 across = from_aim - photon.direction * dot(from_aim, photon.direction);
    ray.org = outside(aim_centre_ + normalize(moved.way(across)) * length(across), ray.dir);
    return ray;
  }
  ray.org = moved.place(photon.origin);
  return ray;
}

Rgb PhotonSource::power(const EmittedPhoton& photon, float distance) const {
  if (by_emitter_) return photon.sent;
  if (!power_of_all_) return power_by_shader(photon, distance);
  if (!(mean_luminance_ > 0)) return *power_of_all_;
  return *power_of_all_ * (luminance(power_by_shader(photon, scene_radius_)) / mean_luminance_);
}

Rgb PhotonSource::estimate_flux(int samples) const {
  Rgb sum(0);
  for (int i = 0; i < samples; ++i) {
    sampling::Sampler sampler(0, 0, static_cast<std::uint32_t>(i));
    const Vec2 u_place = sampler.next_2d();
    sum += power_by_shader(emit_by_light(u_place, sampler.next_2d()), scene_radius_) /
           static_cast<float>(samples);
  }
  return sum;
}

}  // namespace oriel
