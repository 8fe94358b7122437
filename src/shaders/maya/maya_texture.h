// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for two-dimensional textures that Maya's translator writes, and where they are
// placed.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   As maya_surface.h. uv (0, 0) is the lower left of a picture. Where uvCoord is not connected a
//   texture is looked up at the surface's own coordinates.
//   A placement cuts a frame out of the surface: turned by rotateFrame about the middle, moved by
//   translateFrame, coverage large; outside of it textures show defaultColor. Within the frame uv
//   runs 0..1, times repeatUV, plus offset; every other tile is mirrored (mirrorU, mirrorV) or, in
//   every other row, shifted by half (stagger); last, all turns by rotateUV about (.5, .5).
//   Results are outColor and outAlpha: colour x colorGain + colorOffset, alpha x alphaGain +
//   alphaOffset, alpha being the luminance where alphaIsLuminance is on.

/// The coordinate of a placed texture, its own parameters as further results.
extern const ShaderSpec kMayaPlace2dtex;
/// A picture. Its own placement acts where uvCoord is not connected.
extern const ShaderSpec kMayaFile;
/// Two by two fields, color1 at the lower left.
extern const ShaderSpec kMayaChecker;
/// Colours between up to 16 places, along V, along U, across, around, outward or in squares.
extern const ShaderSpec kMayaRamp;
/// Sums of gradient noise; the patterns are not the host's.
extern const ShaderSpec kMayaNoise, kMayaFractal;
/// The normal of a surface raised by bumpDepth x bumpValue scene units, in camera space.
extern const ShaderSpec kMayaBump2d;

}  // namespace oriel
