// SPDX-License-Identifier: Apache-2.0
// The clear-sky model of Preetham, Shirley and Smits: luminance and colour of the sky and the sun.
#pragma once

#include "base/vec.h"

namespace oriel::sky {

// Conventions
//   z points up; directions are unit vectors away from the viewer; `to_sun` points to the sun.
//   Luminance in cd/m2, illuminance in lux; an Rgb contains one such value per channel (photometric
//   RGB), and its Rec. 709 luminance is the quantity itself.
//   Turbidity 2 is very clear air; the fits are valid up to about 10 and are used beyond.

/// Minimum z of lookup directions and of the sun; lower directions are raised to it.
/// Source:  NVIDIA's port of the sky (MDL-SDK base.mdl), which treats the horizon in the same way.
inline constexpr float kLowestSkyZ = 0.001f;

/// Maximum turbidity. Haze 15, the end of its documented range, is turbidity 17, where the fitted
/// chromaticities start to leave the diagram for a low sun; at 25 those of most of the sky are
/// outside.
inline constexpr float kMaxTurbidity = 20;

/// `direction` with z raised to at least kLowestSkyZ, normalised.
Vec3 lifted_above_horizon(const Vec3& direction);

/// Zenith luminance in cd/m2; clamped at 0, because the fit is negative for thick air and a low
/// sun.
/// Source:  Preetham, Shirley, Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999,
///          A.2. Checked: Preetham.ZenithMatchesTable
float zenith_luminance(float turbidity, float sun_zenith_angle);

/// CIE 1931 chromaticity of the zenith. Source and check as above.
Vec2 zenith_chromaticity(float turbidity, float sun_zenith_angle);

/// Illuminance of the sun through the atmosphere on a facing surface, in lux per channel.
///
/// Model:   attenuation at three wavelengths by Rayleigh scattering, aerosol and ozone; no gases,
///          no water vapour.
/// Inputs:  sun_z: cosine of the zenith angle of the sun.
/// Returns: lux; black if the sun is on or below the horizon.
/// Source:  Preetham et al. 1999, A.1; reduced to three wavelengths in NVIDIA's MDL-SDK base.mdl.
/// Checked: Sun.NormalIlluminanceMatchesTable, Sun.OutsideTheAtmosphereIs127500Lux
Rgb sun_illuminance(float sun_z, float turbidity, bool black_body = false);

/// Same outside the atmosphere: 127500 lux (IES 1984 solar illumination constant).
///
/// Inputs:  black_body: colour of a black body of 5900 K, as documented (2.2); else the historic
///          (1, .992, .911), which is closer to 6400 K.
/// Checked: Sun.ColourOutsideTheAtmosphereIsHistoricOrOf5900Kelvin
Rgb sun_illuminance_outside_atmosphere(bool black_body = false);

/// Differences between the port and the paper.
struct PreethamOptions {
  /// Use the paper's constant in the chromaticity x instead of one that depends on the sun's
  /// elevation.
  bool paper_chromaticity = false;
  /// Use the luminance at a right angle to the sun for the half of the sky behind it (one public
  /// port).
  bool clamp_antisolar = false;
  bool operator==(const PreethamOptions&) const = default;
};

/// Coefficients of the Perez luminance distribution, up to a factor: (1 + a exp(b / cos theta)) (1
/// + c exp(d gamma) + e cos^2 gamma). All 0 is uniform.
/// Source:  Perez, Seals, Michalsky, "All-Weather Model for Sky Luminance Distribution", Solar
///          Energy 50 (1993).
struct PerezCoefficients {
  float a = 0, b = 0, c = 0, d = 0, e = 0;
  bool operator==(const PerezCoefficients&) const = default;
};

/// The sky for one sun and one turbidity; immutable and thread-safe after construction.
class PreethamSky {
 public:
  struct Xyy {
    float x, y, luminance;
  };

  /// Turbidity is clamped to 2..kMaxTurbidity; a sun below the horizon is moved to the horizon.
  PreethamSky(const Vec3& to_sun, float turbidity, const PreethamOptions& options = {});

  /// Replaces the distribution of luminance and keeps its zenith value and all chromaticities. If
  /// the distribution is not positive at the zenith, the factor is 1. b is clamped to at most 0,
  /// because the horizon would be infinitely bright.
  /// Checked: Preetham.GivenCoefficientsDistributeLuminance
  void distribute(const PerezCoefficients& coefficients);
  /// Scales all luminances.
  void scale_luminance(float factor) { perez_.scale[0] *= factor; }

  /// Chromaticity and luminance (cd/m2) towards `direction`.
  /// Checked: Preetham.PointSamplesMatchTable
  Xyy xyy(const Vec3& direction) const;

  /// Luminance towards `direction` per linear sRGB channel, cd/m2, non-negative.
  /// Checked: Preetham.HorizontalIlluminanceMatchesTable
  Rgb radiance(const Vec3& direction) const;

  /// The direction of the sun in the model, on or above the horizon.
  const Vec3& to_sun() const { return to_sun_; }

 private:
  /// The three Perez functions as vector lanes (luminance, x, y, and one unused lane), value =
  /// scale (1 + a exp(b / cos theta)) (1 + c exp(d gamma) + e cos^2 gamma).
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
