// SPDX-License-Identifier: Apache-2.0
// The physical sun and sky: values that depend on the parameters only, and the lookup.
#include "sky/physical_sky.h"

#include "base/math.h"
#include "color/luminance.h"
#include "sky/daylight.h"

#include <algorithm>

namespace oriel::sky {
namespace {

constexpr float kClearTurbidity = 2;  // haze 0

float turbidity_of(float haze) { return clamp(2 + haze, kClearTurbidity, kMaxTurbidity); }

/// Direction in the space of the model: z up, with the horizon moved to z = 0. `horizon` is a tenth
/// of horizon_height. A direction that the shift reduces to zero is on the horizon, at an arbitrary
/// azimuth.
Vec3 seen_direction(const Vec3& direction, bool y_is_up, float horizon) {
  Vec3 d = z_up(direction, y_is_up);
  if (horizon == 0) return d;
  d.z -= horizon;
  return normalize(d);
}

/// Saturation after haze, which reduces values below 1 further. A value above 1 increases
/// saturation as documented (NVIDIA's port ignores it).
float effective_saturation(float saturation, float haze) {
  if (saturation <= 0) return 0;
  if (saturation > 1) return saturation;
  const float h = clamp01(haze / 15);
  return lerp(saturation, saturation * saturation * saturation, h * h * h);
}

Rgb not_negative(const Rgb& c) {
  return Rgb(std::max(c.x, 0.0f), std::max(c.y, 0.0f), std::max(c.z, 0.0f));
}

Rgb tinted(const Rgb& c, float saturation, float red, float blue) {
  const float y = luminance(c);
  return not_negative((Rgb(y) + (c - Rgb(y)) * saturation) * Rgb(red, 1, blue));
}

}  // namespace

float night_factor(float sun_z) {
  constexpr float kSin18Deg = 0.30901699f;
  if (sun_z >= 0) return 1;
  if (sun_z <= -kSin18Deg) return 0;
  return sqr(sqr((sun_z + kSin18Deg) / kSin18Deg));
}

Rgb sun_colour(const SunParameters& p, const Vec3& sun_direction) {
  if (!p.on || !(p.multiplier > 0)) return Rgb(0.0f);
  const Vec3 to_sun = seen_direction(normalize(sun_direction), p.y_is_up, p.horizon_height / 10);
  Rgb lux = sun_illuminance(to_sun.z, turbidity_of(p.haze), p.as_in_manual);
  if (const float own = luminance(lux); p.normal_illuminance && own > 0)
    lux *= std::max(0.0f, *p.normal_illuminance) / own;
  return tinted(lux * unit_conversion(p.rgb_unit_conversion, p.multiplier),
                effective_saturation(p.saturation, p.haze), 1 + p.redblueshift, 1 - p.redblueshift);
}

PhysicalSky::PhysicalSky(const SkyParameters& p)
    : model_(seen_direction(normalize(p.sun_direction), p.y_is_up, p.horizon_height / 10),
             turbidity_of(p.haze), p.model),
      black_(!p.on || !(p.multiplier > 0)),
      y_is_up_(p.y_is_up),
      horizon_(p.horizon_height / 10),
      inverse_blur_(p.horizon_blur > 0 ? 10 / p.horizon_blur : 0),
      to_sun_(seen_direction(normalize(p.sun_direction), p.y_is_up, horizon_)),
      saturation_(effective_saturation(p.saturation, p.haze)),
      red_(1 + p.redblueshift),
      blue_(1 - p.redblueshift),
      night_(not_negative(p.night_color)) {
  const Rgb units = unit_conversion(p.rgb_unit_conversion, p.multiplier);
  const float daylight = night_factor(to_sun_.z);
  const float sun_z = model_.to_sun().z;
  sky_scale_ = units * (p.luminance ? kPi : kPi * daylight);
  if (p.luminance) give_luminance(*p.luminance);
  sun_above_ = sun_illuminance(sun_z, turbidity_of(p.haze), p.as_in_manual) * units * daylight;
  sun_below_ =
      p.as_in_manual ? sun_above_ : sun_illuminance(sun_z, kClearTurbidity) * units * daylight;
  set_up_disc(p);

  // The ground is lit through clear air regardless of haze, as in NVIDIA's port. The manual says
  // "lit by the sun and sky only" (2.6); this is used if the luminance of the sky is given.
  const auto sky_over_ground = [&] {
    if (p.luminance) return horizontal_illuminance(model_);
    if (p.as_in_manual) return horizontal_illuminance(model_) * daylight;
    return horizontal_illuminance_25(PreethamSky(to_sun_, kClearTurbidity, p.model)) * daylight;
  };
  const Rgb sky = sky_over_ground();
  ground_raw_ = p.ground_color * (sky * units + sun_below_ * sun_z);
  ground_ = tinted(ground_raw_, saturation_, red_, blue_);
}

void PhysicalSky::set_night_color(const Rgb& color) { night_ = not_negative(color); }

void PhysicalSky::give_luminance(const GivenLuminance& given) {
  if (given.distribution != PerezCoefficients{}) model_.distribute(given.distribution);
  const auto scale_to = [&](float wanted, float present) {
    if (present > 1e-6f * wanted) model_.scale_luminance(wanted / present);
  };
  if (given.zenith > 0)
    scale_to(given.zenith, model_.xyy(Vec3(0, 0, 1)).luminance);
  else if (given.horizontal_illuminance > 0)
    scale_to(given.horizontal_illuminance, luminance(horizontal_illuminance(model_)));
}

void PhysicalSky::set_up_disc(const SkyParameters& p) {
  if (!(p.sun_disk_scale > 0)) return;
  const DiscScale scale =
      p.physically_scaled_sun
          ? physical_disc_scale(p.sun_disk_scale, p.sun_disk_intensity, p.sun_glow_intensity)
          : DiscScale{};
  glow_radius_ = 10 * kSunAngularRadius * p.sun_disk_scale;
  cos_glow_radius_ = glow_radius_ < kPi ? math::cos(glow_radius_) : -1;
  glow_ = std::max(p.sun_glow_intensity, 0.0f) * scale.glow;
  disc_ = std::max(p.sun_disk_intensity, 0.0f) * scale.disc;
  disc_edge_ = disc_softness_end(p.haze);
}

Vec3 PhysicalSky::seen(const Vec3& direction) const {
  return seen_direction(direction, y_is_up_, horizon_);
}

float PhysicalSky::disc_and_glow(const Vec3& seen_direction, SkyPart part) const {
  if (dot(seen_direction, to_sun_) < cos_glow_radius_) return 0;
  // Angle from the chord: the arc cosine is inaccurate this close to the sun.
  const float angle = 2 * math::asin(std::min(0.5f * length(seen_direction - to_sun_), 1.0f));
  const float f = 1 - angle / glow_radius_;
  if (f <= 0) return 0;
  const float glow = glow_ * glow_profile(f);
  return part == SkyPart::Everything ? glow + disc_ * disc_profile(f, disc_edge_) : glow;
}

Rgb PhysicalSky::finish(const Rgb& color, float night_share) const {
  const Rgb c = tinted(color, saturation_, red_, blue_);
  return Rgb(std::max(c.x, night_.x * night_share), std::max(c.y, night_.y * night_share),
             std::max(c.z, night_.z * night_share));
}

Rgb PhysicalSky::radiance(const Vec3& direction, SkyPart part) const {
  if (black_) return Rgb(0.0f);
  const Vec3 d = seen(direction);
  const bool below = d.z <= 0;

  // The share of the ground grows from the horizon over the width of the blur.
  float groundness = 0;
  if (below) {
    if (inverse_blur_ == 0 || -d.z * inverse_blur_ >= 1) return ground_;
    groundness = smoothstep(0, 1, -d.z * inverse_blur_);
  }

  Rgb color(0.0f);
  if (!is_black(sky_scale_)) {
    color = model_.radiance(d) * sky_scale_;
    if (part != SkyPart::Gradient) {
      const float sun = disc_and_glow(d, part);
      if (sun > 0) color += (below ? sun_below_ : sun_above_) * sun;
    }
  }
  return finish(color * (1 - groundness) + ground_raw_ * groundness, 1 - groundness);
}

Rgb PhysicalSky::horizon_radiance(const Vec3& direction) const {
  if (black_) return Rgb(0.0f);
  const Vec3 d = seen(direction);
  return finish(model_.radiance(normalize(Vec3(d.x, d.y, 0))) * sky_scale_, 1);
}

}  // namespace oriel::sky
