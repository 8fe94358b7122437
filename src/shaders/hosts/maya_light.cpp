// SPDX-License-Identifier: Apache-2.0
#include "shaders/hosts/maya_light.h"

#include <algorithm>
#include <cmath>

#include "shaders/base/light_falloff.h"

namespace oriel {
namespace {

struct Lamp {
  Rgba color;
  float intensity;
  bool useRayTraceShadows;
  Rgba shadowColor;
  int decayRate;
  float coneAngle, dropoff;
};

constexpr Support kAbout = Support::Approximated;

constexpr ParamSpec kRows[] = {
    {ORIEL_PARAM(Lamp, color), .fallback = {1, 1, 1}, .doc = "Colour.", .support = kAbout},
    {ORIEL_PARAM(Lamp, intensity), .fallback = {1}, .doc = "Factor of the colour.",
     .support = kAbout},
    {ORIEL_PARAM(Lamp, useRayTraceShadows), .fallback = {1}, .doc = "Cast shadows.",
     .support = kAbout},
    {ORIEL_PARAM(Lamp, shadowColor), .doc = "Share that passes opaque blockers; its mean.",
     .support = kAbout},
    // Not of directional lights:
    {ORIEL_PARAM(Lamp, decayRate), .min = 0, .max = 3,
     .doc = "Exponent of the distance by which it weakens.", .support = kAbout},
    // Of spots:
    {ORIEL_PARAM(Lamp, coneAngle), .fallback = {40}, .min = 0, .max = 180, .unit = "degrees",
     .doc = "Width of the inner cone.", .support = kAbout},
    {ORIEL_PARAM(Lamp, dropoff), .min = 0, .doc = "Exponent of the cosine to the axis.",
     .support = kAbout},
};
constexpr std::size_t kDirectionalRows = 4, kPointRows = 5;

LightValue lamp(const Lamp& p) {
  const Rgba& s = p.shadowColor;
  return {rgb(p.color) * p.intensity, p.useRayTraceShadows, clamp01((s.r + s.g + s.b) / 3)};
}

LightValue point_light(const Lamp& p, float distance) {
  LightValue value = lamp(p);
  if (p.decayRate > 0)
    value.colour *= std::pow(std::max(distance, 1e-6f), -static_cast<float>(p.decayRate));
  return value;
}

}  // namespace

const ShaderSpec kMayaDirectionallight = {
    .name = "maya_directionallight",
    .library = "hosts",
    .apply = kApplyLight,
    .doc = "Stand-in for the host's directional light.",
    .params = std::span(kRows).first(kDirectionalRows),
    .params_size = sizeof(Lamp),
    .light = [](const Call& call, const LightCall&) { return lamp(call.as<Lamp>()); },
};

const ShaderSpec kMayaPointlight = {
    .name = "maya_pointlight",
    .library = "hosts",
    .apply = kApplyLight,
    .doc = "Stand-in for the host's point light.",
    .params = std::span(kRows).first(kPointRows),
    .params_size = sizeof(Lamp),
    .light = [](const Call& call,
                const LightCall& l) { return point_light(call.as<Lamp>(), l.distance); },
};

const ShaderSpec kMayaSpotlight = {
    .name = "maya_spotlight",
    .library = "hosts",
    .apply = kApplyLight,
    .doc = "Stand-in for the host's spot light.",
    .params = kRows,
    .params_size = sizeof(Lamp),
    .light =
        [](const Call& call, const LightCall& l) {
          const auto& p = call.as<Lamp>();
          LightValue value = point_light(p, l.distance);
          const float half = p.coneAngle * kPi / 360;
          value.colour *= spot_share(l.light, l.direction, std::cos(half));
          if (p.dropoff > 0)
            value.colour *=
                std::pow(std::max(0.0f, dot(l.direction, l.light.direction)), p.dropoff);
          return value;
        },
};

}  // namespace oriel
