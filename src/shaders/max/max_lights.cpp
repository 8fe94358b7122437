// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "shaders/base/light_falloff.h"
#include "shaders/max/max_shaders.h"
#include "shaders/maya/host_rows.h"

namespace oriel {
namespace {

struct MaxLightParams {
  bool On;
  Rgba Color;
  float Multiplier;
  bool AffectDiffuse, AffectSpecular;
  float HotSpot, Falloff;
  bool UseNearAttenuation;
  float NearStart, NearEnd;
  bool UseFarAttenuation;
  float FarStart, FarEnd;
  int Decay;
  float DecayRadius;
  bool CastShadows;
  Rgba ShadowColor;
  float ShadowDensity;
};

constexpr auto kDefaultRows = about({
    {ORIEL_PARAM(MaxLightParams, Color), .fallback = {1, 1, 1}, .doc = "Colour."},
    {ORIEL_PARAM(MaxLightParams, Multiplier), .fallback = {1}, .doc = "Colour factor."},
});
constexpr auto kRows = joined(
    kDefaultRows,
    about({
        {ORIEL_PARAM(MaxLightParams, On), .fallback = {1}, .doc = "Whether the light is on."},
        {ORIEL_PARAM(MaxLightParams, AffectDiffuse), .fallback = {1},
         .doc = "Whether the light lights diffuse surfaces."},
        {ORIEL_PARAM(MaxLightParams, AffectSpecular), .fallback = {1},
         .doc = "Whether the light makes highlights."},
        {ORIEL_PARAM(MaxLightParams, UseNearAttenuation),
         .doc = "Whether the near attenuation is on: zero up to NearStart."},
        {ORIEL_PARAM(MaxLightParams, NearStart), .unit = "scene units",
         .doc = "Distance up to which the light is zero."},
        {ORIEL_PARAM(MaxLightParams, NearEnd), .unit = "scene units",
         .doc = "Distance from which the light has full intensity."},
        {ORIEL_PARAM(MaxLightParams, UseFarAttenuation),
         .doc = "Whether the far attenuation is on: zero from FarEnd."},
        {ORIEL_PARAM(MaxLightParams, FarStart), .unit = "scene units",
         .doc = "Distance up to which the light has full intensity."},
        {ORIEL_PARAM(MaxLightParams, FarEnd), .unit = "scene units",
         .doc = "Distance from which the light is zero."},
        {ORIEL_PARAM(MaxLightParams, Decay), .min = 0, .max = 2,
         .doc = "Exponent of the distance decay beyond DecayRadius."},
        {ORIEL_PARAM(MaxLightParams, DecayRadius), .unit = "scene units",
         .doc = "Distance at which decay starts."},
        {ORIEL_PARAM(MaxLightParams, CastShadows), .fallback = {1},
         .doc = "Whether the light casts shadows."},
        {ORIEL_PARAM(MaxLightParams, ShadowColor), .doc = "Shadow colour.",
         .support = Support::Ignored},
        {ORIEL_PARAM(MaxLightParams, ShadowDensity), .fallback = {1}, .doc = "Density of shadows."},
    }));
constexpr auto kConeRows =
    joined(kRows, about({
                      {ORIEL_PARAM(MaxLightParams, HotSpot), .fallback = {43}, .unit = "degrees",
                       .doc = "Width of the cone of full intensity."},
                      {ORIEL_PARAM(MaxLightParams, Falloff), .fallback = {45}, .unit = "degrees",
                       .doc = "Width of the cone of falloff."},
                  }));

LightValue plain(const MaxLightParams& p) { return {rgb(p.Color) * p.Multiplier, false, 0}; }

LightValue light_value(const MaxLightParams& p, float distance) {
  if (!p.On) return {};
  LightValue value = plain(p);
  value.shadow = p.CastShadows;
  value.shadow_factor = clamp01(1 - p.ShadowDensity);
  value.affects_diffuse = p.AffectDiffuse ? 1.0f : 0.0f;
  value.affects_specular = p.AffectSpecular ? 1.0f : 0.0f;
  if (!std::isfinite(distance)) return value;
  if (p.UseNearAttenuation) value.colour *= smoothstep(p.NearStart, p.NearEnd, distance);
  if (p.UseFarAttenuation) value.colour *= 1 - smoothstep(p.FarStart, p.FarEnd, distance);
  const float from = std::max(p.DecayRadius, 1e-6f);
  if (p.Decay > 0 && distance > from)
    value.colour *= math::pow(from / distance, static_cast<float>(p.Decay));
  return value;
}

LightValue spot(const Call& call, const LightCall& l) {
  const auto& p = call.as<MaxLightParams>();
  LightValue value = light_value(p, l.distance);
  if (!in_spread(l.light, l.direction)) return {};
  if (!l.light.has_direction && l.light.spread < -1) return value;
  const float inner = angle_of(p.HotSpot) / 2, outer = std::max(inner, angle_of(p.Falloff) / 2);
  const float angle = math::acos(clamp(dot(l.direction, l.light.direction), -1, 1));
  value.colour *= outer > inner ? 1 - smoothstep(inner, outer, angle) : angle <= inner ? 1.0f : 0;
  return value;
}

constexpr ShaderSpec light(const char* name, const char* doc, std::span<const ParamSpec> rows,
                           LightValue (*value)(const Call&, const LightCall&)) {
  return {.name = name,
          .library = "hosts",
          .apply = kApplyLight,
          .doc = doc,
          .params = rows,
          .params_size = sizeof(MaxLightParams),
          .light = {.evaluate = value},
          .fallback = {.is_fallback = true}};
}

constexpr ShaderSpec kDefault = light(
    "max_DefaultLight", "Fallback for the default light of scenes without lights.", kDefaultRows,
    [](const Call& call, const LightCall&) { return plain(call.as<MaxLightParams>()); });

constexpr ShaderSpec kNodes[] = {
    kDefault,
    renamed(kDefault, "adsk_Light_Default"),
    light("max_OmniLight", "Fallback for the omni light of 3ds Max.", kRows,
          [](const Call& call, const LightCall& l) {
            return light_value(call.as<MaxLightParams>(), l.distance);
          }),
    light("max_SpotLight", "Fallback for the spot light of 3ds Max.", kConeRows, spot),
    light("max_DirectionalLight", "Fallback for the directional light of 3ds Max.", kRows,
          [](const Call& call, const LightCall& l) {
            return light_value(call.as<MaxLightParams>(), l.distance);
          }),
};

}  // namespace

std::span<const ShaderSpec> max_lights() { return kNodes; }

}  // namespace oriel
