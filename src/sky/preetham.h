// SPDX-License-Identifier: Apache-2.0
// The clear-sky model of Preetham, Shirley and Smits: luminance and colour of the sky and the sun.
#pragma once

#include "base/vec.h"

namespace oriel::sky {

// Conventions
//   z points up; directions are unit and point away from the viewer, `to_sun` toward the sun.
//   Luminance in cd/m2, illuminance in lux; an Rgb carries one such value per channel (photometric
//   RGB), its Rec. 709 luminance is the quantity itself.
//   Turbidity 2 is very clear air; the fits are good to about 10 and are used far beyond.

/// Lowest z of a sky look-up and of the sun in the model; lower directions are lifted to it.
/// Source: NVIDIA's port of the sky (MDL-SDK base.mdl), which meets the horizon the same way.
inline constexpr float kLowestSkyZ = 0.001f;

/// Highest turbidity the model answers for. Haze 15, the end of its documented range, is 17, where
/// the chromaticity fits begin to leave the diagram (under a low sun); at 25 most of the sky has.
inline constexpr float kMostTurbidity = 20;

/// `direction` lifted to kLowestSkyZ if it lies lower, renormalised.
Vec3 lifted_above_horizon(const Vec3& direction);

/// Zenith luminance, cd/m2; never negative (the fit is, for thick air and a low sun).
/// Source:  Preetham, Shirley, Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999,
/// A.2. Checked: Preetham.ZenithMatchesTable
float zenith_luminance(float turbidity, float sun_zenith_angle);

/// CIE 1931 chromaticity of the zenith. Source and check as above.
Vec2 zenith_chromaticity(float turbidity, float sun_zenith_angle);

/// Illuminance of the sun on a surface facing it, lux per channel, through the atmosphere.
///
/// Model:   attenuation at three wavelengths by Rayleigh, aerosol and ozone; no gases, no water.
/// Inputs:  sun_z: cosine of the sun's zenith angle.
/// Returns: lux; black for a sun on or below the horizon.
/// Source:  Preetham et al. 1999, A.1; reduced to three wavelengths in NVIDIA's MDL-SDK base.mdl.
/// Checked: Sun.NormalIlluminanceMatchesTable, Sun.OutsideTheAtmosphereIs127500Lux
Rgb sun_illuminance(float sun_z, float turbidity, bool black_body = false);

/// The same outside the atmosphere: 127500 lux (IES 1984 solar illumination constant).
///
/// Inputs:  black_body: of the colour of one of 5900 K, as the manual says (2.2); else of the
///          historic (1, .992, .911), which is nearer to one of 6400 K.
/// Checked: Sun.ColourOutsideTheAtmosphereIsHistoricOrOf5900Kelvin
Rgb sun_illuminance_outside_atmosphere(bool black_body = false);

/// Where the model in use departs from the paper.
struct PreethamOptions {
  /// The paper's constant in the chromaticity x instead of the one that follows the sun's height.
  bool paper_chromaticity = false;
  /// Luminance of the half sky away from the sun as at a right angle to it (one public port).
  bool clamp_antisolar = false;
  bool operator==(const PreethamOptions&) const = default;
};

/// Luminance over the sky in Perez' form, up to a factor:
/// (1 + a exp(b / cos theta)) (1 + c exp(d gamma) + e cos^2 gamma). All 0: the same everywhere.
/// Source:  Perez, Seals, Michalsky, "All-Weather Model for Sky Luminance Distribution", Solar
///          Energy 50 (1993).
struct PerezCoefficients {
  float a = 0, b = 0, c = 0, d = 0, e = 0;
  bool operator==(const PerezCoefficients&) const = default;
};

/// The sky for one sun and one turbidity; built once, then asked from any number of threads.
class PreethamSky {
 public:
  struct Xyy {
    float x, y, luminance;
  };

  /// Turbidity is held to 2..kMostTurbidity; a sun below the horizon stands on it.
  PreethamSky(const Vec3& to_sun, float turbidity, const PreethamOptions& options = {});

  /// Another distribution of luminance, its value at the zenith and all chromaticities kept. A
  /// form that is not positive at the zenith gets the factor 1. b counts as 0 where it is above:
  /// the horizon would be infinitely bright.
  /// Checked: Preetham.GivenCoefficientsDistributeLuminance
  void distribute(const PerezCoefficients& coefficients);
  /// All luminances times a factor.
  void scale_luminance(float factor) { perez_.scale[0] *= factor; }

  /// Chromaticity and luminance (cd/m2) toward `direction`.
  /// Checked: Preetham.PointSamplesMatchTable
  Xyy xyy(const Vec3& direction) const;

  /// Luminance toward `direction` per linear sRGB channel, cd/m2, never negative.
  /// Checked: Preetham.HorizontalIlluminanceMatchesTable
  Rgb radiance(const Vec3& direction) const;

  /// The sun as the model sees it, on or above the horizon.
  const Vec3& to_sun() const { return to_sun_; }

 private:
  /// The three Perez forms side by side (luminance, x, y, and one idle lane for the compiler's
  /// vectors), value = scale (1 + a exp(b / cos theta)) (1 + c exp(d gamma) + e cos^2 gamma).
  static constexpr int kLanes = 4;
  struct Perez {
    float a[kLanes], b[kLanes], c[kLanes], d[kLanes], e[kLanes], scale[kLanes];
  };
  void evaluate(float cos_theta, float cos_gamma, float (&value)[kLanes]) const;

  Vec3 to_sun_;
  Perez perez_;
  bool clamp_antisolar_;
};

}  // namespace oriel::sky
