// SPDX-License-Identifier: Apache-2.0
// Replacements of unavailable shaders: an approximation from the names of its parameters, or
// magenta, as material and as value.
#pragma once

#include "runtime/shader_spec.h"
#include "scene/value.h"

namespace oriel {

extern const ShaderSpec kFallbackShader;

/// Works as material, light, texture and environment: a colour, looked up in a texture if there is
/// one. As a material it has transparency, highlight, mirror reflection and emission, or the
/// material that it is connected to.
/// Checked: FallbackShaders.* in tests/shader_binding.
extern const ShaderSpec kApproximateMaterial;

/// Whether the shader is a fallback, in which case OR-RT-001 was reported.
inline bool is_substitute(const ShaderSpec& spec) {
  return &spec == &kFallbackShader || &spec == &kApproximateMaterial;
}

/// The parameter of kApproximateMaterial for a parameter of this name; null if the name is unknown.
///
/// Inputs:  declared: its type, null if the scene does not declare it. names_texture: the value is
///          the name of a texture element.
const char* familiar_parameter(std::string_view name, const scene::Value& value,
                               const ParamType* declared, bool names_texture);

}  // namespace oriel
