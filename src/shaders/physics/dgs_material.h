// SPDX-License-Identifier: Apache-2.0
// dgs_material, path_material, dielectric_material, transmat, mib_photon_basic and their photon
// shaders.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   Transport scatters photons by the closure of the surface shader, which already describes the
//   behaviour of the *_photon shaders. These are only declared, so that scenes can use them.

/// Diffuse, glossy and mirror components; the share `transp` of each is transmitted.
///
/// Model:   weights are added without energy conservation. `shiny` is like Phong's exponent about
///          the mirror direction (vendor's page). The equivalent GGX roughness is sqrt(2 / (4 n +
///          2)), by the width of the lobe at its peak: a Phong lobe about the normal has four times
///          the exponent. The shape of the lobe is a guess.
/// Source:  the vendor's page; Walter et al., EGSR 2007, section 5.2, for exponent and roughness.
/// Checked: Physics.* in tests/analytic.
extern const ShaderSpec kDgsMaterial;
extern const ShaderSpec kDgsMaterialPhoton;
/// Same; the selection of rays is part of transport.
extern const ShaderSpec kPathMaterial;
/// Fresnel reflection and refraction, and Beer-Lambert absorption: `col` is the transmission of a
/// unit of length.
///
/// Model:   `col_out` is ignored, since the surface that bounds the outer medium defines its
///          absorption; inside and outside are determined by the normal.
extern const ShaderSpec kDielectricMaterial;
extern const ShaderSpec kDielectricMaterialPhoton;
/// Transmits everything: boundaries of volumes.
extern const ShaderSpec kTransmat;
extern const ShaderSpec kTransmatPhoton;
extern const ShaderSpec kMibPhotonBasic;

}  // namespace oriel
