// SPDX-License-Identifier: Apache-2.0
#include "runtime/material.h"

namespace oriel {

void shade(const Material& material, ShadingPoint& point, Closure& closure) {
  for (const ShaderNode* node : material.surface) {
    const ShaderSpec& spec = node->spec();
    if (spec.material) {
      node->with_params(point, [&](const Call& call) { spec.material(call, closure); });
    } else if (spec.value) {
      // A value shader as surface: what it returns is what is seen (also bump shaders in a list).
      closure.emission = rgb(node->color(point));
    }
  }
}

}  // namespace oriel
