// SPDX-License-Identifier: Apache-2.0
// What the air before a surface does to its light.
#include "transport/path_walk.h"
#include "transport/scene_tracer.h"

namespace oriel {

/// At a surface, t from where the ray began. Rays in a medium, and those that find no surface, are
/// left alone: an environment knows its own air.
void Path::pass_air(const ShadingPoint& end, float t) {
  if (world_.air.empty() && world_.air_of_eye.empty()) return;
  if (!medium_.medium.clear()) return;
  ShadingPoint point;
  point.raster = raster_;
  point.ray_kind = kind_;
  point.blurred = blurred_;
  point.position = end.position;
  point.normal = point.geometric_normal = -ray_.dir;
  point.ray_origin = end.position - ray_.dir * t;
  point.ray_direction = ray_.dir;
  point.ray_length = t;
  point.world = &world_;
  SceneTracer tracer(world_, sampler_, counts_);
  point.tracer = &tracer;
  // The last shader of a list takes what the ones before it left: it is the nearest to the eye.
  const auto pass = [&](const NodeList& nodes) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
      const AirValue air = (*node)->with_params(
          point, [&](const Call& call) { return (*node)->spec().volume(call); });
      add(component_, throughput_ * air.added);
      dim(air.kept);
    }
  };
  if (kind_ == RayKind::Eye) pass(world_.air_of_eye);
  pass(world_.air);
}

}  // namespace oriel
