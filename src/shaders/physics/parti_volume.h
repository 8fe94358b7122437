// SPDX-License-Identifier: Apache-2.0
// parti_volume and parti_volume_photon: air that scatters light.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// Even air: it dims all rays and light on its way by exp(-extinction d), and scatters light as
/// often as diffuse light is followed, photons too; else once, to the ray.
///
/// Model:   of what a stretch takes away the share `scatter` is scattered, by a phase function of
///          two Henyey-Greenstein lobes: r of g1, 1 - r of g2. Light sources are asked at one place
///          of each stretch; what is left goes on from there or to the surface, by chance. Mode 1:
///          the air ends at y = height. Mode 0 has no end: light from endlessly far, and rays that
///          meet nothing, are left alone, for nothing would be left of them. No photons are stored
///          in the air. Behind it as a lens, light on its way is dimmed where it is scattered
///          alone.
/// Source:  parameters by the vendor's declaration; that `scatter` is a share, and that y is up,
/// are
///          guesses. Henyey, Greenstein, Astrophysical Journal 93, 1941.
/// Checked: PartiVolume.*, ScatteringAir.* in tests/analytic (Chandrasekhar's H, slabs by photons).
extern const ShaderSpec kPartiVolume;
/// Accepted; photons are scattered as the camera's own volume says.
extern const ShaderSpec kPartiVolumePhoton;

}  // namespace oriel
