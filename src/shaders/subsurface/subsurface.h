// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for the subsurface library (misss_*) of mental ray.
#pragma once

#include <span>

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   Scenes declare these shaders themselves. Names of shaders and parameters are those of the
//   mental ray shader reference; parameters grouped in structs are found by their own names.
//   All are approximations, which `oriel check` reports: light is scattered where it enters, the
//   limit of a normalised diffusion profile for small radii (P. Christensen, B. Burley,
//   "Approximate Reflectance Profiles for Efficient Subsurface Scattering", 2015). The mean
//   brightness under even light is that of the profile; radii have no effect, and light does not
//   pass through closed bodies. Light maps are not written.
//   Checked: tests/effects/subsurface_cases.cpp, Subsurface.* in tests/shader_binding.

/// Model:   the layers reflect colour x weight, in sum at most 1 per channel: with
///          `screen_composit` 1 - product(1 - layer), else min(1, sum). Back scattering is diffuse
///          transmission from the other side of a thin wall.
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
