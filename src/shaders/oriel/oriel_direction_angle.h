// SPDX-License-Identifier: Apache-2.0
// oriel_direction_angle: the angle of a direction in a picture.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   "anisotropy_rotation" of a mia_material, for pictures whose red and green are the cosine and
//   the sine of the direction of brushing. Declared by `$include "oriel.mi"`.
// Model
//   atan2(2 green - 1, 2 red - 1) / 2 pi + offset, in turns; the offset alone without a direction.
//   The picture is filtered before the angle is taken, so it may pass a whole turn.
// Source:  KHR_materials_anisotropy, anisotropyTexture.
// Checked: tests/effects
extern const ShaderSpec kOrielDirectionAngle;

}  // namespace oriel
