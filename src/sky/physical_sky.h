// SPDX-License-Identifier: Apache-2.0
// The physical sun and sky of mental ray's architectural shaders: units, haze, horizon, ground,
// night colour, disc and glow on top of the Preetham model.
#pragma once

#include <optional>

#include "base/vec.h"
#include "sky/preetham.h"
#include "sky/units.h"

namespace oriel::sky {

// Conventions
//   Results follow mental ray: the sun returns lux times unit conversion, the environment pi times
//   luminance times unit conversion. The cosine-weighted mean of the environment over the
//   hemisphere is therefore an illuminance, and the value of a Lambert surface is albedo times that
//   mean. Directions are unit vectors in scene space, z up (y up with y_is_up). A "seen" direction
//   has y and z swapped if necessary and the horizon moved to z = 0.

/// Angular radius of the real sun in radians.
/// Source: NVIDIA, MDL-SDK base.mdl; 695500 km at 149.6 million km is 0.004649.
inline constexpr float kSunAngularRadius = 0.00465f;

/// Luminance of the sky if the scene defines it (`sky_luminance_mode` not 0).
struct GivenLuminance {
  float zenith = 0;                  ///< cd/m2; used if above 0
  float horizontal_illuminance = 0;  ///< lux of the sky alone; used if above 0 and zenith is not
  PerezCoefficients distribution{};  ///< all 0: computed from haze
  bool operator==(const GivenLuminance&) const = default;
};

/// Parameters of mia_physicalsky with its names and defaults; the sun is a direction.
struct SkyParameters {
  bool on = true;
  float multiplier = 1;              ///< black if not above 0
  Rgb rgb_unit_conversion{0.0001f};  ///< 0 0 0: 1 / kSunnyDayLux
  float haze = 0;                    ///< 0 clear .. 15; turbidity minus 2
  float redblueshift = 0;            ///< -1 blue .. 1 red
  float saturation = 1;              ///< 0 grey .. 2
  float horizon_height = 0;          ///< -10 straight down .. 10 zenith
  float horizon_blur = 0.1f;         ///< 0 sharp .. 10
  Rgb ground_color{0.2f};            ///< albedo
  Rgb night_color{0.0f};             ///< minimum of the sky, in units of the result
  Vec3 sun_direction{0, 0, 1};       ///< towards the sun; any length except 0
  float sun_disk_intensity = 1;
  float sun_disk_scale = 4;  ///< in radii of the real sun
  float sun_glow_intensity = 1;
  /// disc and glow have the energy of the directional sun light
  bool physically_scaled_sun = false;
  bool y_is_up = false;
  /// true: the sun has the colour of 5900 K, and the ground is lit by this sun and the integrated
  /// sky, as documented. false: as in mental ray: the sun is whiter, and the ground is lit through
  /// clear air regardless of haze, by 25 directions of the sky.
  bool as_in_manual = false;
  PreethamOptions model;
  /// If set, luminance is given and does not fade after sunset; colours still depend on haze.
  std::optional<GivenLuminance> luminance;
  bool operator==(const SkyParameters&) const = default;
};

/// Parameters of mia_physicalsun that affect its colour.
struct SunParameters {
  bool on = true;
  float multiplier = 1;
  Rgb rgb_unit_conversion{0.0001f};
  float haze = 0;
  float redblueshift = 0;
  float saturation = 1;
  float horizon_height = 0;
  bool y_is_up = false;
  /// If set, the illuminance on a facing surface in lux while the sun is up; the colour still
  /// depends on haze.
  std::optional<float> normal_illuminance;
  bool as_in_manual = false;  ///< colour of 5900 K
};

/// Part of the sky that a lookup returns. Final gathering and portals use the gradient only,
/// because the directional light already contains the energy of the sun.
enum class SkyPart { Gradient, GradientAndGlow, Everything };

/// Colour of the directional light towards `sun_direction`: its illuminance on a facing surface
/// times unit conversion (no pi). Black as soon as the sun touches the (moved) horizon.
/// Source:  physical model of sun_illuminance; colour processing of PhysicalSky.
/// Checked: Sun.*
Rgb sun_colour(const SunParameters& parameters, const Vec3& sun_direction);

/// Share of daylight after sunset: 1 until the sun is at the horizon, 0 from 18 degrees below (end
/// of astronomical twilight). `sun_z` is the sine of the sun's elevation.
/// Source:  NVIDIA, MDL-SDK base.mdl.
/// Checked: PhysicalSky.TwilightFadesByTheFourthPower
float night_factor(float sun_z);

/// The sky for one set of parameters. The constructor precomputes everything that does not depend
/// on the direction. Lookups are const, allocate nothing and are thread-safe.
class PhysicalSky {
 public:
  explicit PhysicalSky(const SkyParameters& parameters);

  /// pi * luminance * unit conversion * multiplier towards `direction`.
  ///
  /// Model:   Preetham sky (+ disc and glow), units, blend with the ground below the horizon,
  ///          saturation and red shift, maximum with the night colour. The ground receives no
  ///          shadows.
  /// Returns: finite and non-negative for every unit direction.
  /// Source:  the mental ray manual for parameters; NVIDIA's MDL-SDK base.mdl and its GLSL port for
  ///          formulas that the manual does not define.
  /// Checked: physical_sky_test.cpp, physical_sky_sun_test.cpp
  Rgb radiance(const Vec3& direction, SkyPart part = SkyPart::Everything) const;

  /// The gradient at the horizon in the azimuth of `direction`, the haze colour of distant objects.
  Rgb horizon_radiance(const Vec3& direction) const;

  /// Replaces the minimum colour of the sky.
  void set_night_color(const Rgb& color);

  /// Result of a lookup far below the horizon.
  const Rgb& ground_radiance() const { return ground_; }

  /// Cosine of the angular radius of disc and glow around the sun, measured between seen
  /// directions; above 1 if both are disabled.
  float cos_glow_radius() const { return cos_glow_radius_; }

 private:
  Vec3 seen(const Vec3& direction) const;
  float disc_and_glow(const Vec3& seen_direction, SkyPart part) const;
  Rgb finish(const Rgb& color, float night_share) const;
  void give_luminance(const GivenLuminance& given);
  void set_up_disc(const SkyParameters& p);

  PreethamSky model_;
  bool black_;  ///< disabled
  bool y_is_up_;
  float horizon_;          ///< z of the moved horizon
  float inverse_blur_;     ///< 0 if the horizon is sharp
  Vec3 to_sun_;            ///< seen direction, not lifted
  Rgb sky_scale_;          ///< cd/m2 of the model to units of the result
  Rgb sun_above_;          ///< sun on its disc above the horizon, in units of the result
  Rgb sun_below_;          ///< same below the horizon, where air counts as clear
  float glow_radius_ = 0;  ///< radians
  float cos_glow_radius_ = 2;
  float glow_ = 0, disc_ = 0, disc_edge_ = 0;
  float saturation_, red_, blue_;
  Rgb ground_raw_{0.0f};  ///< before colour processing
  Rgb ground_{0.0f};
  Rgb night_;
};

}  // namespace oriel::sky
