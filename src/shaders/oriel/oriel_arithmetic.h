// SPDX-License-Identifier: Apache-2.0
// oriel_math, oriel_blend, oriel_hue_saturation: arithmetic of colours, as in node editors.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   Nodes of modelling programs that compute parameters. Declared by `$include "oriel.mi"`.
// Model
//   Each channel by itself; alpha is that of the first input. Operations without a result (division
//   by 0, roots and logarithms of negative numbers) give 0, infinite results give 0.
//   oriel_blend mixes `below` and the operation of both by `factor`, which is clamped to 0..1; hue,
//   saturation, colour and value replace these components of `below` in the HSV space.
// Source:  Blender's manual, Math Node, Mix Node, Hue Saturation Value Node; Smith, "Color Gamut
//          Transform Pairs", 1978 (HSV).
// Checked: tests/effects; tests/blender against Cycles
extern const ShaderSpec kOrielMath;
extern const ShaderSpec kOrielBlend;
extern const ShaderSpec kOrielHueSaturation;

}  // namespace oriel
