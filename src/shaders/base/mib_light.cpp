// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_light.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "shaders/base/light_falloff.h"

namespace oriel {
namespace {

struct Infinite {
  Rgba color;
  bool shadow;
  float factor;
};
struct Point {
  Rgba color;
  bool shadow;
  float factor;
  bool atten;
  float start, stop;
};
struct Spot {
  Rgba color;
  bool shadow;
  float factor;
  bool atten;
  float start, stop;
  float cone;
};
struct Physical {
  Rgba color;
  float cone, threshold, cos_exp;
};

constexpr const char* kShadowDoc = "Whether the light casts shadows.";
constexpr const char* kFactorDoc = "Fraction of the light transmitted by opaque occluders.";
constexpr const char* kAttenDoc = "Whether light decreases linearly from start to stop.";

constexpr ParamSpec kInfiniteRows[] = {
    {ORIEL_PARAM(Infinite, color), .doc = "Light colour.", .declared_default = false},
    {ORIEL_PARAM(Infinite, shadow), .doc = kShadowDoc, .declared_default = false},
    {ORIEL_PARAM(Infinite, factor), .min = 0, .max = 1, .doc = kFactorDoc,
     .declared_default = false},
};
constexpr ParamSpec kPointRows[] = {
    {ORIEL_PARAM(Point, color), .doc = "Light colour.", .declared_default = false},
    {ORIEL_PARAM(Point, shadow), .doc = kShadowDoc, .declared_default = false},
    {ORIEL_PARAM(Point, factor), .min = 0, .max = 1, .doc = kFactorDoc, .declared_default = false},
    {ORIEL_PARAM(Point, atten), .doc = kAttenDoc, .declared_default = false},
    {ORIEL_PARAM(Point, start), .unit = "scene units",
     .doc = "Distance up to which the light has full intensity.", .declared_default = false},
    {ORIEL_PARAM(Point, stop), .unit = "scene units",
     .doc = "Distance from which the light is zero.", .declared_default = false},
};
constexpr ParamSpec kSpotRows[] = {
    {ORIEL_PARAM(Spot, color), .doc = "Light colour.", .declared_default = false},
    {ORIEL_PARAM(Spot, shadow), .doc = kShadowDoc, .declared_default = false},
    {ORIEL_PARAM(Spot, factor), .min = 0, .max = 1, .doc = kFactorDoc, .declared_default = false},
    {ORIEL_PARAM(Spot, atten), .doc = kAttenDoc, .declared_default = false},
    {ORIEL_PARAM(Spot, start), .unit = "scene units",
     .doc = "Distance up to which the light has full intensity.", .declared_default = false},
    {ORIEL_PARAM(Spot, stop), .unit = "scene units",
     .doc = "Distance from which the light is zero.", .declared_default = false},
    {ORIEL_PARAM(Spot, cone), .min = -1, .max = 1,
     .doc = "Cosine of the inner cone; the light's spread is the outer cone.",
     .declared_default = false},
};
constexpr ParamSpec kPhysicalRows[] = {
    {ORIEL_PARAM(Physical, color), .doc = "Light energy.", .declared_default = false},
    {ORIEL_PARAM(Physical, cone), .min = -1, .max = 1, .doc = "Cosine of the inner cone of a spot.",
     .declared_default = false},
    {ORIEL_PARAM(Physical, threshold), .min = 0, .doc = "Minimum light; weaker light is dropped.",
     .declared_default = false},
    {ORIEL_PARAM(Physical, cos_exp), .min = 0,
     .doc = "Cosine exponent of rectangle and disc lights; 0 = 1.", .declared_default = false},
};

template <class P>
LightValue ranged_light(const P& p, float distance) {
  LightValue value{rgb(p.color), p.shadow, clamp01(p.factor)};
  if (p.atten) {
    if (distance >= p.stop)
      value.colour = Rgb(0);
    else if (distance > p.start)
      value.colour *= (p.stop - distance) / (p.stop - p.start);
  }
  return value;
}

LightValue physical_value(const Call& call, const LightCall& l) {
  const Physical& p = call.as<Physical>();
  LightValue value;
  Rgb c = rgb(p.color);
  if (l.light.shape != LightShape::Directional) {
    // The energy is divided by the 4 pi steradians of the sphere, or distributed by a profile.
    const ProfilePlacement& measured = l.light.profile_placement;
    const float spread =
        measured ? measured.candela(l.direction) / measured.profile->flux() : 1 / (4 * kPi);
    c *= distance_decay(l.light, l.distance) * spread;
    const float exponent = p.cos_exp > 0 ? p.cos_exp : 1;
    if (l.emitter_cos < 1 && !measured)
      c *= exponent == 1 ? l.emitter_cos : math::pow(std::max(0.0f, l.emitter_cos), exponent);
    c *= spot_share(l.light, l.direction, p.cone);
  }
  if (max_component(c) >= p.threshold) value.colour = c;
  return value;
}

}  // namespace

const ShaderSpec kMibLightInfinite = {
    .name = "mib_light_infinite",
    .library = "base",
    .apply = kApplyLight,
    .doc = "Directional light.",
    .params = kInfiniteRows,
    .params_size = sizeof(Infinite),
    .light =
        {
            .evaluate =
                [](const Call& call, const LightCall&) {
                  const auto& p = call.as<Infinite>();
                  return LightValue{rgb(p.color), p.shadow, clamp01(p.factor)};
                },
        },
};

const ShaderSpec kMibLightPoint = {
    .name = "mib_light_point",
    .library = "base",
    .apply = kApplyLight,
    .doc = "Point light, by default without distance falloff.",
    .params = kPointRows,
    .params_size = sizeof(Point),
    .light =
        {
            .evaluate =
                [](const Call& call, const LightCall& l) {
                  return ranged_light(call.as<Point>(), l.distance);
                },
        },
};

const ShaderSpec kMibLightSpot = {
    .name = "mib_light_spot",
    .library = "base",
    .apply = kApplyLight,
    .doc = "Spot light with an inner and an outer cone.",
    .params = kSpotRows,
    .params_size = sizeof(Spot),
    .light =
        {
            .evaluate =
                [](const Call& call, const LightCall& l) {
                  const auto& p = call.as<Spot>();
                  LightValue value = ranged_light(p, l.distance);
                  value.colour *= spot_share(l.light, l.direction, p.cone);
                  return value;
                },
        },
};

const ShaderSpec kPhysicalLight = {
    .name = "physical_light",
    .library = "physics",
    .version = 3,
    .apply = kApplyLight,
    .doc = "Light with physical decay; the colour is an energy.",
    .params = kPhysicalRows,
    .params_size = sizeof(Physical),
    .light =
        {
            .evaluate = physical_value,
            // Profile of the light element: it defines the distribution, not the total energy.
            .profile = [](const void*,
                          const Light& light) { return light.profile_placement.profile; },
        },
};

}  // namespace oriel
