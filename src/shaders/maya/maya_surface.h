// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for surfaces that Maya's translator writes.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   Scenes declare these shaders themselves, by files that come with the host. Names are those the
//   translator gives them, parameters the public attributes of the host's nodes; those not listed
//   are noted and skipped (runtime/binder_fallbacks.cpp). All is approximated, as
//   `oriel check` reports: the models are ours. Connected to a value, a surface gives its colour
//   without light.
//   Checked: HostShaders.* in tests/shader_binding, tests/effects/maya_surface_cases.cpp.

/// Diffuse colour x diffuse, seen through by transparency; incandescence and ambient light glow.
extern const ShaderSpec kMayaLambert;
/// With a mirror of reflectivity x specularColor, and the cosine's highlight.
extern const ShaderSpec kMayaPhong;
/// The same; the exponent is 1 / (roughness x highlightSize)^2.
extern const ShaderSpec kMayaPhongE;
/// The same with a highlight of facets.
extern const ShaderSpec kMayaBlinn;
/// The same with Ward's highlight: slopes are roughness / spread.
extern const ShaderSpec kMayaAnisotropic;
/// A colour as it stands.
extern const ShaderSpec kMayaSurfaceshader;

}  // namespace oriel
