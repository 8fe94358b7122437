// SPDX-License-Identifier: Apache-2.0
// mib_shadow_transparency: a colour filter for shadows.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// Light behind a blocker = light x colour x (1 - a (1 - transp)), a the colour's alpha.
///
/// Model:   light lists as materials have them: mode 1 and 0 with a list: its lights alone are
///          filtered, 2: all but those, 4 and 0 without a list: all. Light that is not filtered
///          passes as it is. The environment, and rays that do not know their light, count as a
///          light on no list.
/// Source:  reference of the base shaders; the vendor's page of the shader for the alpha ("a
/// nonzero
///          transparency or an alpha < 1 let shadow rays pass"). That unlisted lights pass
///          unfiltered is inferred.
/// Checked: ShadowShader.* in tests/analytic.
extern const ShaderSpec kMibShadowTransparency;

}  // namespace oriel
