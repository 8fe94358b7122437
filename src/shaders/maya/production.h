// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for the production library.
#pragma once

#include <span>

#include "runtime/shader_spec.h"

namespace oriel {

/// mip_gamma_gain, mip_rayswitch, mip_matteshadow and mip_matteshadow_mtl.
///
/// Source:  Softimage 2012 to 2014 user guide, pages mip_gamma_gain, mip_rayswitch,
/// mip_matteshadow. Checked: ProductionShaders.* in tests/shader_binding, ShadowCatchers.* in
/// tests/analytic.
std::span<const ShaderSpec> production_shaders();

}  // namespace oriel
