// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for surfaces that Maya's translator writes.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   Scenes declare these shaders themselves with files of the host. Shader names are those of the
//   exporter, parameters the public attributes of the host nodes; unknown parameters are reported
//   and skipped (runtime/binder_fallbacks.cpp). All parameters are approximated, as `oriel check`
//   reports: the shading models are Oriel's. A surface that is connected to a value returns its
//   colour without illumination.
//   Checked: HostShaders.* in tests/shader_binding, tests/effects/maya_surface_cases.cpp.

/// Diffuse colour x diffuse, with transparency, incandescence and ambient light.
extern const ShaderSpec kMayaLambert;
/// With a mirror of reflectivity x specularColor and a Phong highlight.
extern const ShaderSpec kMayaPhong;
/// Same with the exponent 1 / (roughness x highlightSize)^2.
extern const ShaderSpec kMayaPhongE;
/// Same with a microfacet highlight.
extern const ShaderSpec kMayaBlinn;
/// Same with Ward's highlight: slopes are roughness / spread.
extern const ShaderSpec kMayaAnisotropic;
/// A constant colour.
extern const ShaderSpec kMayaSurfaceshader;

}  // namespace oriel
