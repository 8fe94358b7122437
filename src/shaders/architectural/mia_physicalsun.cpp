// SPDX-License-Identifier: Apache-2.0
// mia_physicalsun: colour, strength and softness of sunlight for a directional light.
#include "shaders/architectural/mia_sun_sky.h"

#include <cmath>

#include "runtime/light.h"
#include "sky/daylight.h"
#include "sky/physical_sky.h"

namespace oriel {
namespace {

struct MiaPhysicalsunParams {
  bool on;
  float multiplier;
  Rgba rgb_unit_conversion;
  float haze, redblueshift, saturation, horizon_height, shadow_softness;
  int samples;
  Vec3 photon_bbox_min, photon_bbox_max;
  bool automatic_photon_energy, y_is_up;
  int illuminance_mode;
  float direct_normal_illuminance;
};

constexpr ParamSpec kMiaPhysicalsunRows[] = {
    {ORIEL_PARAM(MiaPhysicalsunParams, on), .fallback = {1}, .doc = "Turns the sun on."},
    {ORIEL_PARAM(MiaPhysicalsunParams, multiplier), .fallback = {1}, .min = 0,
     .doc = "Scales the light."},
    {ORIEL_PARAM(MiaPhysicalsunParams, rgb_unit_conversion), .fallback = {.0001f, .0001f, .0001f},
     .unit = "1/lux", .doc = "Lux to scene units; 0 0 0 maps 80000 lux to 1."},
    {ORIEL_PARAM(MiaPhysicalsunParams, haze), .min = 0, .max = 15,
     .doc = "Haze in the air: 0 clear, 15 overcast."},
    {ORIEL_PARAM(MiaPhysicalsunParams, redblueshift), .min = -1, .max = 1,
     .doc = "-1 very blue, 1 very red."},
    {ORIEL_PARAM(MiaPhysicalsunParams, saturation), .fallback = {1}, .min = 0, .max = 2,
     .doc = "0 grey, 1 as is."},
    {ORIEL_PARAM(MiaPhysicalsunParams, horizon_height), .min = -10, .max = 10,
     .doc = "Where the sun sets."},
    {ORIEL_PARAM(MiaPhysicalsunParams, shadow_softness), .fallback = {1}, .min = 0,
     .doc = "Size of the sun for shadows, 1 = the true one."},
    {ORIEL_PARAM(MiaPhysicalsunParams, samples), .fallback = {8}, .min = 0,
     .doc = "0: hard shadows. Any other count: soft, as many samples as the picture takes."},
    {ORIEL_PARAM(MiaPhysicalsunParams, photon_bbox_min),
     .doc = "Box photons are aimed at, in the light's space.", .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalsunParams, photon_bbox_max),
     .doc = "Its other corner; both 0 0 0: the whole scene.", .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalsunParams, automatic_photon_energy),
     .doc = "Photons as strong as the light, whatever its energy says.", .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalsunParams, y_is_up), .doc = "Y is up, else Z.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalsunParams, illuminance_mode),
     .doc = "Not 0: as strong as direct_normal_illuminance, in the haze's colour."},
    {ORIEL_PARAM(MiaPhysicalsunParams, direct_normal_illuminance), .unit = "lux",
     .doc = "Illuminance of a surface facing the sun."},
};

/// Energy and aim of the sun's photons. A box that is turned is aimed at as a ball around it.
void photons_of(const void* params, const Light& light, LightPhotons& photons) {
  const MiaPhysicalsunParams& p = *static_cast<const MiaPhysicalsunParams*>(params);
  if (p.automatic_photon_energy) photons.emission.energy.reset();
  const Vec3 centre = (p.photon_bbox_min + p.photon_bbox_max) / 2;
  const Vec3 corner = transform_vector(p.photon_bbox_max - centre, light.to_world);
  const Vec3 reach(length(corner) / std::sqrt(3.0f)),
      middle = transform_point(centre, light.to_world);
  if (reach.x > 0) photons.emission.aim = geom::Box3(middle - reach, middle + reach);
}

struct SunState final : ShaderState {
  Rgb colour{0};
};

}  // namespace

const ShaderSpec kMiaPhysicalSun = {
    .name = "mia_physicalsun",
    .library = "architectural",
    .version = 6,
    .apply = kApplyLight | kApplyEmitter,
    .doc = "Sunlight for a directional light: colour and strength by haze and height.",
    .params = kMiaPhysicalsunRows,
    .params_size = sizeof(MiaPhysicalsunParams),
    .light =
        [](const Call&, const LightCall& call) {
          LightValue value;
          value.is_sun = true;
          if (const auto* state = static_cast<const SunState*>(call.light.state.get()))
            value.colour = state->colour;
          return value;
        },
    .prepare_light = [](const void* params, const Light& light) -> std::unique_ptr<ShaderState> {
      const MiaPhysicalsunParams& p = *static_cast<const MiaPhysicalsunParams*>(params);
      auto state = std::make_unique<SunState>();
      // Directional lights only, as the manual says.
      if (light.shape == LightShape::Directional)
        state->colour =
            sky::sun_colour({.on = p.on,
                             .multiplier = p.multiplier,
                             .rgb_unit_conversion = rgb(p.rgb_unit_conversion),
                             .haze = p.haze,
                             .redblueshift = p.redblueshift,
                             .saturation = p.saturation,
                             .horizon_height = p.horizon_height,
                             .y_is_up = p.y_is_up,
                             .normal_illuminance = p.illuminance_mode != 0
                                                       ? std::optional(p.direct_normal_illuminance)
                                                       : std::nullopt},
                            -light.direction);
      return state;
    },
    .light_cone =
        [](const void* params) {
          const MiaPhysicalsunParams& p = *static_cast<const MiaPhysicalsunParams*>(params);
          return p.samples == 0 ? 0.0f : sky::sun_cone_angle(p.shadow_softness, p.haze);
        },
    .photons = photons_of,
};

}  // namespace oriel
