// SPDX-License-Identifier: Apache-2.0
// mib_lens_stencil, mib_lens_clamp, mib_volume, oversampling_lens: what lies before the camera.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// Where the stencil lies between floor and ceiling the picture shows, from the floor's colour at
/// the one to all of it at the other.
/// Source:  the vendor's page; where floor and ceiling are equal the ceiling is floor + 1.
extern const ShaderSpec kMibLensStencil;
/// Source:  the vendor's page: by channel to 0..1, or by luminance with colours for what lies out.
extern const ShaderSpec kMibLensClamp;
/// Even fog: linear in distance, full at `max`. It ends at surfaces; what has none behind it, the
/// environment, is left as it is. With `lightrays` it takes as much from light on its way from a
/// source of a place to a surface, and adds nothing to it.
/// Checked: VolumeNodes.* in tests/analytic.
extern const ShaderSpec kMibVolume;
/// Accepted and without effect: samples of a pixel are the sampler's.
extern const ShaderSpec kOversamplingLens;

}  // namespace oriel
