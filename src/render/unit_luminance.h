// SPDX-License-Identifier: Apache-2.0
// cd/m2 of one unit of a pixel in a scene, and the source of this value.
#pragma once

#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "runtime/world.h"

namespace oriel {

struct UnitLuminance {
  float cd_m2 = 1;
  std::string by;  ///< name of the shader that says it; empty: nobody does
};

/// What the scene's shaders say of it.
///
/// Model:   the first exposure that takes pixels for a physical unit (cm2_factor), lens shaders
///          before `outputs`; else the first sun or sky, whose rgb_unit_conversion c makes the unit
///          1 / (pi c); else 1.
/// Errors:  OR-RN-045 exposure and sun or sky disagree by more than kUnitTolerance (a warning; the
///          exposure's word counts).
/// Checked: UnitLuminance.* in unit_luminance_test.cpp
UnitLuminance unit_luminance(const World& world, const NodeList& outputs, Diagnostics& diagnostics);

/// .318 for 1 / pi is meant.
inline constexpr float kUnitTolerance = 0.02f;

/// cd/m2 of one unit of a pixel by a sun's or sky's rgb_unit_conversion; nothing for others.
std::optional<float> luminance_of_unit(const ShaderNode& node);

}  // namespace oriel
