// SPDX-License-Identifier: Apache-2.0
// From display values back to scene values: which light a photographic exposure shows so.
#pragma once

#include "tone/exposure.h"

namespace oriel::lens {

/// Finds a scene colour that PhotographicExposure maps to the colour given, which lets a photograph
/// stand behind a scene and come out of the scene's exposure as it was.
///
/// Model:   each step undone, last first: gamma, crush, saturation, burn, vignetting, exposure.
///          Crush weighs by the luminance before it, which is found by iteration; all others are
///          closed forms. Where the exposure shows several colours alike, one of them. Where it
///          shows none so, the nearest: white and more, for burn 0, is taken for
///          kBrightestShown; a channel that a saturation below 1 cannot have come from is 0;
///          saturation 0 is read as grey. What an exposure of 0 shows as black stays black.
/// Checked: ReverseExposure.*
class ReversePhotographicExposure {
 public:
  explicit ReversePhotographicExposure(const PhotographicParameters& parameters);

  /// Inputs:  display: from 0; cos_to_film_plane: as the exposure has it. Cosines below
  ///          kLeastCosine count as that, for no film is so wide.
  Rgb operator()(const Rgb& display, float cos_to_film_plane = 1) const;

  /// A linear value half a step of 8 bits below white, at gamma 2.2.
  static constexpr float kBrightestShown = 0.9957f;
  static constexpr float kLeastCosine = 0.05f;

 private:
  Rgb uncrushed(const Rgb& c) const;
  Rgb unsaturated(const Rgb& c) const;
  float unburnt(float value) const;

  Rgb inverse_scale_;
  float vignetting_, burn_, saturation_, crush_exponent_, gamma_;
};

}  // namespace oriel::lens
