// SPDX-License-Identifier: Apache-2.0
// Volume shaders along a ray: absorption, added light, scattering.
#include <utility>

#include "transport/path/path_walk.h"
#include "transport/scene_tracer.h"

namespace oriel {

/// Evaluates volume shaders on a segment. True: the path was scattered and continues from a point
/// in the volume. Scattering and transmission are chosen at random and divided by their
/// probability. `added` contains the light of light sources at the point.
bool Path::pass_volume(const NodeList& nodes, ShadingPoint& way, bool endless) {
  const bool scatters = settings_.indirect && depth_.diffuse_bounces < settings_.diffuse_bounces;
  // The last shader of a list acts on the result of the others, so it is nearest to the camera.
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    const ShaderSpec& spec = (*node)->spec();
    if (endless && !spec.volume.acts_on_endless_rays) continue;
    const VolumeValue volume =
        (*node)->with_params(way, [&](const Call& call) { return spec.volume.evaluate(call); });
    add(aov_.on_way(), light_.throughput * volume.added, layer_of_rest());
    const float turned = scatters ? max_component(volume.scattered) : 0;
    if (!(turned > 0)) {
      dim(volume.transmittance);
      continue;
    }
    const float p = turned / (turned + max_component(volume.transmittance));
    if (way.tracer->next().x >= p) {
      dim(volume.transmittance / (1 - p));
      continue;
    }
    light_.throughput *= volume.scattered * indirect_factor() / p;
    light_.lights = light_.throughput;
    way_.kind = RayKind::FinalGather;
    depth_.after_diffuse = aov_.fixed = true;
    caustics_ = nullptr;
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
    // No lights were sampled here, so lights are invisible to the ray.
    from_.weighed = true;
    std::construct_at(&from_.lights);
    from_.point = nullptr;
    from_.surfaces_on_diffuse = from_.surfaces_in_reflections = false;
    from_.group = LobeGroup::Diffuse;
    from_.passed = way_.volume_passed = 0;
    way_.leave_volume_point(volume.place, volume.onward, mask());
    return true;
  }
  return false;
}

/// The segment up to a surface or visible light at distance t: by the volume shaders of the object
/// that the ray is in, else by those of the camera. Rays in an absorbing medium are not affected.
bool Path::pass_volume(const Vec3& end, float t) {
  const NodeList& volume = way_.medium.volume ? *way_.medium.volume : world_.camera_volume;
  const float length = t - std::exchange(way_.volume_passed, t);
  if ((volume.empty() && world_.eye_volume.empty()) || !(length > 0)) return false;
  if (!way_.medium.medium.clear()) return false;
  ShadingPoint way = way_.volume_segment(world_, end - way_.ray.dir * length, end, length);
  way.raster = raster_;
  way.blurred = way_.blurred;
  SceneTracer tracer(world_, sampler_, counts_, this);
  way.tracer = &tracer;
  return (way_.kind == RayKind::Eye && pass_volume(world_.eye_volume, way, false)) ||
         pass_volume(volume, way, false);
}

/// The segment to infinity. Only volume shaders that act on infinite rays apply; environments
/// include their own haze.
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
