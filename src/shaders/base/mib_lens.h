// SPDX-License-Identifier: Apache-2.0
// mib_lens_stencil, mib_lens_clamp, mib_volume, oversampling_lens.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// Where the stencil is between floor and ceiling, blends from the floor colour to the picture.
/// Source:  the vendor's page; if floor and ceiling are equal, the ceiling is floor + 1.
extern const ShaderSpec kMibLensStencil;
/// Source:  the vendor's page: per channel to 0..1, or by luminance with colours for values outside
///          of the range.
extern const ShaderSpec kMibLensClamp;
/// Uniform fog: linear in distance, complete at `max`. It applies up to surfaces; the environment
/// is unchanged. With `lightrays`, light from sources with a position is attenuated by the same
/// amount; no light is added to it.
/// Checked: VolumeNodes.* in tests/analytic.
extern const ShaderSpec kMibVolume;
/// Accepted without effect: the sampler defines the samples of a pixel.
extern const ShaderSpec kOversamplingLens;

}  // namespace oriel
