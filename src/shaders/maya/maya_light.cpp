// SPDX-License-Identifier: Apache-2.0
#include "shaders/maya/maya_light.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "shaders/base/light_falloff.h"
#include "shaders/maya/host_rows.h"

namespace oriel {
namespace {

struct MayaLightParams {
  Rgba color;
  float intensity;
  bool useRayTraceShadows;
  Rgba shadowColor;
  bool emitDiffuse, emitSpecular;
  float lightAngle;
  float ambientShade;
  int decayRate;
  float coneAngle, penumbraAngle, dropoff;
};

constexpr auto kCommonRows = about({
    {ORIEL_PARAM(MayaLightParams, color), .fallback = {1, 1, 1}, .doc = "Colour."},
    {ORIEL_PARAM(MayaLightParams, intensity), .fallback = {1}, .doc = "Colour factor."},
    {ORIEL_PARAM(MayaLightParams, useRayTraceShadows), .fallback = {1},
     .doc = "Whether the light casts shadows."},
    {ORIEL_PARAM(MayaLightParams, shadowColor),
     .doc = "Fraction transmitted by opaque occluders; the mean of the channels is used."},
    {ORIEL_PARAM(MayaLightParams, emitDiffuse), .fallback = {1},
     .doc = "Whether the light lights diffuse surfaces."},
});
constexpr auto kRows =
    joined(kCommonRows, about({{ORIEL_PARAM(MayaLightParams, emitSpecular), .fallback = {1},
                                .doc = "Whether the light makes highlights."}}));
constexpr auto kDirectionalRows =
    joined(kRows, about({{ORIEL_PARAM(MayaLightParams, lightAngle), .min = 0, .unit = "radians",
                          .doc = "Angular width of the light source."}}));
constexpr auto kAmbientRows = joined(
    kCommonRows,
    about({
        {ORIEL_PARAM(MayaLightParams, emitSpecular), .fallback = {1},
         .doc = "Highlights of the light; ambient light has none.", .support = Support::Ignored},
        {ORIEL_PARAM(MayaLightParams, ambientShade), .fallback = {.45f}, .min = 0, .max = 1,
         .doc = "Fraction that is directional from the light's position; the rest ignores the "
                "surface orientation."},
    }));
constexpr auto kPointRows =
    joined(kRows, about({{ORIEL_PARAM(MayaLightParams, decayRate), .min = 0, .max = 3,
                          .doc = "Exponent of the distance decay."}}));
constexpr auto kSpotRows = joined(
    kPointRows,
    about({
        {ORIEL_PARAM(MayaLightParams, coneAngle), .fallback = {.698132f}, .min = 0,
         .unit = "radians", .doc = "Width of the cone; values above a full turn are degrees."},
        {ORIEL_PARAM(MayaLightParams, penumbraAngle), .unit = "radians",
         .doc = "Width of the penumbra: outside the cone, inside it if negative."},
        {ORIEL_PARAM(MayaLightParams, dropoff), .min = 0,
         .doc = "Exponent of the cosine to the axis."},
    }));

LightValue light_value(const MayaLightParams& p) {
  const Rgba& s = p.shadowColor;
  LightValue value{rgb(p.color) * p.intensity, p.useRayTraceShadows,
                   clamp01((s.r + s.g + s.b) / 3)};
  value.affects_diffuse = p.emitDiffuse ? 1.0f : 0.0f;
  value.affects_specular = p.emitSpecular ? 1.0f : 0.0f;
  return value;
}

LightValue point_light(const MayaLightParams& p, float distance) {
  LightValue value = light_value(p);
  if (p.decayRate > 0)
    value.colour *= math::pow(std::max(distance, 1e-6f), -static_cast<float>(p.decayRate));
  return value;
}

/// 1 inside the cone, 0 outside of it and of the cone of the element, with a penumbra in between.
float cone_share(const MayaLightParams& p, const LightCall& l) {
  if (!in_spread(l.light, l.direction)) return 0;
  if (!l.light.has_direction && l.light.spread < -1) return 1;
  const float half = angle_of(p.coneAngle) / 2, rim = angle_of(p.penumbraAngle);
  const float inner = std::max(0.0f, half + std::min(rim, 0.0f));
  const float outer = std::min(kPi, half + std::max(rim, 0.0f));
  const float angle = math::acos(clamp(dot(l.direction, l.light.direction), -1, 1));
  if (angle > outer) return 0;
  return outer > inner ? clamp01((outer - angle) / (outer - inner)) : 1;
}

LightValue spot_light(const MayaLightParams& p, const LightCall& l) {
  LightValue value = point_light(p, l.distance);
  value.colour *= cone_share(p, l);
  if (p.dropoff > 0)
    value.colour *= math::pow(std::max(0.0f, dot(l.direction, l.light.direction)), p.dropoff);
  return value;
}

/// Divides the undirected part by the cosine that transport multiplies by.
LightValue ambient_light(const Call& call, const LightCall& l) {
  /// Minimum cosine of the division, which bounds the samples.
  constexpr float kMinCosine = 0.05f;
  const auto& p = call.as<MayaLightParams>();
  LightValue value = light_value(p);
  const float cosine = std::max(kMinCosine, -dot(call.point.normal, l.direction));
  const float shade = clamp01(p.ambientShade);
  value.colour *= shade + (1 - shade) / cosine;
  value.affects_specular = 0;
  return value;
}

constexpr ShaderSpec kLight = {
    .name = "",
    .library = "hosts",
    .apply = kApplyLight,
    .params_size = sizeof(MayaLightParams),
    .fallback = {.is_fallback = true},
};

constexpr ShaderSpec light(const char* name, const char* doc, std::span<const ParamSpec> rows,
                           LightValue (*value)(const Call&, const LightCall&)) {
  ShaderSpec spec = kLight;
  spec.name = name;
  spec.doc = doc;
  spec.params = rows;
  spec.light.evaluate = value;
  return spec;
}

LightValue point_value(const Call& call, const LightCall& l) {
  return point_light(call.as<MayaLightParams>(), l.distance);
}

}  // namespace

const ShaderSpec kMayaDirectionallight = [] {
  ShaderSpec spec = light(
      "maya_directionallight", "Fallback for Maya's directional light.", kDirectionalRows,
      [](const Call& call, const LightCall&) { return light_value(call.as<MayaLightParams>()); });
  spec.light.cone = [](const void* params) {
    return std::max(0.0f, angle_of(static_cast<const MayaLightParams*>(params)->lightAngle) / 2);
  };
  return spec;
}();

const ShaderSpec kMayaPointlight =
    light("maya_pointlight", "Fallback for Maya's pointLight.", kPointRows, point_value);

const ShaderSpec kMayaVolumelight = light(
    "maya_volumelight", "Fallback for Maya's volumeLight: a point light.", kPointRows, point_value);

const ShaderSpec kMayaSpotlight = light(
    "maya_spotlight", "Fallback for the spot light of 3ds Max.", kSpotRows,
    [](const Call& call, const LightCall& l) { return spot_light(call.as<MayaLightParams>(), l); });

const ShaderSpec kMayaArealight = light("maya_arealight", "Fallback for Maya's areaLight.",
                                        kPointRows, [](const Call& call, const LightCall& l) {
                                          LightValue value =
                                              point_light(call.as<MayaLightParams>(), l.distance);
                                          value.colour *= l.emitter_cos;
                                          return value;
                                        });

const ShaderSpec kMayaShapelight = renamed(kMayaArealight, "maya_shapelight");

const ShaderSpec kMayaAmbientlight =
    light("maya_ambientlight", "Fallback for Maya's ambientLight.", kAmbientRows, ambient_light);

}  // namespace oriel
