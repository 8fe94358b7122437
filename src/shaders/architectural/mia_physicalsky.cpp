// SPDX-License-Identifier: Apache-2.0
// mia_physicalsky: the daylight environment, with the sun's disc and glow and a virtual ground.
#include <algorithm>
#include <utility>

#include "runtime/world.h"
#include "shaders/architectural/mia_sun_sky.h"
#include "sky/daylight.h"
#include "sky/physical_sky.h"

namespace oriel {
namespace {

struct MiaPhysicalskyParams {
  bool on;
  float multiplier;
  Rgba rgb_unit_conversion;
  float haze, redblueshift, saturation, horizon_height, horizon_blur;
  Rgba ground_color, night_color;
  Vec3 sun_direction;
  LightRef sun;
  float sun_disk_intensity, sun_disk_scale, sun_glow_intensity;
  bool use_background;
  ShaderRef background;
  float visibility_distance;
  bool y_is_up;
  int flags;
  int sky_luminance_mode;
  float zenith_luminance, diffuse_horizontal_illuminance;
  float a, b, c, d, e;
  bool physically_scaled_sun;
};

// Bits of `flags`. 0 is compatible with mental ray; the manual defines no bits.
constexpr int kAsInManual = 1;         ///< SkyParameters::as_in_manual
constexpr int kPaperChromaticity = 2;  ///< the paper's constant in the chromaticity x
constexpr int kClampAntisolar = 4;     ///< PreethamOptions::clamp_antisolar

constexpr ParamSpec kMiaPhysicalskyRows[] = {
    {ORIEL_PARAM(MiaPhysicalskyParams, on), .fallback = {1}, .doc = "Whether the sky is on."},
    {ORIEL_PARAM(MiaPhysicalskyParams, multiplier), .fallback = {1}, .min = 0,
     .doc = "Factor of the light."},
    {ORIEL_PARAM(MiaPhysicalskyParams, rgb_unit_conversion), .fallback = {.0001f, .0001f, .0001f},
     .unit = "1/lux",
     .doc = "Factor from lux to scene units; 0 0 0 maps 80000 lux to 1; 0.318 gives pixels "
            "in cd/m2."},
    {ORIEL_PARAM(MiaPhysicalskyParams, haze), .min = 0, .max = 15,
     .doc = "Haze: 0 clear, 15 overcast."},
    {ORIEL_PARAM(MiaPhysicalskyParams, redblueshift), .min = -1, .max = 1,
     .doc = "Colour shift: -1 very blue, 1 very red."},
    {ORIEL_PARAM(MiaPhysicalskyParams, saturation), .fallback = {1}, .min = 0, .max = 2,
     .doc = "Saturation: 0 grey, 1 unchanged."},
    {ORIEL_PARAM(MiaPhysicalskyParams, horizon_height), .min = -10, .max = 10,
     .doc = "Elevation of the horizon: -10 straight down, 10 the zenith."},
    {ORIEL_PARAM(MiaPhysicalskyParams, horizon_blur), .fallback = {.1f}, .min = 0, .max = 10,
     .doc = "Blur of the horizon; 0 = sharp."},
    {ORIEL_PARAM(MiaPhysicalskyParams, ground_color), .fallback = {.2f, .2f, .2f},
     .doc = "Albedo of the virtual ground."},
    {ORIEL_PARAM(MiaPhysicalskyParams, night_color), .doc = "Minimum colour of the sky."},
    {ORIEL_PARAM(MiaPhysicalskyParams, sun_direction),
     .doc = "Direction towards the sun, used if `sun` is not set.", .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalskyParams, sun), .doc = "Light instance of the sun.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalskyParams, sun_disk_intensity), .fallback = {1}, .min = 0,
     .doc = "Intensity of the visible sun disc."},
    {ORIEL_PARAM(MiaPhysicalskyParams, sun_disk_scale), .fallback = {4}, .min = 0,
     .doc = "Size of the visible sun disc; 1 = true size."},
    {ORIEL_PARAM(MiaPhysicalskyParams, sun_glow_intensity), .fallback = {1}, .min = 0,
     .doc = "Intensity of the glow around the sun disc."},
    {ORIEL_PARAM(MiaPhysicalskyParams, use_background),
     .doc = "Whether the camera sees `background`; without one, transparent black.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalskyParams, background),
     .doc = "Background shader, visible to the camera.", .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalskyParams, visibility_distance), .unit = "scene units",
     .doc = "Distance of 10 % haze, as lens or volume shader; 0 = none.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalskyParams, y_is_up), .doc = "Whether Y is up, otherwise Z.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalskyParams, flags),
     .doc = "Bits: 1 sun of 5900 K and ground lit by this sky, 2 colours of the published "
            "model, 4 luminance more than 90 degrees from the sun as at 90 degrees; default 0.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalskyParams, sky_luminance_mode),
     .doc = "Whether luminance is set by the following seven parameters."},
    {ORIEL_PARAM(MiaPhysicalskyParams, zenith_luminance), .unit = "cd/m2",
     .doc = "Luminance of the zenith; used if above 0."},
    {ORIEL_PARAM(MiaPhysicalskyParams, diffuse_horizontal_illuminance), .unit = "lux",
     .doc = "Illuminance of the sky alone; used if above 0 and zenith_luminance is not."},
    {ORIEL_PARAM(MiaPhysicalskyParams, a),
     .doc = "Perez: brightness of the horizon; all five 0 = derived from haze.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalskyParams, b), .doc = "Perez: gradient near the horizon; below 0.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalskyParams, c), .doc = "Perez: brightness around the sun.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalskyParams, d),
     .doc = "Perez: width of the bright area around the sun; below 0.", .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalskyParams, e), .doc = "Perez: backscattering.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhysicalskyParams, physically_scaled_sun),
     .doc = "Whether disc and glow have the sun's true energy.", .declared_default = false},
};

sky::SkyParameters parameters_of(const MiaPhysicalskyParams& p, const World& world) {
  sky::SkyParameters s{.on = p.on,
                       .multiplier = p.multiplier,
                       .rgb_unit_conversion = rgb(p.rgb_unit_conversion),
                       .haze = p.haze,
                       .redblueshift = p.redblueshift,
                       .saturation = p.saturation,
                       .horizon_height = p.horizon_height,
                       .horizon_blur = p.horizon_blur,
                       .ground_color = rgb(p.ground_color),
                       .night_color = rgb(p.night_color),
                       .sun_direction = direction_to_sun(p.sun, p.sun_direction, p.y_is_up, world),
                       .sun_disk_intensity = p.sun_disk_intensity,
                       .sun_disk_scale = p.sun_disk_scale,
                       .sun_glow_intensity = p.sun_glow_intensity,
                       .physically_scaled_sun = p.physically_scaled_sun,
                       .y_is_up = p.y_is_up,
                       .as_in_manual = (p.flags & kAsInManual) != 0,
                       .model = {.paper_chromaticity = (p.flags & kPaperChromaticity) != 0,
                                 .clamp_antisolar = (p.flags & kClampAntisolar) != 0}};
  if (p.sky_luminance_mode != 0)
    s.luminance = {.zenith = p.zenith_luminance,
                   .horizontal_illuminance = p.diffuse_horizontal_illuminance,
                   .distribution = {p.a, p.b, p.c, p.d, p.e}};
  return s;
}

/// Whether a light of the scene is at the position of the sun in the sky.
bool has_light(const World& world, const sky::SkyParameters& p) {
  // Tolerance for rounded directions, and for lights that were aimed at the disc by hand.
  constexpr float kCosNear = 0.9998f;  // 1.1 degrees
  const Vec3 to_sun = normalize(p.sun_direction);
  return std::any_of(world.lights.begin(), world.lights.end(), [&](const Light& light) {
    if (light.shape != LightShape::Directional || dot(-light.direction, to_sun) < kCosNear)
      return false;
    ShadingPoint point;
    point.normal = point.geometric_normal = to_sun;
    return world.sample_light(light, point, Vec2(0.5f), RayKind::Light).has_value();
  });
}

struct PhysicalSkyState final : ShaderState {
  PhysicalSkyState(const sky::SkyParameters& p, const World& world)
      : parameters(p), sky(p), sun_is_light(has_light(world, p)) {}
  sky::SkyParameters parameters;
  sky::PhysicalSky sky;
  bool sun_is_light;
};

/// Calls f(sky, parameters) with the sky for the parameters of a call. Connected parameters are
/// evaluated for the lookup direction, for example stars in the night colour, or haze that varies
/// with the direction.
template <class F>
auto with_sky(const Call& call, F&& f) {
  const auto& state = *static_cast<const PhysicalSkyState*>(call.state);
  if (!call.point.world) return f(state.sky, state.parameters);
  sky::SkyParameters now = parameters_of(call.as<MiaPhysicalskyParams>(), *call.point.world);
  if (now == state.parameters) return f(state.sky, state.parameters);
  // A different night colour alone requires no new precomputation.
  const Rgb night = std::exchange(now.night_color, state.parameters.night_color);
  sky::PhysicalSky sky = now == state.parameters ? state.sky : sky::PhysicalSky(now);
  sky.set_night_color(night);
  return f(sky, now);
}

sky::SkyPart visible_part(const ShadingPoint& point, bool sun_is_light) {
  switch (point.ray_kind) {
    case RayKind::FinalGather:
    case RayKind::Light:
      return sky::SkyPart::Gradient;
    // The sun light already contributes the highlight where a blurred lookup overlaps the disc.
    default:
      return point.blurred && sun_is_light ? sky::SkyPart::GradientAndGlow
                                           : sky::SkyPart::Everything;
  }
}

void sky_value(const Call& call, void* result) {
  const MiaPhysicalskyParams& p = call.as<MiaPhysicalskyParams>();
  auto& out = *static_cast<Rgba*>(result);
  if (p.use_background && call.point.environment && call.point.ray_kind == RayKind::Eye) {
    out = p.background.node && p.background.node->spec().value
              ? p.background.node->color(call.point)
              : Rgba(0);
    return;
  }
  const bool sun_is_light = static_cast<const PhysicalSkyState*>(call.state)->sun_is_light;
  const Rgb c = with_sky(call, [&](const sky::PhysicalSky& sky, const sky::SkyParameters&) {
    return sky.radiance(call.point.ray_direction, visible_part(call.point, sun_is_light));
  });
  out = Rgba(c.x, c.y, c.z, 1);
}

/// Aerial perspective: distant objects fade to the colour of the horizon behind them.
VolumeValue aerial_perspective(const Call& call) {
  const MiaPhysicalskyParams& p = call.as<MiaPhysicalskyParams>();
  return with_sky(
      call, [&](const sky::PhysicalSky& sky, const sky::SkyParameters& now) -> VolumeValue {
        if (!now.on || !(now.multiplier > 0)) return {};
        const float haze = sky::aerial_haze(call.point.ray_length, p.visibility_distance, p.haze);
        if (haze == 0) return {};
        return {Rgb(1 - haze), sky.horizon_radiance(call.point.ray_direction) * haze};
      });
}

}  // namespace

Vec3 direction_to_sun(LightRef sun, const Vec3& direction, bool y_is_up, const World& world) {
  if (sun.index >= 0) return -world.lights[static_cast<std::size_t>(sun.index)].direction;
  if (direction != Vec3(0)) return normalize(direction);
  // Without both, the zenith: a sky without a sun is most uniform there.
  return y_is_up ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
}

const ShaderSpec kMiaPhysicalSky = {
    .name = "mia_physicalsky",
    .library = "architectural",
    .version = 5,
    .apply = kApplyEnvironment | kApplyTexture | kApplyLens | kApplyVolume,
    .doc = "Daylight sky as environment, with the sun's disc and a virtual ground plane.",
    .params = kMiaPhysicalskyRows,
    .params_size = sizeof(MiaPhysicalskyParams),
    .value = sky_value,
    .volume = {.evaluate = aerial_perspective},
    .binding =
        {
            .prepare = [](const void* params, const World& world) -> std::unique_ptr<ShaderState> {
              return std::make_unique<PhysicalSkyState>(
                  parameters_of(*static_cast<const MiaPhysicalskyParams*>(params), world), world);
            },
        },
};

}  // namespace oriel
