// SPDX-License-Identifier: Apache-2.0
// mia_photometric_light: a light with a given intensity or flux; isotropic, spot, or measured
// distribution.
//
// Model:  a distribution with known flux and peak is scaled to the requested intensity:
//         isotropic  1 everywhere; flat shapes: the cosine, which is constant luminance
//         spot       cos^bias within the spread of the light, the hemisphere without one
//         profile    as measured
//         Lumens refer to the whole distribution, even if a spread or a flat shape emits only a
//         part of it. The original effect of bias on a spot is unpublished.
// Units:  with factors of 1, I cd produce I / d^2 lux in scenes in metres, and pixels are cd/m2.
#include "shaders/architectural/mia_photometric_light.h"

#include "base/math.h"
#include "shaders/base/light_falloff.h"

namespace oriel {
namespace {

struct MiaPhotometricLightParams {
  bool on;
  float multiplier;
  Rgba color;
  int intensity_mode;
  float manual_peak_intensity_cd, manual_flux_lm;
  int distribution_mode;
  float spotlight_cosine_bias;
  LightProfileRef profile;
  float units_to_meter_scale, cm2_factor;
};

enum IntensityMode { kPeak = 0, kFlux = 1, kFromProfile = 2 };
enum DistributionMode { kIsotropic = 0, kSpot = 1, kProfile = 2 };

constexpr ParamSpec kMiaPhotometricLightRows[] = {
    {ORIEL_PARAM(MiaPhotometricLightParams, on), .fallback = {1},
     .doc = "Whether the light is on."},
    {ORIEL_PARAM(MiaPhotometricLightParams, multiplier), .fallback = {1}, .min = 0,
     .doc = "Factor of the light."},
    {ORIEL_PARAM(MiaPhotometricLightParams, color), .fallback = {1, 1, 1},
     .doc = "Tint of the light."},
    {ORIEL_PARAM(MiaPhotometricLightParams, intensity_mode), .min = 0, .max = 2,
     .doc = "Intensity source: 0 peak intensity, 1 flux, 2 the profile."},
    {ORIEL_PARAM(MiaPhotometricLightParams, manual_peak_intensity_cd), .min = 0, .unit = "cd",
     .doc = "Peak intensity, for `intensity_mode` 0."},
    {ORIEL_PARAM(MiaPhotometricLightParams, manual_flux_lm), .min = 0, .unit = "lm",
     .doc = "Total flux, for `intensity_mode` 1."},
    {ORIEL_PARAM(MiaPhotometricLightParams, distribution_mode), .min = 0, .max = 2,
     .doc = "Distribution: 0 uniform, 1 spot, 2 the profile."},
    {ORIEL_PARAM(MiaPhotometricLightParams, spotlight_cosine_bias), .min = 0,
     .doc = "Exponent of the cosine to the axis of a spot; 0 = uniform.",
     .support = Support::Approximated},
    {ORIEL_PARAM(MiaPhotometricLightParams, profile),
     .doc = "Photometric profile in candela; null = that of the light element.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPhotometricLightParams, units_to_meter_scale), .fallback = {1}, .min = 0,
     .doc = "Metres per scene unit."},
    {ORIEL_PARAM(MiaPhotometricLightParams, cm2_factor), .fallback = {1}, .min = 0,
     .doc = "Factor from photometric units to pixel values; 1 = pixels in cd/m2."},
};

/// Intensity in a direction, with the total flux and the peak in the same unit.
struct Distribution {
  float here, flux, peak;
};

Distribution spot(const MiaPhotometricLightParams& p, const LightCall& l) {
  const float rim = l.light.spread < -1 ? 0 : std::min(l.light.spread, 0.999999f);
  const float cosine = dot(l.direction, l.light.direction), bias = p.spotlight_cosine_bias;
  if (!(bias > 0)) return {cosine > rim ? 1.0f : 0.0f, kTwoPi * (1 - rim), 1};
  const float low = std::max(rim, 0.0f);
  return {cosine > low ? math::pow(cosine, bias) : 0,
          kTwoPi * (1 - math::pow(low, bias + 1)) / (bias + 1), 1};
}

Distribution distribution(const MiaPhotometricLightParams& p, const LightCall& l) {
  if (p.distribution_mode == kSpot) return spot(p, l);
  const photometry::LightProfile* profile = l.light.profile_placement.profile;
  const bool inside = in_spread(l.light, l.direction);
  if (p.distribution_mode == kProfile && profile)
    return {inside ? l.light.profile_placement.candela(l.direction) : 0, profile->flux(),
            profile->peak()};
  const bool flat = is_flat(l.light.shape);
  return {inside ? (flat ? l.emitter_cos : 1) : 0, flat ? kPi : 4 * kPi, 1};
}

/// Intensity in the direction of the call, in candela.
float intensity(const MiaPhotometricLightParams& p, const LightCall& l) {
  const Distribution d = distribution(p, l);
  const photometry::LightProfile* profile = p.profile.profile;
  if (p.intensity_mode == kFlux) return d.flux > 0 ? d.here * p.manual_flux_lm / d.flux : 0;
  if (p.intensity_mode == kFromProfile) {
    if (p.distribution_mode == kProfile && l.light.profile_placement) return d.here;
    // With another distribution, a profile still defines the flux.
    if (profile) return d.flux > 0 ? d.here * profile->flux() / d.flux : 0;
  }
  return d.peak > 0 ? d.here * p.manual_peak_intensity_cd / d.peak : 0;
}

LightValue value(const Call& call, const LightCall& l) {
  const MiaPhotometricLightParams& p = call.as<MiaPhotometricLightParams>();
  LightValue v;
  if (!p.on) return v;
  const float decay = distance_decay(l.light, l.distance * p.units_to_meter_scale);
  v.colour = rgb(p.color) * (p.multiplier * p.cm2_factor * intensity(p, l) * decay * kInvPi);
  return v;
}

const photometry::LightProfile* profile(const void* params, const Light& light) {
  const MiaPhotometricLightParams& p = *static_cast<const MiaPhotometricLightParams*>(params);
  if (p.distribution_mode != kProfile) return nullptr;
  return p.profile.profile ? p.profile.profile : light.profile_placement.profile;
}

}  // namespace

const ShaderSpec kMiaPhotometricLight = {
    .name = "mia_photometric_light",
    .library = "architectural",
    .version = 2,
    .apply = kApplyLight | kApplyEmitter,
    .doc =
        "Light of a given intensity or flux, uniform, as a spot, or by a measured "
        "profile.",
    .params = kMiaPhotometricLightRows,
    .params_size = sizeof(MiaPhotometricLightParams),
    .light =
        {
            .evaluate = value,
            .profile = profile,
            // The photon flux follows from the intensity; the energy of the element is ignored.
            .photons =
                [](const void*, const Light&, LightPhotons& photons) {
                  photons.emission.energy.reset();
                  photons.has_energy = true;
                },
        },
};

}  // namespace oriel
