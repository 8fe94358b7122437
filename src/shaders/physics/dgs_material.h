// SPDX-License-Identifier: Apache-2.0
// dgs_material, path_material, dielectric_material, transmat, mib_photon_basic and their forms for
// the slot photon.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   What a *_photon shader says of photons is in the surface's closure already, from which
//   transport takes photons as well; the shaders are there to be accepted in their slot.

/// Diffuse, glossy and mirroring parts; of each the share `transp` goes through the surface.
///
/// Model:   levels are added without conserving energy. `shiny` is like Phong's
///          exponent about the mirrored ray (vendor's page); as GGX roughness it is
///          sqrt(2 / (4 n + 2)), by the width of the lobe at its peak: about the normal Phong's
///          lobe has four times the exponent. The lobe's shape is a guess.
/// Source:  the vendor's page; Walter et al., EGSR 2007, section 5.2, for exponent and roughness.
/// Checked: Physics.* in tests/analytic.
extern const ShaderSpec kDgsMaterial;
extern const ShaderSpec kDgsMaterialPhoton;
/// The same: how rays are chosen is transport's.
extern const ShaderSpec kPathMaterial;
/// Fresnel's reflection and refraction, and Beer's absorption: `col` is what is left after a unit
/// of length.
///
/// Model:   `col_out` is left to the surface that bounds what is outside; inside and outside are
///          determined by the normal alone.
extern const ShaderSpec kDielectricMaterial;
extern const ShaderSpec kDielectricMaterialPhoton;
/// Lets everything through: hulls of volumes.
extern const ShaderSpec kTransmat;
extern const ShaderSpec kTransmatPhoton;
extern const ShaderSpec kMibPhotonBasic;

}  // namespace oriel
