// SPDX-License-Identifier: Apache-2.0
#include "render/unit_luminance.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "runtime/color_mapping.h"
#include "sky/units.h"

namespace oriel {

std::optional<float> luminance_of_unit(const ShaderNode& node) {
  for (const ParamSpec& p : node.spec().params) {
    if (p.type != ParamType::Color || std::strcmp(p.name, "rgb_unit_conversion") != 0) continue;
    if (node.connected(p.offset)) continue;
    Rgba unit;
    convert_value(p.type, &node.constants<std::byte>() + p.offset, p.type, &unit);
    const Rgb scale = sky::unit_conversion(rgb(unit));
    const float mean = (scale.x + scale.y + scale.z) / 3;
    // 1 / pi gives candela per square metre.
    if (mean > 0) return kInvPi / mean;
  }
  return std::nullopt;
}

UnitLuminance unit_luminance(const World& world, const NodeList& outputs,
                             Diagnostics& diagnostics) {
  UnitLuminance taken, put;
  for (const NodeList* list : {&world.lens, &outputs})
    for (const ShaderNode* node : *list)
      if (const float cd_m2 = lens_traits(*node).luminance; taken.by.empty() && cd_m2 > 0)
        taken = {cd_m2, node->spec().name};
  for (const auto& node : world.nodes) {
    const std::optional<float> cd_m2 = luminance_of_unit(*node);
    if (!cd_m2) continue;
    put = {*cd_m2, node->spec().name};
    break;
  }
  if (taken.by.empty()) return put;
  if (!put.by.empty() && std::abs(taken.cd_m2 / put.cd_m2 - 1) > kUnitTolerance)
    diagnostics.warning(
        "OR-RN-045", {},
        fmt::format(
            "one pixel unit is {1:.4g} cd/m2 by {0}, but {3:.4g} cd/m2 by {2}; the first is "
            "used",
            taken.by, taken.cd_m2, put.by, put.cd_m2),
        fmt::format("--unit-luminance {:.6g} uses the second", put.cd_m2));
  return taken;
}

}  // namespace oriel
