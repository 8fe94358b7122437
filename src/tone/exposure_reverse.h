// SPDX-License-Identifier: Apache-2.0
// Inverse of the photographic exposure: from display values to scene values.
#pragma once

#include "tone/exposure.h"

namespace oriel::lens {

/// Finds a scene colour that PhotographicExposure maps to the given colour. A photograph can thus
/// be a background and is unchanged by the exposure of the scene.
///
/// Model:   inverts each step in reverse order: gamma, crush, saturation, burn, vignetting,
///          exposure. The luminance before crush is found by iteration; all other steps have closed
///          forms. If several colours map to the given one, returns one of them; if none does, the
///          nearest. In particular: white and above, for burn 0, count as kBrightestShown; a
///          channel that a saturation below 1 cannot produce is 0; saturation 0 is inverted to
///          grey. Black from an exposure of 0 stays black.
/// Checked: ReverseExposure.*
class ReversePhotographicExposure {
 public:
  explicit ReversePhotographicExposure(const PhotographicParameters& parameters);

  /// Inputs:  display: from 0; cos_to_film_plane: as in the exposure, clamped to at least
  ///          kMinCosine.
  Rgb operator()(const Rgb& display, float cos_to_film_plane = 1) const;

  /// The linear value half an 8-bit step below white at gamma 2.2.
  static constexpr float kBrightestShown = 0.9957f;
  static constexpr float kMinCosine = 0.05f;

 private:
  Rgb uncrushed(const Rgb& c) const;
  Rgb unsaturated(const Rgb& c) const;
  float unburnt(float value) const;

  Rgb inverse_scale_;
  float vignetting_, burn_, saturation_, crush_exponent_, gamma_;
};

}  // namespace oriel::lens
