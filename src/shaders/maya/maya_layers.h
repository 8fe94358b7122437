// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for what Maya's translator puts around and over surfaces.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions: as maya_surface.h.

/// Hands on the surface it is connected to.
extern const ShaderSpec kMayaShadingengine;
/// Layers, the first on top: the sum of their colours, each times what the ones above let through.
/// A surface that is connected keeps its lobes; how far it is seen through is the layer's own.
extern const ShaderSpec kMayaLayeredshader;
/// Seen through, under a mirror: shadows on it do not show.
extern const ShaderSpec kMayaUsebackground;
/// Light passes by transparency.
extern const ShaderSpec kMayaShadow;
/// Light passes.
extern const ShaderSpec kMayaTransparent;
/// Photons are scattered by the surface itself.
extern const ShaderSpec kMayaPhotonsurface;

}  // namespace oriel
