// SPDX-License-Identifier: Apache-2.0
// A path's ray that hits the environment.
#pragma once

#include "runtime/shader_node.h"
#include "runtime/shading_point.h"

namespace oriel {

struct EnvironmentRay {
  Vec3 origin{0};
  Vec3 direction{0, 0, -1};
  RayKind kind = RayKind::Environment;
  Vec2 raster{0};  ///< of the camera sample, as in ShadingPoint
  bool blurred = false;
  float roughness = 0;  ///< see ShadingPoint
};

/// Radiance, in pixel units, of environment shaders; alpha is that of the last shader.
Rgba environment_radiance(const NodeList& shaders, const World& world, const EnvironmentRay& ray);

}  // namespace oriel
