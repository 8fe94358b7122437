// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_light.h"

#include "shaders/base/light_falloff.h"

namespace oriel {
namespace {

struct OrielLightParams {
  Rgba color;
  float cone, diffuse, glossy;
  bool shadow;
  LightProfileRef profile;
};

LightValue light_by_lobe(const Call& call, const LightCall& l) {
  const auto& p = call.as<OrielLightParams>();
  LightValue v{.shadow = p.shadow, .affects_diffuse = p.diffuse, .affects_specular = p.glossy};
  Rgb c = rgb(p.color);
  if (l.light.shape != LightShape::Directional) {
    c *= distance_decay(l.light, l.distance);
    if (l.light.profile_placement)
      c *= in_spread(l.light, l.direction) ? l.light.profile_placement.candela(l.direction) * kInvPi
                                           : 0;
    else
      c *= std::min(l.emitter_cos, 1.0f) / (4 * kPi) * spot_share(l.light, l.direction, p.cone);
  }
  v.colour = c;
  return v;
}

constexpr ParamSpec kOrielLightRows[] = {
    {ORIEL_PARAM(OrielLightParams, color), .fallback = {1, 1, 1, 1},
     .doc = "Energy; factor of the profile; of directional lights as that of mib_light_infinite."},
    {ORIEL_PARAM(OrielLightParams, cone), .min = -1, .max = 1,
     .doc = "Cosine of the inner cone of a spot."},
    {ORIEL_PARAM(OrielLightParams, diffuse), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Factor on diffuse surfaces."},
    {ORIEL_PARAM(OrielLightParams, glossy), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Factor in reflections, refractions and highlights."},
    {ORIEL_PARAM(OrielLightParams, shadow), .fallback = {1},
     .doc = "Whether the light casts shadows."},
    {ORIEL_PARAM(OrielLightParams, profile), .doc = "Photometric profile in candela; null = none."},
};

}  // namespace

const ShaderSpec kOrielLight = {
    .name = "oriel_light",
    .library = "oriel",
    .apply = kApplyLight,
    .doc = "Light with factors for diffuse surfaces and for reflections.",
    .params = kOrielLightRows,
    .params_size = sizeof(OrielLightParams),
    .light =
        {
            .evaluate = light_by_lobe,
            .profile =
                [](const void* params, const Light& light) {
                  const photometry::LightProfile* own =
                      static_cast<const OrielLightParams*>(params)->profile.profile;
                  return own ? own : light.profile_placement.profile;
                },
        },
};

}  // namespace oriel
