// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for shaders that 3ds Max's translator writes.
#pragma once

#include <span>

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   As in maya_surface.h. Shader and parameter names are those of the host's script reference;
//   grouped structs are flattened (runtime/binder_fallbacks.cpp). Shares may be 0..1 or
//   percentages. Newer names of the same shaders begin with adsk_.
//   Source:  MAXScript reference of 3ds Max 2015 to 2017, "mental ray Shaders Index".
//   Checked: MaxShaders.* in tests/shader_binding.

/// max_DefaultMaterial, max_StandardMaterial with its illumination shaders (max_base_...),
/// max_DefaultShadow.
std::span<const ShaderSpec> max_materials();
/// max_DefaultLight, max_OmniLight, max_SpotLight, max_DirectionalLight.
std::span<const ShaderSpec> max_lights();
/// max_Bitmap, max_base_UVGenerator, max_base_Output, max_Checker, max_Mix, max_RGBMultiplier,
/// max_Environment, and the G-buffer lens shaders, which do not change the picture.
std::span<const ShaderSpec> max_textures();
/// max_mrStoreElement, max_mrStoreElements, max_Bump.
std::span<const ShaderSpec> max_elements();

}  // namespace oriel
