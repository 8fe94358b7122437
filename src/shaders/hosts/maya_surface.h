// SPDX-License-Identifier: Apache-2.0
// Stand-ins for surfaces that Maya's translator writes: maya_lambert, maya_phong, maya_blinn,
// maya_surfaceshader, maya_shadingengine, maya_shadow.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   Scenes declare these shaders themselves, by files that come with the host. Parameters are the
//   attributes of the host's nodes by their public names; those not listed are reported and
//   skipped. All is approximated and `oriel check` says so. Names and models are recalled, not
//   published. Any member of their results ("phong1.outColor") stands for the shader itself.

/// Diffuse colour x diffuse, seen through by transparency; incandescence and ambient light glow.
extern const ShaderSpec kMayaLambert;
/// With a mirror of reflectivity x specularColor, and the cosine's highlight.
extern const ShaderSpec kMayaPhong;
/// The same with a highlight of facets.
extern const ShaderSpec kMayaBlinn;
/// A colour as it stands.
extern const ShaderSpec kMayaSurfaceshader;
/// Hands on the surface it is connected to.
extern const ShaderSpec kMayaShadingengine;
/// Light passes by transparency.
extern const ShaderSpec kMayaShadow;

}  // namespace oriel
