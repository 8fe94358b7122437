// SPDX-License-Identifier: Apache-2.0
// mib_shadow_transparency: a colour filter for shadows.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// Light behind an occluder = light x colour x (1 - a (1 - transp)), with a the alpha of the
/// colour.
///
/// Model:   light lists as in materials: mode 1, and 0 with a list: only lights in the list are
///          filtered; 2: only lights not in the list; 4, and 0 without a list: all lights.
///          Unfiltered light passes unchanged. The environment and rays without a known light count
///          as a light on no list.
/// Source:  reference of the base shaders; the vendor's page on the shader for alpha ("a nonzero
///          transparency or an alpha < 1 let shadow rays pass"). That unlisted lights pass
///          unfiltered is inferred.
/// Checked: ShadowShader.* in tests/analytic.
extern const ShaderSpec kMibShadowTransparency;

}  // namespace oriel
