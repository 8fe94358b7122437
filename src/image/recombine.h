// SPDX-License-Identifier: Apache-2.0
// Rebuilds the beauty from the layers of a render, as in compositing, and measures the difference.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "image/pixel_buffer.h"

namespace oriel {

// Conventions
//   Layers have the names of the outputs of mia_material_x. Each is R, G, B except `opacity`, which
//   has one channel. `other` contains light that belongs to no output. The beauty is the layer with
//   an empty name; its alpha is ignored. All values are linear.

/// Minimum brightness for relative differences, as a share of the mean brightness of the picture.
/// It limits the effect of rounding: an error of 1e-7 of the mean in a black pixel counts as 1e-4.
inline constexpr float kRecombineFloorShare = 1e-3f;

/// Reasons why recombine() cannot use the layers, one phrase each ("diffuse_raw is missing",
/// "opacity has 3 channels instead of 1"); empty if it can.
///
/// Checked: Recombine.UnusableLayersAreNamed
std::vector<std::string> unusable_outputs(const std::vector<Layer>& layers);

/// The beauty rebuilt in two ways, RGB.
struct Recombination {
  Image simple;   ///< sum of all results
  Image complex;  ///< sum of level x raw light
};

/// Model:   simple  = diffuse_result + indirect_result + spec_result + refl_result + refr_result
///                    + tran_result + add_result + opacity_result + other
///          complex = diffuse_level (diffuse_raw + indirect_post_ao) + spec_level spec_raw
///                    + refl_level refl_raw + refr_level refr_raw + tran_level tran_raw
///                    + add_result + (1 - opacity) opacity_raw + other
/// Errors:  std::runtime_error when unusable_outputs() is not empty.
/// Source:  mental ray Architectural Shader Library, 1.6.11.3.
/// Checked: Recombine.BothFormsFollowTheirEquations
Recombination recombine(const std::vector<Layer>& layers);

/// Difference of a rebuilt picture from the beauty.
struct RebuiltDifference {
  float largest = 0;  ///< relative difference; infinite where a value is not finite
  /// pixel of the largest difference, row 0 at the top; the first one if several are equal
  int x = 0, y = 0;
  int channel = 0;        ///< 0, 1, 2 = R, G, B
  float beauty = 0;       ///< value of the beauty at that pixel
  float rebuilt = 0;      ///< value of the rebuilt picture at that pixel
  float floor = 0;        ///< minimum divisor of the relative difference
  std::size_t above = 0;  ///< number of pixels with a channel above the threshold
};

/// |rebuilt - beauty| / max(|beauty|, floor) of every pixel and channel, RGB.
///
/// Inputs:  beauty: at least three channels. rebuilt: RGB of the same size.
/// Checked: Recombine.DifferencesAreRelativeAboveTheFloor, Recombine.NanCountsAsInfiniteDifference
Image relative_difference(const Image& rebuilt, const Image& beauty);

/// The maximum of relative_difference(). NaN counts as above any threshold.
RebuiltDifference compare_rebuilt(const Image& rebuilt, const Image& beauty, float threshold);

}  // namespace oriel
