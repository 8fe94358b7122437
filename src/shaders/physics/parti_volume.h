// SPDX-License-Identifier: Apache-2.0
// parti_volume and parti_volume_photon: participating medium.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// A homogeneous medium: attenuates all rays and light by exp(-extinction d). Light and photons are
/// scattered as often as diffuse bounces are traced; without them, once towards the ray.
///
/// Model:   the share `scatter` of the attenuated light is scattered, by a phase function of two
///          Henyey-Greenstein lobes: r of g1, 1 - r of g2. Each ray segment samples one point by
///          transmittance: the path continues from it or at the surface, selected randomly. The
///          light of lamps is sampled at a point by transmittance or by the angle seen from the
///          lamp.
///          Mode 1: the medium ends at y = height. Mode 0 is infinite: light of infinite lights and
///          rays without a hit are not attenuated, because nothing would be left of them. No
///          photons are stored in the medium. As a lens shader, light is attenuated only on its way
///          to scattering points.
/// Source:  parameters of the vendor's declaration. Interpreting `scatter` as a share, and y as up,
///          are guesses. Henyey, Greenstein, Astrophysical Journal 93, 1941.
/// Checked: PartiVolume.*, ScatteringMedium.* in tests/analytic (Chandrasekhar's H, slabs by
/// photons).
extern const ShaderSpec kPartiVolume;
/// Accepted without effect; photons are scattered by the volume shader of the camera.
extern const ShaderSpec kPartiVolumePhoton;

}  // namespace oriel
