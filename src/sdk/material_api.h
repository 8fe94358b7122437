// SPDX-License-Identifier: Apache-2.0
// The renderer's materials under users' shaders: their colour, and their parts as
// mia_material_api.h hands them out.
#pragma once

#include "sdk/context.h"

namespace oriel::sdk {

/// Shades a material of the renderer at the point; writes its colour, and where the shader above
/// left a storage of mia_material_api.h, its parts into that.
/// Source:  manual 5.1.1, 5.1.2.
bool shade_material(const ShaderNode& node, ShadingPoint& point, miState& state, void* result);

}  // namespace oriel::sdk
