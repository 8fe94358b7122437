// SPDX-License-Identifier: Apache-2.0
// mia_light_surface: visible surface of a light source whose illumination comes from a light.
//
// Model:   color * (sum of the lights * lights_multiplier + intensity). The lights are evaluated as
//          the radiance of a facing white surface without shadows: at the shading point or, if
//          lights_eval_point is not 0, at that position in the space of each light, independent of
//          the surface. A bulb inside a light with a profile is thus uniform.
#include "shaders/architectural/mia_light_surface.h"

#include "runtime/world.h"

namespace oriel {
namespace {

struct MiaLightSurfaceParams {
  Rgba color;
  float intensity, fg_contrib, refl_contrib;
  bool use_lights;
  float lights_multiplier;
  Vec3 lights_eval_point;
  ArrayView<LightRef> lights;
};

constexpr ParamSpec kMiaLightSurfaceRows[] = {
    {ORIEL_PARAM(MiaLightSurfaceParams, color), .fallback = {1, 1, 1},
     .doc = "Factor of the result."},
    {ORIEL_PARAM(MiaLightSurfaceParams, intensity), .fallback = {1},
     .doc = "Emission of the surface itself."},
    {ORIEL_PARAM(MiaLightSurfaceParams, fg_contrib), .min = 0,
     .doc = "Factor for diffuse surfaces: 1 = the surface lights the scene."},
    {ORIEL_PARAM(MiaLightSurfaceParams, refl_contrib), .min = 0, .doc = "Factor for reflections."},
    {ORIEL_PARAM(MiaLightSurfaceParams, use_lights),
     .doc = "Whether the light of `lights` is added.", .declared_default = false},
    {ORIEL_PARAM(MiaLightSurfaceParams, lights_multiplier), .fallback = {1},
     .doc = "Factor of the light of `lights`."},
    {ORIEL_PARAM(MiaLightSurfaceParams, lights_eval_point), .unit = "scene units",
     .doc = "Point where the lights are evaluated, in their object space; 0 = the visible "
            "point."},
    {ORIEL_PARAM(MiaLightSurfaceParams, lights), .doc = "Light instances to evaluate.",
     .declared_default = false},
};

/// Sum of the lights in units of light colour (runtime/light.h).
Rgb light_sum(const MiaLightSurfaceParams& p, const ShadingPoint& point) {
  Rgb sum(0);
  for (const LightRef ref : p.lights) {
    if (ref.index < 0) continue;
    const Light& light = point.world->lights[static_cast<std::size_t>(ref.index)];
    ShadingPoint at;
    at.world = point.world;
    at.ray_kind = RayKind::Light;
    const bool fixed = p.lights_eval_point != Vec3(0);
    at.position = fixed ? transform_point(p.lights_eval_point, light.to_world) : point.position;
    // The centre of a shape represents all of it, which avoids noise.
    if (const auto s = at.world->sample_light(light, at, Vec2(0.5f), RayKind::Light))
      sum += s->irradiance * kInvPi;
  }
  return sum;
}

/// The share that a ray of this type sees.
float share_seen(const MiaLightSurfaceParams& p, RayKind kind) {
  if (kind == RayKind::FinalGather) return p.fg_contrib;
  if (kind == RayKind::Reflect) return p.refl_contrib;
  return 1;
}

void value(const Call& call, void* result) {
  const MiaLightSurfaceParams& p = call.as<MiaLightSurfaceParams>();
  Rgb shown(0);
  const float share = share_seen(p, call.point.ray_kind);
  if (share != 0) {
    shown = Rgb(p.intensity);
    if (p.use_lights && call.point.world) shown += light_sum(p, call.point) * p.lights_multiplier;
    shown *= rgb(p.color) * share;
  }
  *static_cast<Rgba*>(result) = Rgba(shown.x, shown.y, shown.z, 1);
}

}  // namespace

const ShaderSpec kMiaLightSurface = {
    .name = "mia_light_surface",
    .library = "architectural",
    .version = 3,
    .apply = kApplyTexture,
    .doc =
        "Visible surface of a lamp, as bright as its light, with separate factors for "
        "each kind of ray.",
    .params = kMiaLightSurfaceRows,
    .params_size = sizeof(MiaLightSurfaceParams),
    .value = value,
};

}  // namespace oriel
