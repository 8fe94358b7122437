// SPDX-License-Identifier: Apache-2.0
// parti_volume and parti_volume_photon: air that scatters light.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// Even air along eye rays: it dims by exp(-extinction d), and scatters light once.
///
/// Model:   of what a stretch takes away the share `scatter` is scattered, by a phase function of
///          two Henyey-Greenstein lobes: r of g1, 1 - r of g2. Light sources alone are scattered,
///          dimmed on their way by the same air; lights of no place by as much of it as lies below
///          `height`, all of it none in mode 0. Mode 1: the air ends at y = height.
/// Source:  parameters by the vendor's declaration; that `scatter` is a share, and that y is up,
/// are
///          guesses. Henyey, Greenstein, Astrophysical Journal 93, 1941.
/// Checked: PartiVolume.* in tests/analytic.
extern const ShaderSpec kPartiVolume;
/// Accepted; photons are not scattered by air.
extern const ShaderSpec kPartiVolumePhoton;

}  // namespace oriel
