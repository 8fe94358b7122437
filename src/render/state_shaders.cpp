// SPDX-License-Identifier: Apache-2.0
#include "render/state_shaders.h"

namespace oriel {

void call_state_shaders(const World& world, Vec2 raster, EyeSample::Moment moment,
                        PathResult& sample, std::span<Rgba> buffers) {
  if (world.state_shaders.empty()) return;
  const Camera::Ray ray = world.camera.ray(raster);
  ShadingPoint point;
  point.raster = raster;
  point.world = &world;
  point.ray_origin = ray.origin;
  point.ray_direction = ray.direction;
  Rgba colour(sample.radiance.x, sample.radiance.y, sample.radiance.z, sample.alpha);
  EyeSample eye{moment, colour, sample.depth > 0, buffers};
  for (const ShaderNode* node : world.state_shaders)
    node->with_params(point, [&](const Call& call) { node->spec().around_sample(call, eye); });
  sample.radiance = rgb(colour);
  sample.alpha = clamp01(colour.a);
}

}  // namespace oriel
