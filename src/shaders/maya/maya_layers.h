// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for what Maya's translator puts around and over surfaces.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions: as maya_surface.h.

/// Returns the connected surface.
extern const ShaderSpec kMayaShadingengine;
/// Layers, the first on top: the sum of their colours, each weighted by the transparency of the
/// layers above. A connected surface keeps its lobes; the layer defines its transparency.
extern const ShaderSpec kMayaLayeredshader;
/// Transparent with a mirror reflection: shadows on it are not visible.
extern const ShaderSpec kMayaUsebackground;
/// Transmits light in proportion to transparency.
extern const ShaderSpec kMayaShadow;
/// Transmits all light.
extern const ShaderSpec kMayaTransparent;
/// Photons are scattered by the surface shader.
extern const ShaderSpec kMayaPhotonsurface;

}  // namespace oriel
