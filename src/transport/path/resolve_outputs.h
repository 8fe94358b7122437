// SPDX-License-Identifier: Apache-2.0
// From the mean parts of a pixel to the outputs of the material, in the manual's names.
#pragma once

#include "runtime/material_outputs.h"
#include "transport/path/aov.h"

namespace oriel {

/// All outputs of a pixel; "opacity" in each channel.
///
/// Model:   results and levels are means over the pixel, raw = result / level: the mean of what
///          arrives, weighted by level. So products recombine exactly in every pixel, at edges and
///          in textures too, where the mean of products is not the product of means. Raw light of
///          a level of 0 is black. indirect_raw is what, occluded by ao_raw, gives
///          indirect_post_ao.
/// Inputs:  means: of all paths of the pixel; beauty: of the pixel.
/// Source:  manual 1.6.11.
/// Checked: ResolveOutputs.*, tests/analytic/outputs_test.cpp
MaterialOutputs resolve_outputs(const AovValues& means, const Rgb& beauty);

}  // namespace oriel
