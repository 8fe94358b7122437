// SPDX-License-Identifier: Apache-2.0
// The replacement of an unavailable shader: a guess from the names of its parameters, or magenta
// as material and as value.
#pragma once

#include "runtime/shader_spec.h"
#include "scene/value.h"

namespace oriel {

extern const ShaderSpec kFallbackShader;

/// A material, a light, a texture or an environment, whichever it is asked for: a colour, looked up
/// in a texture where there is one; as a material with transparency, highlight, mirror and
/// emission, or what lies under it. Checked: GuessedShaders.* in tests/shader_binding.
extern const ShaderSpec kApproximateMaterial;

/// Whether it is one of the two; that the shader is missing has been reported then (OR-RT-001).
inline bool is_substitute(const ShaderSpec& spec) {
  return &spec == &kFallbackShader || &spec == &kApproximateMaterial;
}

/// The parameter of kApproximateMaterial that one of this name stands for; null where it says
/// nothing.
///
/// Inputs:  declared: its type, null where the scene does not say. names_texture: the value is the
///          name of a texture element.
const char* familiar_parameter(std::string_view name, const scene::Value& value,
                               const ParamType* declared, bool names_texture);

}  // namespace oriel
