// SPDX-License-Identifier: Apache-2.0
// mib_glossy_reflection and mib_glossy_refraction: glossy rays blended over other materials.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// Model:   base x (1 - k) + reflection x k, k = reflection_color x weight. The weight changes from
///          facing to edge by (1 - cosine)^edge_factor. Blending (instead of adding) and
///          interpreting a spread as GGX roughness are guesses. The distance falloff is linear, to
///          the environment.
/// Source:  parameters of the public declaration.
/// Checked: GlossyNodes.* in tests/analytic.
extern const ShaderSpec kMibGlossyReflection;
/// Same with refraction; from behind, back_material replaces top_material. Beyond max_distance the
/// result is black: deep_material is ignored.
extern const ShaderSpec kMibGlossyRefraction;

}  // namespace oriel
