// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for two-dimensional textures that Maya's translator writes, and where they are
// placed.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   As in maya_surface.h. uv (0, 0) is the lower left corner of a picture. If uvCoord is not
//   connected, the coordinates of the surface are used.
//   A placement defines a frame on the surface: rotated by rotateFrame about its centre, moved by
//   translateFrame, with size coverage; outside of it textures return defaultColor. Inside, uv is
//   0..1, times repeatUV, plus offset. Every other tile is mirrored (mirrorU, mirrorV), and every
//   other row is shifted by half a tile (stagger); finally uv is rotated by rotateUV about (.5,
//   .5). Results are outColor and outAlpha: colour x colorGain + colorOffset, alpha x alphaGain +
//   alphaOffset, where alpha is the luminance if alphaIsLuminance is on.

/// The coordinate of a placed texture; its parameters are further results.
extern const ShaderSpec kMayaPlace2dtex;
/// A picture. Its own placement applies if uvCoord is not connected.
extern const ShaderSpec kMayaFile;
/// Two by two fields with color1 at the lower left.
extern const ShaderSpec kMayaChecker;
/// Interpolates up to 16 colours along V, along U, diagonally, around, radially or in squares.
extern const ShaderSpec kMayaRamp;
/// Sums of gradient noise; the patterns differ from the host's.
extern const ShaderSpec kMayaNoise, kMayaFractal;
/// The normal of a surface displaced by bumpDepth x bumpValue scene units, in camera space.
extern const ShaderSpec kMayaBump2d;

}  // namespace oriel
