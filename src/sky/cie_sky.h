// SPDX-License-Identifier: Apache-2.0
// The CIE standard clear and overcast skies: grey, for the analysis of daylight.
#pragma once

#include "base/vec.h"

namespace oriel::sky {

// Conventions
//   As in physical_sky.h: radiance is pi times luminance times unit conversion. Angles by cosines:
//   cos_theta to the zenith, cos_gamma to the sun; sun_z is the sine of the sun's elevation.

/// Luminance of the clear sky relative to its zenith's. Model: Kittler's.
/// Source:  CIE 22 (1973); the formula also in CIE S 003 (1996).
/// Checked: CieSky.ClearSkyLightsAPlaneAsIntegrated
float cie_clear_relative(float cos_theta, float cos_gamma, float sun_z);
/// The same of the overcast sky: three times brighter at the zenith than on the horizon.
/// Source:  Moon and Spencer 1942; CIE S 003.
inline float cie_overcast_relative(float cos_theta) { return (1 + 2 * cos_theta) / 3; }

/// Horizontal illuminance of the skies for a zenith of 1 cd/m2.
/// Checked: CieSky.ClearSkyLightsAPlaneAsIntegrated
float cie_clear_horizontal(float sun_z);
inline constexpr float kCieOvercastHorizontal = 7 * kPi / 9;

/// Luminance of the zenith, cd/m2, that goes with the sun's height where none is given.
///
/// Model:   clear: 1000 ((1.376 T - 1.81) tan h + 0.38) for turbidity T 2.45, the sun held to 87
///          degrees, where the tangent still means something; overcast: 1000 (8.6 sin h + 0.123).
///          Both fade after sunset as the physical sky does.
/// Source:  Dogniaux 1967 and Krochmann 1963, as Radiance's gensky has them.
/// Checked: CieSky.AutomaticLuminanceFollowsTheSunsHeight
float cie_clear_zenith(float sun_z);
float cie_overcast_zenith(float sun_z);

/// mia_ciesky's parameters; the sun is a direction.
struct CieParameters {
  bool on = true;
  Rgb rgb_unit_conversion{0.0001f};
  bool auto_luminance = true;                ///< off: black where neither of the two below is given
  float zenith_luminance = 0;                ///< cd/m2; where above 0 it decides
  float diffuse_horizontal_illuminance = 0;  ///< lux; where above 0 it is next
  float overcast = 0;                        ///< 0 clear .. 1 overcast, in between a mixture
  Vec3 sun_direction{0, 0, 1};               ///< toward the sun; any length but 0
  bool y_is_up = false;
  bool operator==(const CieParameters&) const = default;
};

/// A CIE sky. Look-ups are const and may run in any number of threads.
class CieSky {
 public:
  explicit CieSky(const CieParameters& parameters);

  /// cd/m2; black below the horizon. Checked: cie_sky_test.cpp
  float luminance(const Vec3& direction) const;
  /// pi * luminance * unit conversion, grey as far as the conversion is.
  Rgb radiance(const Vec3& direction) const { return scale_ * luminance(direction); }

 private:
  bool y_is_up_;
  Vec3 to_sun_;
  float clear_ = 0, overcast_ = 0;  ///< zenith luminance of each share
  Rgb scale_;
};

}  // namespace oriel::sky
