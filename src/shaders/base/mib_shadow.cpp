// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_shadow.h"

#include <algorithm>

#include "runtime/shader_node.h"

namespace oriel {
namespace {

struct ShadowTransparency {
  Rgba color, transp;
  int mode;
  ArrayView<LightRef> lights;
};

constexpr ParamSpec kShadowTransparencyRows[] = {
    {ORIEL_PARAM(ShadowTransparency, color),
     .doc = "Colour multiplied with the light; alpha 0 transmits all light.",
     .declared_default = false},
    {ORIEL_PARAM(ShadowTransparency, transp), .doc = "Fraction of light transmitted at alpha 1.",
     .declared_default = false},
    {ORIEL_PARAM(ShadowTransparency, mode),
     .doc = "Light selection: 0 the list or all, 1 the list, 2 all but the list, 4 all.",
     .declared_default = false},
    {ORIEL_PARAM(ShadowTransparency, lights), .doc = "Light list.", .declared_default = false},
};

/// Whether shadows of the light are filtered; -1 is a light on no list.
bool applies(const ShadowTransparency& p, int light) {
  const bool listed = std::any_of(p.lights.begin(), p.lights.end(),
                                  [&](LightRef l) { return l.index == light && light >= 0; });
  if (p.mode == 1 || (p.mode == 0 && p.lights.size > 0)) return listed;
  if (p.mode == 2) return !listed;
  return true;
}

Rgb passes(const ShadowTransparency& p) {
  return rgb(p.color) * (Rgb(1) - (Rgb(1) - rgb(p.transp)) * p.color.a);
}

}  // namespace

const ShaderSpec kMibShadowTransparency = {
    .name = "mib_shadow_transparency",
    .library = "base",
    .version = 1,
    .apply = kApplyShadow,
    .doc = "Shadow shader of a material that filters the light through an object.",
    .params = kShadowTransparencyRows,
    .params_size = sizeof(ShadowTransparency),
    .material = {
        .shadow =
            [](const Call& call, const Rgb& light) {
              const auto& p = call.as<ShadowTransparency>();
              return applies(p, call.point.light) ? light * passes(p) : light;
            },
        .may_transmit =
            [](const ShaderNode& node) {
              const auto& p = node.constants<ShadowTransparency>();
              return max_component(passes(p)) > 0 || p.lights.size > 0 || p.mode == 1 ||
                     node.connected(offsetof(ShadowTransparency, color)) ||
                     node.connected(offsetof(ShadowTransparency, transp)) ||
                     node.connected(offsetof(ShadowTransparency, mode));
            },
    },
};

}  // namespace oriel
