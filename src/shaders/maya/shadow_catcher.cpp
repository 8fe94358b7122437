// SPDX-License-Identifier: Apache-2.0
#include "shaders/maya/shadow_catcher.h"

#include "runtime/tracer.h"
#include "runtime/world.h"

namespace oriel {

Rgb lit_share(ShadingPoint& point) {
  if (!point.tracer || !point.world) return Rgb(1);
  Rgb arriving(0), unshadowed(0);
  for (std::size_t i = 0; i < point.world->lights.size(); ++i) {
    if (point.world->lights[i].photons.only) continue;
    const auto light = point.tracer->light(static_cast<int>(i), point);
    if (!light) continue;
    const float cosine = dot(point.normal, light->wi);
    if (cosine <= 0) continue;
    arriving += light->colour * cosine;
    unshadowed += light->unshadowed * cosine;
  }
  const auto share = [](float part, float all) { return all > 0 ? clamp01(part / all) : 1.0f; };
  return Rgb(share(arriving.x, unshadowed.x), share(arriving.y, unshadowed.y),
             share(arriving.z, unshadowed.z));
}

}  // namespace oriel
