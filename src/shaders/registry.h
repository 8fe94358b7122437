// SPDX-License-Identifier: Apache-2.0
// Every built-in shader, by an explicit list.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

const Registry& builtin_shaders();

/// The shader packages that are built in: their includes and links require no file.
const std::vector<std::string>& builtin_packages();

/// The `.mi` type of a parameter: "scalar", "array light".
std::string type_text(const ParamSpec& param);

/// The `.mi` declarations of one library ("architectural", "base", "physics").
std::string mi_declarations(const Registry& registry, std::string_view library);

}  // namespace oriel
