// SPDX-License-Identifier: Apache-2.0
// mia_physicalsun: colour, strength and softness of sunlight for a directional light.
#include "shaders/architectural/mia_sun_sky.h"

#include "runtime/light.h"
#include "runtime/shader_node.h"
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
  int flags;
};

constexpr ParamSpec kMiaPhysicalsunRows[] = {
    {ORIEL_PARAM(MiaPhysicalsunParams, on), .fallback = {1}, .doc = "Whether the sun is on."},
    {ORIEL_PARAM(MiaPhysicalsunParams, multiplier), .fallback = {1}, .min = 0,
     .doc = "Factor of the light."},
    {ORIEL_PARAM(MiaPhysicalsunParams, rgb_unit_conversion), .fallback = {.0001f, .0001f, .0001f},
     .unit = "1/lux", .doc = "Factor from lux to scene units; 0 0 0 maps 80000 lux to 1."},
    {ORIEL_PARAM(MiaPhysicalsunParams, haze), .min = 0, .max = 15,
     .doc = "Haze: 0 clear, 15 overcast."},
    {ORIEL_PARAM(MiaPhysicalsunParams, redblueshift), .min = -1, .max = 1,
     .doc = "Colour shift: -1 very blue, 1 very red."},
    {ORIEL_PARAM(MiaPhysicalsunParams, saturation), .fallback = {1}, .min = 0, .max = 2,
     .doc = "Saturation: 0 grey, 1 unchanged."},
    {ORIEL_PARAM(MiaPhysicalsunParams, horizon_height), .min = -10, .max = 10,
     .doc = "Elevation of the horizon where the sun sets."},
    {ORIEL_PARAM(MiaPhysicalsunParams, shadow_softness), .fallback = {1}, .min = 0,
     .doc = "Angular size of the sun for shadows; 1 = true size."},
    {ORIEL_PARAM(MiaPhysicalsunParams, samples), .fallback = {8}, .min = 0,
     .doc = "0 = hard shadows; other values = soft shadows with the samples of the image.",
     .support = Support::Approximated},
    {ORIEL_PARAM(MiaPhysicalsunParams, photon_bbox_min),
     .doc = "Corner of the box that photons are aimed at, in light space.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalsunParams, photon_bbox_max),
     .doc = "Opposite corner of the photon box; both 0 0 0 = the whole scene.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalsunParams, automatic_photon_energy),
     .doc = "Whether photon energy follows the light's intensity, ignoring its energy.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalsunParams, y_is_up), .doc = "Whether Y is up, otherwise Z.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalsunParams, illuminance_mode),
     .doc = "Whether direct_normal_illuminance sets the intensity; haze sets the colour."},
    {ORIEL_PARAM(MiaPhysicalsunParams, direct_normal_illuminance), .unit = "lux",
     .doc = "Illuminance of a surface perpendicular to the sun."},
    {ORIEL_PARAM(MiaPhysicalsunParams, flags), .doc = "1 = sun colour of 5900 K; default 0.",
     .declared_default = false},
};

struct SunState final : ShaderState {
  Rgb colour{0};
};

Rgb colour_of(const MiaPhysicalsunParams& p, const Light& light) {
  // Directional lights only, according to the manual.
  if (light.shape != LightShape::Directional) return Rgb(0);
  return sky::sun_colour(
      {.on = p.on,
       .multiplier = p.multiplier,
       .rgb_unit_conversion = rgb(p.rgb_unit_conversion),
       .haze = p.haze,
       .redblueshift = p.redblueshift,
       .saturation = p.saturation,
       .horizon_height = p.horizon_height,
       .y_is_up = p.y_is_up,
       .normal_illuminance =
           p.illuminance_mode != 0 ? std::optional(p.direct_normal_illuminance) : std::nullopt,
       .as_in_manual = (p.flags & 1) != 0},
      -light.direction);
}

/// Connected shaders are evaluated at the lit point with the direction to the sun: a connected sky
/// returns its disc in that direction.
LightValue sunlight(const Call& call, const LightCall& light) {
  LightValue value;
  value.is_sun = true;
  const bool connected = call.node && call.params != &call.node->constants<MiaPhysicalsunParams>();
  if (!connected) {
    if (const auto* state = static_cast<const SunState*>(light.light.state.get()))
      value.colour = state->colour;
    return value;
  }
  ShadingPoint toward_sun(call.point);
  toward_sun.ray_direction = -light.light.direction;
  toward_sun.ray_kind = RayKind::Light;
  toward_sun.environment = true;
  value.colour = call.node->with_params(toward_sun, [&](const Call& there) {
    return colour_of(there.as<MiaPhysicalsunParams>(), light.light);
  });
  return value;
}

/// Energy and target of the sun's photons. A sun that is off or below the horizon emits none.
void photons_of(const void* params, const Light& light, LightPhotons& photons) {
  const MiaPhysicalsunParams& p = *static_cast<const MiaPhysicalsunParams*>(params);
  const auto* state = static_cast<const SunState*>(light.state.get());
  photons.none |= !state || is_black(state->colour);
  if (p.automatic_photon_energy) {
    photons.emission.energy.reset();
    photons.has_energy = true;
  }
  const Vec3 half = (p.photon_bbox_max - p.photon_bbox_min) / 2;
  if (half == Vec3(0)) return;
  AimBox& box = photons.emission.aim.emplace();
  box.centre = transform_point(p.photon_bbox_min + half, light.to_world);
  for (int k = 0; k < 3; ++k) {
    Vec3 along(0);
    along[k] = half[k];
    box.half[k] = transform_vector(along, light.to_world);
  }
}

}  // namespace

const ShaderSpec kMiaPhysicalSun = {
    .name = "mia_physicalsun",
    .library = "architectural",
    .version = 6,
    .apply = kApplyLight | kApplyEmitter,
    .doc =
        "Sunlight for a directional light; haze and sun elevation set colour and "
        "intensity.",
    .params = kMiaPhysicalsunRows,
    .params_size = sizeof(MiaPhysicalsunParams),
    .light = {
        .evaluate = sunlight,
        .prepare = [](const void* params, const Light& light) -> std::unique_ptr<ShaderState> {
          auto state = std::make_unique<SunState>();
          state->colour = colour_of(*static_cast<const MiaPhysicalsunParams*>(params), light);
          return state;
        },
        .cone =
            [](const void* params) {
              const MiaPhysicalsunParams& p = *static_cast<const MiaPhysicalsunParams*>(params);
              return p.samples == 0 ? 0.0f : sky::sun_cone_angle(p.shadow_softness, p.haze);
            },
        .photons = photons_of,
    },
};

}  // namespace oriel
