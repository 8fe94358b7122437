// SPDX-License-Identifier: Apache-2.0
// Does the picture come out again when its layers are put together as a compositor would do it?
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "image/pixel_buffer.h"

namespace oriel {

// Conventions
//   Layers carry the names of the outputs of mia_material_x; each is R, G, B but `opacity`, which
//   is one bare channel. `other` is the light of pixels that belongs to no output. The beauty is
//   the layer without a name; its alpha takes no part. Everything is linear.

/// Below this share of the picture's mean brightness a difference counts as if the beauty were that
/// bright: a rounding error of 1e-7 of a usual pixel in a black one then stays at 1e-4.
inline constexpr float kRecombineFloorShare = 1e-3f;

/// What is wrong with the layers for recombine(), one phrase each ("diffuse_raw is missing",
/// "opacity has 3 channels instead of 1"); empty when nothing is.
///
/// Checked: Recombine.WhatCannotBeUsedIsNamed
std::vector<std::string> unusable_outputs(const std::vector<Layer>& layers);

/// The beauty put together in two ways, RGB.
struct Recombination {
  Image simple;   ///< the sum of all results
  Image complex;  ///< from levels and raw light
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

/// How far a rebuilt picture is from the beauty.
struct RebuiltDifference {
  float largest = 0;      ///< relative difference; infinite where a value is not finite
  int x = 0, y = 0;       ///< its pixel, row 0 at the top; the first of equals
  int channel = 0;        ///< 0, 1, 2 = R, G, B
  float beauty = 0;       ///< the two values there
  float rebuilt = 0;      ///<
  float floor = 0;        ///< the least brightness that differences were divided by
  std::size_t above = 0;  ///< pixels with a channel above the threshold
};

/// |rebuilt - beauty| / max(|beauty|, floor) of every pixel and channel, RGB.
///
/// Inputs:  beauty: of three channels or more. rebuilt: RGB of the same size.
/// Checked: Recombine.DifferencesAreRelativeAboveTheFloor, Recombine.NoNumberIsInfinitelyFar
Image relative_difference(const Image& rebuilt, const Image& beauty);

/// The worst of relative_difference(). A value that is no number lies above any threshold.
RebuiltDifference compare_rebuilt(const Image& rebuilt, const Image& beauty, float threshold);

}  // namespace oriel
