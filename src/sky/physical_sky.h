// SPDX-License-Identifier: Apache-2.0
// The physical sun and sky as mental ray's architectural shaders define them: units, haze, horizon,
// ground, night, disc and glow around the Preetham model.
#pragma once

#include <optional>

#include "base/vec.h"
#include "sky/preetham.h"
#include "sky/units.h"

namespace oriel::sky {

// Conventions
//   Results follow mental ray: the sun answers lux times unit conversion, the environment pi times
//   luminance times unit conversion, so that its cosine-weighted mean over the hemisphere is an
//   illuminance and a Lambert surface is albedo times that.
//   Directions are unit, in the space of the scene, z up (y up with y_is_up). Inside, a direction
//   is "seen" after y and z are swapped and the horizon is moved.

/// Angular radius of the true sun, radians.
/// Source: NVIDIA, MDL-SDK base.mdl; 695500 km at 149.6 million km is 0.004649.
inline constexpr float kSunAngularRadius = 0.00465f;

/// Luminance of the sky as later editions let a scene give it (`sky_luminance_mode` not 0).
struct GivenLuminance {
  float zenith = 0;                  ///< cd/m2; where above 0 it decides
  float horizontal_illuminance = 0;  ///< lux, of the sky alone; where above 0 it is next
  PerezCoefficients distribution{};  ///< all 0: as the haze has it
  bool operator==(const GivenLuminance&) const = default;
};

/// mia_physicalsky's parameters, named and defaulted as its declaration; the sun is a direction.
struct SkyParameters {
  bool on = true;
  float multiplier = 1;              ///< not above 0: black
  Rgb rgb_unit_conversion{0.0001f};  ///< 0 0 0: 1 / kSunnyDayLux
  float haze = 0;                    ///< 0 clear .. 15; turbidity less 2
  float redblueshift = 0;            ///< -1 blue .. 1 red
  float saturation = 1;              ///< 0 grey .. 2
  float horizon_height = 0;          ///< -10 straight down .. 10 zenith
  float horizon_blur = 0.1f;         ///< 0 sharp .. 10
  Rgb ground_color{0.2f};            ///< albedo
  Rgb night_color{0.0f};             ///< floor of the sky, in units of the result
  Vec3 sun_direction{0, 0, 1};       ///< toward the sun; any length but 0
  float sun_disk_intensity = 1;
  float sun_disk_scale = 4;  ///< times the true radius
  float sun_glow_intensity = 1;
  bool physically_scaled_sun = false;  ///< disc and glow carry the energy of the sun's light
  bool y_is_up = false;
  /// The sun has the colour of 5900 K, and the ground is lit by this sun and all of this sky. Off:
  /// as old pictures have it, the sun whiter, the ground as in clear air whatever the haze, lit by
  /// 25 directions of the sky.
  bool as_in_manual = false;
  PreethamOptions model;
  /// Set: luminance is given, and does not fade after sunset; its colours stay those of the haze.
  std::optional<GivenLuminance> luminance;
  bool operator==(const SkyParameters&) const = default;
};

/// mia_physicalsun's parameters that decide its colour.
struct SunParameters {
  bool on = true;
  float multiplier = 1;
  Rgb rgb_unit_conversion{0.0001f};
  float haze = 0;
  float redblueshift = 0;
  float saturation = 1;
  float horizon_height = 0;
  bool y_is_up = false;
  /// Set: its illuminance on a facing surface, lux, as long as it is up; colour stays by the haze.
  std::optional<float> normal_illuminance;
  bool as_in_manual = false;  ///< of the colour of 5900 K
};

/// Which of the sun's images a look-up sees. Final gathering and portals see the gradient only:
/// the directional light already carries the sun's energy.
enum class SkyPart { Gradient, GradientAndGlow, Everything };

/// Colour of the directional light toward `sun_direction`: its illuminance on a facing surface
/// times unit conversion (no pi). Black from the moment the sun touches the (moved) horizon.
/// Source:  physical model of sun_illuminance; colour steps as PhysicalSky.
/// Checked: Sun.*
Rgb sun_colour(const SunParameters& parameters, const Vec3& sun_direction);

/// Share of daylight left after sunset: 1 down to the horizon, 0 from 18 degrees below (the end of
/// astronomical twilight). `sun_z` is the sine of the sun's elevation.
/// Source:  NVIDIA, MDL-SDK base.mdl.
/// Checked: PhysicalSky.TwilightFadesByTheFourthPower
float night_factor(float sun_z);

/// The sky of one set of parameters. Construction does all that no view direction changes;
/// look-ups are const, allocate nothing and may run in any number of threads.
class PhysicalSky {
 public:
  explicit PhysicalSky(const SkyParameters& parameters);

  /// pi * luminance * unit conversion * multiplier toward `direction`.
  ///
  /// Model:   Preetham sky (+ disc and glow) > units > mixed with the ground below the horizon >
  ///          saturation and red shift > never below the night colour. The ground takes no shadows.
  /// Returns: finite and never negative, for every unit direction.
  /// Source:  the mental ray manual for the meaning; NVIDIA's MDL-SDK base.mdl and its GLSL port
  ///          for formulas the manual leaves open.
  /// Checked: physical_sky_test.cpp, physical_sky_sun_test.cpp
  Rgb radiance(const Vec3& direction, SkyPart part = SkyPart::Everything) const;

  /// The gradient on the horizon in the azimuth of `direction`: what distant things fade to.
  Rgb horizon_radiance(const Vec3& direction) const;

  /// The same sky over another floor.
  void set_night_color(const Rgb& color);

  /// What a look-up far below the horizon returns.
  const Rgb& ground_radiance() const { return ground_; }

  /// Cosine of the angle around the sun beyond which there is neither disc nor glow, measured
  /// between seen directions; above 1 where there is none at all.
  float cos_glow_radius() const { return cos_glow_radius_; }

 private:
  Vec3 seen(const Vec3& direction) const;
  float disc_and_glow(const Vec3& seen_direction, SkyPart part) const;
  Rgb finish(const Rgb& color, float night_share) const;
  void give_luminance(const GivenLuminance& given);
  void set_up_disc(const SkyParameters& p);

  PreethamSky model_;
  bool black_;  ///< switched off
  bool y_is_up_;
  float horizon_;          ///< height as the z the horizon is moved to
  float inverse_blur_;     ///< 0 where the horizon is sharp
  Vec3 to_sun_;            ///< seen, not lifted
  Rgb sky_scale_;          ///< cd/m2 of the model to the result
  Rgb sun_above_;          ///< sun on the disc, in the result's units, above the horizon
  Rgb sun_below_;          ///< the same below it, where the air counts as clear
  float glow_radius_ = 0;  ///< radians
  float cos_glow_radius_ = 2;
  float glow_ = 0, disc_ = 0, disc_edge_ = 0;
  float saturation_, red_, blue_;
  Rgb ground_raw_{0.0f};  ///< before the colour steps
  Rgb ground_{0.0f};
  Rgb night_;
};

}  // namespace oriel::sky
