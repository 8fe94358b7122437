// SPDX-License-Identifier: Apache-2.0
// Declared defaults of parameters as text.
#pragma once

#include <string>

#include "runtime/shader_spec.h"

namespace oriel {

/// The default as scenes write it, such as "on" or ".5 .5 .5"; empty for types without one.
std::string default_text(const ParamSpec& param);

}  // namespace oriel
