// SPDX-License-Identifier: Apache-2.0
// mia_ciesky: the CIE clear and overcast skies as environment.
#include "runtime/world.h"
#include "shaders/architectural/mia_sun_sky.h"
#include "sky/cie_sky.h"

namespace oriel {
namespace {

struct MiaCieskyParams {
  bool on;
  Rgba rgb_unit_conversion;
  bool auto_luminance;
  float zenith_luminance, diffuse_horizontal_illuminance, overcast;
  Vec3 sun_direction;
  LightRef sun;
  bool y_is_up;
};

constexpr ParamSpec kMiaCieskyRows[] = {
    {ORIEL_PARAM(MiaCieskyParams, on), .fallback = {1}, .doc = "Whether the sky is on."},
    {ORIEL_PARAM(MiaCieskyParams, rgb_unit_conversion), .fallback = {.0001f, .0001f, .0001f},
     .unit = "1/lux",
     .doc = "Factor from lux to scene units; 0 0 0 maps 80000 lux to 1; 0.318 gives pixels "
            "in cd/m2."},
    {ORIEL_PARAM(MiaCieskyParams, auto_luminance), .fallback = {1},
     .doc = "Luminance from the elevation of the sun, used if neither of the next two "
            "parameters is set."},
    {ORIEL_PARAM(MiaCieskyParams, zenith_luminance), .unit = "cd/m2",
     .doc = "Luminance of the zenith; used if above 0."},
    {ORIEL_PARAM(MiaCieskyParams, diffuse_horizontal_illuminance), .unit = "lux",
     .doc = "Illuminance of the sky alone; used if above 0 and zenith_luminance is not."},
    {ORIEL_PARAM(MiaCieskyParams, overcast), .min = 0, .max = 1,
     .doc = "Sky type: 0 CIE clear, 1 CIE overcast."},
    {ORIEL_PARAM(MiaCieskyParams, sun_direction),
     .doc = "Direction towards the sun, used if `sun` is not set.", .declared_default = false},
    {ORIEL_PARAM(MiaCieskyParams, sun), .doc = "Light instance of the sun.",
     .declared_default = false},
    {ORIEL_PARAM(MiaCieskyParams, y_is_up), .doc = "Whether Y is up, otherwise Z.",
     .declared_default = false},
};

struct CieSkyState final : ShaderState {
  explicit CieSkyState(const sky::CieParameters& p) : parameters(p), sky(p) {}
  sky::CieParameters parameters;
  sky::CieSky sky;
};

sky::CieParameters cie_parameters(const MiaCieskyParams& p, const World& world) {
  return {.on = p.on,
          .rgb_unit_conversion = rgb(p.rgb_unit_conversion),
          .auto_luminance = p.auto_luminance,
          .zenith_luminance = p.zenith_luminance,
          .diffuse_horizontal_illuminance = p.diffuse_horizontal_illuminance,
          .overcast = p.overcast,
          .sun_direction = direction_to_sun(p.sun, p.sun_direction, p.y_is_up, world),
          .y_is_up = p.y_is_up};
}

}  // namespace

const ShaderSpec kMiaCieSky = {
    .name = "mia_ciesky",
    .library = "architectural",
    .version = 1,
    .apply = kApplyEnvironment | kApplyTexture,
    .doc = "CIE standard clear and overcast skies in grey, for daylight analysis.",
    .params = kMiaCieskyRows,
    .params_size = sizeof(MiaCieskyParams),
    .value =
        [](const Call& call, void* result) {
          const auto& state = *static_cast<const CieSkyState*>(call.state);
          // Connected parameters are evaluated for the lookup direction.
          sky::CieParameters now = state.parameters;
          if (call.point.world) now = cie_parameters(call.as<MiaCieskyParams>(), *call.point.world);
          const Vec3& d = call.point.ray_direction;
          const Rgb c =
              now == state.parameters ? state.sky.radiance(d) : sky::CieSky(now).radiance(d);
          *static_cast<Rgba*>(result) = Rgba(c.x, c.y, c.z, 1);
        },
    .binding =
        {
            .prepare = [](const void* params, const World& world) -> std::unique_ptr<ShaderState> {
              return std::make_unique<CieSkyState>(
                  cie_parameters(*static_cast<const MiaCieskyParams*>(params), world));
            },
        },
};

}  // namespace oriel
