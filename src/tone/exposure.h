// SPDX-License-Identifier: Apache-2.0
// From scene values to display values: the photographic and the simple exposure.
#pragma once

#include "base/vec.h"

namespace oriel::lens {

// Conventions
//   Input is linear and unbounded; output is meant for 0..1 but not clipped above. Negative input
//   counts as 0 (in the simple exposure after pedestal and gain), a channel that is not a number
//   as 0, an infinite one as the largest float. Construction does the work that no pixel changes;
//   the call is const and may run in any number of threads.

/// Luminance that saturates the sensor over 2^EV100: 78 / (0.65 * 100), so that a white card under
/// 96.5 klx reads 1 by the "Sunny 16" rule. mental ray's own constant was never published.
/// Source: ISO 12232:2006, saturation-based speed with lens factor q = 0.65.
inline constexpr float kSaturationExposure = 1.2f;
/// The constant of renderers that leave the sensor out: 0.26 EV brighter.
inline constexpr float kPlainExposure = 1.0f;

/// mia_exposure_photographic's parameters, named and defaulted as its declaration.
struct PhotographicParameters {
  float cm2_factor = 1;        ///< cd/m2 per unit of the input; the plain gain where film_iso is 0
  Rgb whitepoint{1.0f};        ///< the colour shown as grey
  float film_iso = 100;        ///< 0: arbitrary mode
  float camera_shutter = 100;  ///< 1 / s
  float f_number = 16;
  float vignetting = 1;        ///< exponent of the cosine
  float burn_highlights = 0;   ///< 1 linear .. 0 never over-exposed
  float crush_blacks = 0.25f;  ///< 0 linear ..
  float saturation = 1;
  float gamma = 2.2f;
  float exposure_constant = kSaturationExposure;
  bool operator==(const PhotographicParameters&) const = default;
};

/// Factor from input to exposed value, 1 being saturation: without whitepoint and vignetting.
/// 0 where shutter or f-number is not positive (no exposure is defined).
/// Checked: PhotographicExposure.SunnySixteenSaturatesAt30720
float exposure_scale(const PhotographicParameters& parameters);

/// Maps scene colours as a camera and its film would.
///
/// Model:   exposure, white point, vignetting; highlights burnt, saturation, blacks crushed; gamma.
/// Source:  the mental ray manual for parameters and limits; curves as published for the Iray form
///          of this operator (NVIDIA, OptiX_Apps).
/// Checked: exposure_test.cpp
class PhotographicExposure {
 public:
  explicit PhotographicExposure(const PhotographicParameters& parameters);

  /// Inputs:  cos_to_film_plane: cosine between the ray and the camera's axis; 1 for orthographic
  ///          cameras, which have no vignetting.
  Rgb operator()(const Rgb& scene, float cos_to_film_plane = 1) const;

 private:
  Rgb scale_;
  float vignetting_, burn_, saturation_, crush_exponent_, inverse_gamma_;
};

/// How mia_exposure_simple squashes what lies above the knee. Both readings of the manual's
/// "compression ratio"; 0 is none.
enum class KneeCurve {
  Ratio,       ///< slope 1 / (1 + compression) above the knee
  Asymptotic,  ///< smooth at the knee, never above knee + 1 / compression
};

/// mia_exposure_simple's parameters, named and defaulted as its declaration.
struct SimpleParameters {
  float pedestal = 0;
  float gain = 1;
  float knee = 0.5f;
  float compression = 2;
  float gamma = 2.2f;
  KneeCurve curve = KneeCurve::Ratio;
  bool operator==(const SimpleParameters&) const = default;
};

/// Pedestal is added, gain multiplies, the knee compresses, gamma corrects: in this order, per
/// channel.
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
