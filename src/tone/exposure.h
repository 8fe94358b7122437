// SPDX-License-Identifier: Apache-2.0
// Tone mapping of scene values to display values: photographic and simple exposure.
#pragma once

#include "base/vec.h"

namespace oriel::lens {

// Conventions
//   Input is linear and unbounded; output is designed for 0..1 but not clipped above. Negative
//   input counts as 0 (in the simple exposure after pedestal and gain), NaN as 0, and infinity as
//   the largest float. The constructor precomputes everything that is equal for all pixels; the
//   call operator is const and thread-safe.

/// Saturation luminance of the sensor divided by 2^EV100: 78 / (0.65 * 100). A white card under
/// 96.5 klx gets the value 1 by the "Sunny 16" rule. mental ray's constant is unpublished.
/// Source: ISO 12232:2006, saturation-based speed with lens factor q = 0.65.
inline constexpr float kSaturationExposure = 1.2f;
/// The constant of renderers without a sensor model: 0.26 EV brighter.
inline constexpr float kPlainExposure = 1.0f;

/// Parameters of mia_exposure_photographic with its names and defaults.
struct PhotographicParameters {
  float cm2_factor = 1;        ///< cd/m2 per unit of the input; a plain gain if film_iso is 0
  Rgb whitepoint{1.0f};        ///< the colour that maps to grey
  float film_iso = 100;        ///< 0: arbitrary mode
  float camera_shutter = 100;  ///< 1 / s
  float f_number = 16;
  float vignetting = 1;        ///< exponent of the cosine
  float burn_highlights = 0;   ///< 1 linear .. 0 never overexposed
  float crush_blacks = 0.25f;  ///< 0 linear ..
  float saturation = 1;
  float gamma = 2.2f;
  float exposure_constant = kSaturationExposure;
  bool operator==(const PhotographicParameters&) const = default;
};

/// Factor from input to exposed value, where 1 is saturation; without whitepoint and vignetting. 0
/// if shutter or f-number is not positive (undefined exposure).
/// Checked: PhotographicExposure.SunnySixteenSaturatesAt30720
float exposure_scale(const PhotographicParameters& parameters);

/// Maps scene colours like a camera with its film.
///
/// Model:   exposure, white point, vignetting; burn highlights, saturation, crush blacks; gamma.
/// Source:  the mental ray manual for parameters and limits; the curves published for the Iray form
///          of this operator (NVIDIA, OptiX_Apps).
/// Checked: exposure_test.cpp
class PhotographicExposure {
 public:
  explicit PhotographicExposure(const PhotographicParameters& parameters);

  /// Inputs:  cos_to_film_plane: cosine between the ray and the camera axis; 1 for orthographic
  ///          cameras, which have no vignetting.
  Rgb operator()(const Rgb& scene, float cos_to_film_plane = 1) const;

 private:
  Rgb scale_;
  float vignetting_, burn_, saturation_, crush_exponent_, inverse_gamma_;
};

/// Compression above the knee in mia_exposure_simple. The manual's "compression ratio" allows two
/// interpretations; 0 is none.
enum class KneeCurve {
  Ratio,       ///< slope 1 / (1 + compression) above the knee
  Asymptotic,  ///< smooth at the knee, bounded by knee + 1 / compression
};

/// Parameters of mia_exposure_simple with its names and defaults.
struct SimpleParameters {
  float pedestal = 0;
  float gain = 1;
  float knee = 0.5f;
  float compression = 2;
  float gamma = 2.2f;
  KneeCurve curve = KneeCurve::Ratio;
  bool operator==(const SimpleParameters&) const = default;
};

/// Applies pedestal (added), gain (factor), knee compression and gamma, in this order, per channel.
/// Checked: SimpleExposure.*
class SimpleExposure {
 public:
  explicit SimpleExposure(const SimpleParameters& parameters);
  Rgb operator()(const Rgb& c) const;

 private:
  float map(float value) const;

  SimpleParameters p_;
  float inverse_gamma_;
};

}  // namespace oriel::lens
