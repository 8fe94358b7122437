// SPDX-License-Identifier: Apache-2.0
// The CIE standard clear and overcast skies: grey, for the analysis of daylight.
#pragma once

#include "base/vec.h"

namespace oriel::sky {

// Conventions
//   As in physical_sky.h: radiance is pi times luminance times unit conversion. Angles by cosines:
//   cos_theta to the zenith, cos_gamma to the sun; sun_z is the sine of the sun's elevation.

/// Luminance of the clear sky relative to its zenith. Model: Kittler's.
/// Source:  CIE 22 (1973); the formula also in CIE S 003 (1996).
/// Checked: CieSky.ClearSkyLightsAPlaneAsIntegrated
float cie_clear_relative(float cos_theta, float cos_gamma, float sun_z);
/// Luminance of the overcast sky relative to its zenith; the horizon has one third.
/// Source:  Moon and Spencer 1942; CIE S 003.
inline float cie_overcast_relative(float cos_theta) { return (1 + 2 * cos_theta) / 3; }

/// Horizontal illuminance of each sky for a zenith luminance of 1 cd/m2.
/// Checked: CieSky.ClearSkyLightsAPlaneAsIntegrated
float cie_clear_horizontal(float sun_z);
inline constexpr float kCieOvercastHorizontal = 7 * kPi / 9;

/// Default zenith luminance in cd/m2 as a function of the sun's elevation.
///
/// Model:   clear: 1000 ((1.376 T - 1.81) tan h + 0.38) for turbidity T 2.45, with the elevation
///          clamped to 87 degrees because of the tangent; overcast: 1000 (8.6 sin h + 0.123). Both
///          fade after sunset like the physical sky.
/// Source:  Dogniaux 1967 and Krochmann 1963, as used by Radiance's gensky.
/// Checked: CieSky.AutomaticLuminanceFollowsTheSunsHeight
float cie_clear_zenith(float sun_z);
float cie_overcast_zenith(float sun_z);

/// Parameters of mia_ciesky; the sun is a direction.
struct CieParameters {
  bool on = true;
  Rgb rgb_unit_conversion{0.0001f};
  bool auto_luminance = true;  ///< if off, the sky is black unless one of the next two is positive
  float zenith_luminance = 0;  ///< cd/m2; used if above 0
  float diffuse_horizontal_illuminance = 0;  ///< lux; used if above 0 and zenith_luminance is not
  float overcast = 0;                        ///< 0 clear .. 1 overcast, linear mixture in between
  Vec3 sun_direction{0, 0, 1};               ///< towards the sun; any length except 0
  bool y_is_up = false;
  bool operator==(const CieParameters&) const = default;
};

/// A CIE sky. Lookups are const and thread-safe.
class CieSky {
 public:
  explicit CieSky(const CieParameters& parameters);

  /// cd/m2; black below the horizon. Checked: cie_sky_test.cpp
  float luminance(const Vec3& direction) const;
  /// pi * luminance * unit conversion; grey if the unit conversion is.
  Rgb radiance(const Vec3& direction) const { return scale_ * luminance(direction); }

 private:
  bool y_is_up_;
  Vec3 to_sun_;
  float clear_ = 0, overcast_ = 0;  ///< zenith luminance of each component
  Rgb scale_;
};

}  // namespace oriel::sky
