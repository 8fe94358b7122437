// SPDX-License-Identifier: Apache-2.0
// Users' lens shaders: each asks for the next, the last for the eye ray.
#pragma once

#include "runtime/shader_spec.h"
#include "sdk/context.h"

namespace oriel::sdk {

/// The eye ray that is under way through one lens shader.
struct LensWork {
  LensNext* next = nullptr;
};

/// What lies behind the running lens along the ray in the state; false where it is nothing.
bool trace_next_lens(LensWork& work, miState& state, miColor& result);

}  // namespace oriel::sdk
