// SPDX-License-Identifier: Apache-2.0
// Built-in materials called by user shaders: colour and the outputs of mia_material_api.h.
#pragma once

#include "sdk/context.h"

namespace oriel::sdk {

/// Shades a built-in material at the point and writes its colour. If the calling shader set a
/// storage of mia_material_api.h, the outputs are written to it.
/// Source:  manual 5.1.1, 5.1.2.
bool shade_material(const ShaderNode& node, ShadingPoint& point, miState& state, void* result);

}  // namespace oriel::sdk
