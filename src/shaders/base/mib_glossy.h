// SPDX-License-Identifier: Apache-2.0
// mib_glossy_reflection and mib_glossy_refraction: blurred rays blended over other materials.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// Model:   base x (1 - k) + reflection x k, k = reflection_color x weight; the weight goes from
///          that of the facing view to that of the edge as (1 - cosine)^edge_factor. That the two
///          are blended, not added, and that a spread is a GGX roughness are guesses. Fading with
///          the distance is linear, to the environment.
/// Source:  parameters of the public declaration.
/// Checked: GlossyNodes.* in tests/analytic.
extern const ShaderSpec kMibGlossyReflection;
/// The same with refraction; seen from behind, back_material stands for top_material. What lies
/// deeper than max_distance is black: deep_material is left out.
extern const ShaderSpec kMibGlossyRefraction;

}  // namespace oriel
