// SPDX-License-Identifier: Apache-2.0
#include "runtime/material.h"

#include <utility>

namespace oriel {

void shade(const NodeList& shaders, ShadingPoint& point, Closure& closure) {
  for (const ShaderNode* node : shaders) {
    const ShaderSpec& spec = node->spec();
    if (spec.material.fill) {
      node->with_params(point, [&](const Call& call) { spec.material.fill(call, closure); });
    } else if (spec.value) {
      // A value shader as surface: its result is the emission (also bump shaders in a list).
      closure.emission = rgb(node->color(point));
    }
  }
}

namespace {

void shade(const Material& material, const NodeList& shaders, ShadingPoint& point,
           Closure& closure) {
  point.material = &material;
  if (!material.volume.empty()) closure.volume = &material.volume;
  shade(shaders, point, closure);
}

}  // namespace

void shade(const Material& material, ShadingPoint& point, Closure& closure) {
  shade(material, material.surface, point, closure);
}

void shade_for_photons(const Material& material, ShadingPoint& point, Closure& closure) {
  shade(material, material.photon_surface.empty() ? material.surface : material.photon_surface,
        point, closure);
}

void shade_blocker(const Material& material, ShadingPoint& point, Closure& closure) {
  point.unbent = true;
  if (!material.volume.empty()) closure.volume = &material.volume;
  if (!material.filters_shadows()) return shade(material.surface, point, closure);
  const RayKind kind = std::exchange(point.ray_kind, RayKind::Shadow);
  shade(material.shadow_surface, point, closure);
  point.ray_kind = kind;
}

Rgb filter_light(const Material& material, ShadingPoint& point, Rgb light) {
  point.unbent = true;
  const RayKind kind = std::exchange(point.ray_kind, RayKind::Shadow);
  for (const ShaderNode* node : material.shadow)
    light = node->with_params(
        point, [&](const Call& call) { return node->spec().material.shadow(call, light); });
  point.ray_kind = kind;
  return light;
}

}  // namespace oriel
