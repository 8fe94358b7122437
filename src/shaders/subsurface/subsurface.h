// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for the subsurface library (misss_*) of mental ray.
#pragma once

#include <span>

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   Scenes declare these shaders themselves. Names of shaders and parameters are those of the
//   mental ray shader reference; parameters grouped in structs are found by their own names.
//   All are approximations, which `oriel check` reports. A layer with a radius shows the light of
//   its neighbourhood by a normalised diffusion profile, and a back layer with a depth the light of
//   the other side (scatter_light.h), in place of the light maps of mental ray, which are not
//   written. That light is in the output add_result, and its light group is unknown. Layers without
//   a radius, diffuse bounces and photons scatter light where it enters; the mean brightness is the
//   same.
//   Checked: tests/effects/subsurface_cases.cpp, Subsurface.* in tests/shader_binding,
//            SubsurfaceScattering.* in tests/analytic.

/// Model:   the layers reflect colour x weight, in sum at most 1 per channel: with
///          `screen_composit` 1 - product(1 - layer), else min(1, sum). A back layer without
///          a depth is diffuse transmission through a thin wall.
extern const ShaderSpec kMisssFastSimple, kMisssFastSkin, kMisssFastShader, kMisssFastShader2;

/// Reflectance of a half space by diffusion theory, added to the input `material`.
/// Source:  H. W. Jensen, S. Marschner, M. Levoy, P. Hanrahan, "A Practical Model for Subsurface
///          Light Transport", SIGGRAPH 2001, sections 2.1 and 4.1.
extern const ShaderSpec kMisssPhysical;

/// Total diffuse reflectance of a half space with that reduced albedo and index of refraction.
/// Source:  as kMisssPhysical. Checked: Subsurface.DiffuseReflectanceIsThatOfThePaper
float diffusion_reflectance(float reduced_albedo, float index);

/// Skin highlights, a Lambert surface, and calls of other shaders; helpers without effect.
std::span<const ShaderSpec> subsurface_helpers();

}  // namespace oriel
