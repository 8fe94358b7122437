// SPDX-License-Identifier: Apache-2.0
// All fallback shaders for other programs.
#pragma once

#include <vector>

#include "runtime/shader_spec.h"

namespace oriel {

/// Sorted by name; the complete library "hosts".
std::vector<const ShaderSpec*> host_shaders();

}  // namespace oriel
