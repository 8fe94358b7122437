// SPDX-License-Identifier: Apache-2.0
// mib_light_photometric: a light with a measured intensity distribution.
//
// Units: with a colour of 1, a profile of I cd produces I / d^2 lux in scenes in metres, and pixels
// are cd/m2 (a light of colour c has irradiance pi * c, see runtime/light.h).
#include "shaders/base/mib_light_photometric.h"

#include "shaders/base/light_falloff.h"

namespace oriel {
namespace {

struct MibLightPhotometricParams {
  Rgba color;
  bool shadow;
  float factor, start, stop;
  LightProfileRef profile;
};

constexpr ParamSpec kMibLightPhotometricRows[] = {
    {ORIEL_PARAM(MibLightPhotometricParams, color), .doc = "Factor of the measured intensity.",
     .declared_default = false},
    {ORIEL_PARAM(MibLightPhotometricParams, shadow), .doc = "Whether the light casts shadows.",
     .declared_default = false},
    {ORIEL_PARAM(MibLightPhotometricParams, factor), .min = 0, .max = 1,
     .doc = "Fraction of the light transmitted by opaque occluders.", .declared_default = false},
    {ORIEL_PARAM(MibLightPhotometricParams, start), .unit = "scene units",
     .doc = "Distance up to which the light has full intensity; used if `stop` is larger.",
     .declared_default = false},
    {ORIEL_PARAM(MibLightPhotometricParams, stop), .unit = "scene units",
     .doc = "Distance from which the light is zero; 0 = unlimited.", .declared_default = false},
    {ORIEL_PARAM(MibLightPhotometricParams, profile),
     .doc = "Photometric profile in candela; null = that of the light element, or 1 cd in "
            "all directions.",
     .declared_default = false},
};

LightValue photometric_value(const Call& call, const LightCall& l) {
  const MibLightPhotometricParams& p = call.as<MibLightPhotometricParams>();
  LightValue v{.shadow = p.shadow, .shadow_factor = clamp01(p.factor)};
  if (!in_spread(l.light, l.direction)) return v;
  const float candela =
      l.light.profile_placement ? l.light.profile_placement.candela(l.direction) : 1;
  float share = distance_decay(l.light, l.distance) * kInvPi;
  if (p.stop > p.start && p.stop > 0 && l.distance > p.start)
    share *= std::max(0.0f, (p.stop - l.distance) / (p.stop - p.start));
  v.colour = rgb(p.color) * (candela * share);
  return v;
}

}  // namespace

const ShaderSpec kMibLightPhotometric = {
    .name = "mib_light_photometric",
    .library = "base",
    .apply = kApplyLight,
    .doc = "Photometric light with a measured distribution in candela.",
    .params = kMibLightPhotometricRows,
    .params_size = sizeof(MibLightPhotometricParams),
    .light =
        {
            .evaluate = photometric_value,
            .profile =
                [](const void* params, const Light& light) {
                  const photometry::LightProfile* own =
                      static_cast<const MibLightPhotometricParams*>(params)->profile.profile;
                  return own ? own : light.profile_placement.profile;
                },
        },
};

}  // namespace oriel
