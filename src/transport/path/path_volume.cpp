// SPDX-License-Identifier: Apache-2.0
// What the air on the way of a ray does to its light, and paths that are scattered there.
#include <utility>

#include "transport/path/path_walk.h"
#include "transport/scene_tracer.h"

namespace oriel {

/// Air of some shaders. True: the path goes on from a place in the air and not to where it went.
/// Both ways on are weighed by their chance; what light sources bring to the place is in `added`.
bool Path::pass_volume(const NodeList& nodes, ShadingPoint& way, bool endless) {
  const bool scatters = settings_.indirect && depth_.diffuse_bounces < settings_.diffuse_bounces;
  // The last shader of a list takes what the ones before it left: it is the nearest to the eye.
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    const ShaderSpec& spec = (*node)->spec();
    if (endless && !spec.volume.acts_on_endless_rays) continue;
    const VolumeValue volume =
        (*node)->with_params(way, [&](const Call& call) { return spec.volume.evaluate(call); });
    add(aov_.on_way(), light_.throughput * volume.added, layer_of_rest());
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
    light_.throughput *= volume.scattered * indirect_factor() / p;
    light_.lights = light_.throughput;
    way_.kind = RayKind::FinalGather;
    depth_.after_diffuse = aov_.fixed = true;
    way_.blurred = false;
    aov_.at_surface = aov_.leaving = eye_hit_.alpha_open = false;
    depth_.reflections = depth_.refractions = 0;
    ++depth_.bounces;
    ++depth_.diffuse_bounces;
    way_.cone.spread = std::max(way_.cone.spread, kDiffuseSpread);
    light_.occlusion = Rgb(1);
    light_.near_distance = 0;
    way_.environment = nullptr;
    fading_ = {};
    way_.reach = kInfinity;
    // Against no lights: it passes through them unseen.
    from_.weighed = true;
    std::construct_at(&from_.lights);
    from_.group = LobeGroup::Diffuse;
    from_.passed = way_.volume_passed = 0;
    way_.leave_volume_point(volume.place, volume.onward, mask());
    return true;
  }
  return false;
}

/// At a surface, t from where the ray began. Rays in a medium are left alone. In an object with
/// volume shaders these are its air.
bool Path::pass_volume(const ShadingPoint& end, float t) {
  const NodeList& volume = way_.medium.volume ? *way_.medium.volume : world_.camera_volume;
  const float length = t - std::exchange(way_.volume_passed, t);
  if ((volume.empty() && world_.eye_volume.empty()) || !(length > 0)) return false;
  if (!way_.medium.medium.clear()) return false;
  ShadingPoint way =
      way_.volume_segment(world_, end.position - way_.ray.dir * length, end.position, length);
  way.raster = raster_;
  way.blurred = way_.blurred;
  SceneTracer tracer(world_, sampler_, counts_, this);
  way.tracer = &tracer;
  return (way_.kind == RayKind::Eye && pass_volume(world_.eye_volume, way, false)) ||
         pass_volume(volume, way, false);
}

/// Before what lies beyond all surfaces. An environment knows its own air, but for what has an end.
bool Path::pass_volume_to_infinity() {
  if (world_.camera_volume.empty() && world_.eye_volume.empty()) return false;
  if (!way_.medium.medium.clear() || fading_.distance > 0 || !std::isinf(way_.reach)) return false;
  const Vec3 origin = way_.ray.org - way_.ray.dir * from_.passed;
  ShadingPoint way = way_.volume_segment(world_, origin, origin, kInfinity);
  way.raster = raster_;
  way.blurred = way_.blurred;
  SceneTracer tracer(world_, sampler_, counts_, this);
  way.tracer = &tracer;
  return (way_.kind == RayKind::Eye && pass_volume(world_.eye_volume, way, true)) ||
         pass_volume(world_.camera_volume, way, true);
}

}  // namespace oriel
