// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for the small nodes between Maya's textures and surfaces.
#pragma once

#include <span>

#include "color/luminance.h"
#include "runtime/shader_spec.h"

namespace oriel {

// Conventions: as in maya_surface.h; vectors and colours per component.

/// Luminance with Maya's weights.
/// Source: Maya's help, "Luminance": .3 red + .59 green + .11 blue.
inline float maya_luminance(const Rgb& c) { return luminance(c, Rgb(.3f, .59f, .11f)); }

/// maya_reverse 1 - input, maya_multdiv, maya_plusminusavg, maya_blend, maya_gamma, maya_clamp,
/// maya_setrange, maya_luminance, maya_condition.
std::span<const ShaderSpec> maya_arithmetic();
/// maya_samplerinfo, and conversions between components and colours or vectors: maya_rgb_to_color,
/// maya_color_to_rgb, maya_xyz_to_vector, maya_vector_to_xyz, maya_uvw_to_vector,
/// maya_vector_to_uvw.
std::span<const ShaderSpec> maya_conversions();
/// Displacement, camera background, and shaders without effect in Oriel: glow, volume samplers,
/// options, states, light links, colour management.
std::span<const ShaderSpec> maya_surroundings();

}  // namespace oriel
