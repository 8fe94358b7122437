// SPDX-License-Identifier: Apache-2.0
// What the air on the way of a ray does to its light, and paths that are scattered there.
#include <utility>

#include "transport/path/path_walk.h"
#include "transport/scene_tracer.h"

namespace oriel {

/// Air of some shaders. True: the path goes on from a place in the air and not to where it went.
/// Both ways on are weighed by their chance; what light sources bring to the place is in `added`.
bool Path::pass_volume(const NodeList& nodes, ShadingPoint& way, bool endless) {
  const bool scatters = settings_.indirect && diffuse_bounces_ < settings_.diffuse_bounces;
  // The last shader of a list takes what the ones before it left: it is the nearest to the eye.
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    const ShaderSpec& spec = (*node)->spec();
    if (endless && !spec.volume.acts_on_endless_rays) continue;
    const VolumeValue volume =
        (*node)->with_params(way, [&](const Call& call) { return spec.volume.evaluate(call); });
    add(on_way(), throughput_ * volume.added, layer_of_rest());
    const float turned = scatters ? max_component(volume.scattered) : 0;
    if (!(turned > 0)) {
      dim(volume.kept);
      continue;
    }
    const float p = turned / (turned + max_component(volume.kept));
    if (way.tracer->next().x >= p) {
      dim(volume.kept / (1 - p));
      continue;
    }
    throughput_ *= volume.scattered * indirect_factor() / p;
    lights_ = throughput_;
    kind_ = RayKind::FinalGather;
    after_diffuse_ = aov_fixed_ = true;
    blurred_ = false;
    at_aov_surface_ = leaving_aov_surface_ = alpha_open_ = false;
    reflections_ = refractions_ = 0;
    ++bounces_;
    ++diffuse_bounces_;
    cone_.spread = std::max(cone_.spread, kDiffuseSpread);
    occlusion_ = Rgb(1);
    near_distance_ = 0;
    environment_ = nullptr;
    fading_ = {};
    reach_ = kInfinity;
    // Against no lights: it passes through them unseen.
    from_.weighed = true;
    std::construct_at(&from_.lights);
    from_.group = LobeGroup::Diffuse;
    from_.passed = volume_passed_ = 0;
    ray_ = {.time = ray_.time};
    ray_.org = left_ = volume.place;
    ray_.dir = volume.onward;
    ray_.mask = mask();
    return true;
  }
  return false;
}

/// At a surface, t from where the ray began. Rays in a medium are left alone. In an object with
/// volume shaders these are its air.
bool Path::pass_volume(const ShadingPoint& end, float t) {
  const NodeList& volume = medium_.volume ? *medium_.volume : world_.camera_volume;
  const float length = t - std::exchange(volume_passed_, t);
  if ((volume.empty() && world_.eye_volume.empty()) || !(length > 0)) return false;
  if (!medium_.medium.clear()) return false;
  ShadingPoint way;
  way.raster = raster_;
  way.ray_kind = kind_;
  way.blurred = blurred_;
  way.position = end.position;
  way.normal = way.geometric_normal = -ray_.dir;
  way.ray_origin = end.position - ray_.dir * length;
  way.ray_direction = ray_.dir;
  way.ray_length = length;
  way.world = &world_;
  way.time = ray_.time;
  SceneTracer tracer(world_, sampler_, counts_, this);
  way.tracer = &tracer;
  return (kind_ == RayKind::Eye && pass_volume(world_.eye_volume, way, false)) ||
         pass_volume(volume, way, false);
}

/// Before what lies beyond all surfaces. An environment knows its own air, but for what has an end.
bool Path::pass_volume_to_infinity() {
  if (world_.camera_volume.empty() && world_.eye_volume.empty()) return false;
  if (!medium_.medium.clear() || fading_.distance > 0 || !std::isinf(reach_)) return false;
  ShadingPoint way;
  way.raster = raster_;
  way.ray_kind = kind_;
  way.blurred = blurred_;
  way.normal = way.geometric_normal = -ray_.dir;
  way.ray_origin = way.position = ray_.org - ray_.dir * from_.passed;
  way.ray_direction = ray_.dir;
  way.ray_length = kInfinity;
  way.world = &world_;
  way.time = ray_.time;
  SceneTracer tracer(world_, sampler_, counts_, this);
  way.tracer = &tracer;
  return (kind_ == RayKind::Eye && pass_volume(world_.eye_volume, way, true)) ||
         pass_volume(world_.camera_volume, way, true);
}

}  // namespace oriel
