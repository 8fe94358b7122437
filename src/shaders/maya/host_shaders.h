// SPDX-License-Identifier: Apache-2.0
// All stand-ins for other programs' shaders.
#pragma once

#include <vector>

#include "runtime/shader_spec.h"

namespace oriel {

/// In the order of their names; all of library "hosts".
std::vector<const ShaderSpec*> host_shaders();

}  // namespace oriel
