// SPDX-License-Identifier: Apache-2.0
#include "shaders/maya/production.h"

#include <algorithm>

#include "base/math.h"
#include "color/srgb.h"
#include "runtime/shade_input.h"
#include "shaders/maya/host_rows.h"
#include "shaders/maya/shadow_catcher.h"

namespace oriel {
namespace {

struct GammaGain {
  Rgba input;
  float gamma, gain;
  bool reverse;
};
struct RaySwitch {
  Rgba eye, transparent, reflection, refraction, finalgather, environment, shadow, photon;
  Rgba default_;
};
struct Matte {
  Rgba background;
  bool catch_shadows;
  Rgba shadows, ambient;
  float opacity;
};

constexpr auto kGammaGainRows = about({
    {ORIEL_PARAM(GammaGain, input), .doc = "Colour.", .declared_default = false},
    {ORIEL_PARAM(GammaGain, gamma), .fallback = {1}, .min = 0,
     .doc = "Gamma; the exponent is 1 / gamma."},
    {ORIEL_PARAM(GammaGain, gain), .fallback = {1}, .doc = "Gain, applied before the gamma."},
    {ORIEL_PARAM(GammaGain, reverse),
     .doc = "Whether the inverse is applied: exponent gamma, then 1 / gain."},
});

constexpr auto kRaySwitchRows = [] {
  auto rows = about({
      {ORIEL_PARAM(RaySwitch, eye), .doc = "Shader for camera rays."},
      {ORIEL_PARAM(RaySwitch, transparent), .doc = "Shader for transparency rays."},
      {ORIEL_PARAM(RaySwitch, reflection), .doc = "Shader for reflection rays."},
      {ORIEL_PARAM(RaySwitch, refraction), .doc = "Shader for refraction rays."},
      {ORIEL_PARAM(RaySwitch, finalgather),
       .doc = "Shader for final gather rays and diffuse bounces."},
      {ORIEL_PARAM(RaySwitch, environment), .doc = "Shader for environment rays."},
      {ORIEL_PARAM(RaySwitch, shadow), .doc = "Shader for shadow rays."},
      {ORIEL_PARAM(RaySwitch, photon), .doc = "Shader for photons."},
      {ORIEL_PARAM(RaySwitch, default_), .doc = "Shader for all other rays."},
  });
  for (ParamSpec& row : rows) {
    row.declared_default = false;
    row.takes_material = true;
  }
  rows.back().name = "default";
  return rows;
}();

constexpr auto kMatteRows = about({
    {ORIEL_PARAM(Matte, background), .doc = "Background, visible without shadow.",
     .declared_default = false},
    {ORIEL_PARAM(Matte, catch_shadows), .fallback = {1}, .doc = "Whether shadows are received."},
    {ORIEL_PARAM(Matte, shadows), .fallback = {0, 0, 0, 1}, .doc = "Shadow colour."},
    {ORIEL_PARAM(Matte, ambient), .doc = "Fraction of the light that is never shadowed."},
    {ORIEL_PARAM(Matte, opacity), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Opacity of the surface; only of mip_matteshadow_mtl."},
});

Rgb gamma_gain(const GammaGain& p, const Rgb& c) {
  const float gamma = p.gamma > 0 ? p.gamma : 1;
  const auto channel = [&](float v) {
    const float x = usable_light(v);
    if (p.reverse) return p.gain != 0 ? usable_light(math::pow(x, gamma) / p.gain) : 0.0f;
    return math::pow(usable_light(x * p.gain), 1 / gamma);
  };
  return Rgb(channel(c.x), channel(c.y), channel(c.z));
}

/// The parameter for rays of that type.
std::size_t chosen(RayKind kind) {
  if (is_photon(kind)) return offsetof(RaySwitch, photon);
  switch (kind) {
    case RayKind::Eye:
      return offsetof(RaySwitch, eye);
    case RayKind::Transparent:
      return offsetof(RaySwitch, transparent);
    case RayKind::Reflect:
      return offsetof(RaySwitch, reflection);
    case RayKind::Refract:
      return offsetof(RaySwitch, refraction);
    case RayKind::FinalGather:
      return offsetof(RaySwitch, finalgather);
    case RayKind::Environment:
      return offsetof(RaySwitch, environment);
    case RayKind::Shadow:
      return offsetof(RaySwitch, shadow);
    default:
      return offsetof(RaySwitch, default_);
  }
}

const Rgba& chosen_value(const Call& call, std::size_t at) {
  return *reinterpret_cast<const Rgba*>(static_cast<const std::byte*>(call.params) + at);
}

void matte(const Call& call, Closure& closure) {
  const auto& p = call.as<Matte>();
  const Rgb arriving = p.catch_shadows ? lit_share(call.point) : Rgb(1);
  const Rgb ambient = clamped(p.ambient);
  const Rgb lit = ambient + (Rgb(1) - ambient) * arriving;
  const float mean = (lit.x + lit.y + lit.z) / 3;
  closure.emission += rgb(p.background) * lit + rgb(p.shadows) * (Rgb(1) - lit);
  closure.alpha = clamp01(p.background.a * mean + p.shadows.a * (1 - mean));
  closure.opacity = clamp01(p.opacity);
}

constexpr ShaderSpec kMatte = {
    .name = "mip_matteshadow",
    .library = "hosts",
    .apply = kApplyMaterial | kApplyShadow | kApplyPhoton,
    .doc = "Fallback: shadow catcher over a background.",
    .params = kMatteRows,
    .params_size = sizeof(Matte),
    .material = {
        .fill = matte,
        .may_transmit =
            [](const ShaderNode& node) {
              return node.constants<Matte>().opacity < 1 ||
                     node.connected(offsetof(Matte, opacity));
            },
        .max_lobes = [](const ShaderNode&) { return 0; },
    },
    .fallback = {.is_fallback = true},
};

constexpr ShaderSpec kNodes[] = {
    {.name = "mip_gamma_gain",
     .library = "hosts",
     .apply = kApplyTexture | kApplyEnvironment | kApplyLens,
     .doc = "Fallback: gamma and gain of a colour, or of the image as lens shader.",
     .params = kGammaGainRows,
     .params_size = sizeof(GammaGain),
     .value =
         [](const Call& call, void* result) {
           const auto& p = call.as<GammaGain>();
           const Rgb c = gamma_gain(p, rgb(p.input));
           *static_cast<Rgba*>(result) = Rgba(c.x, c.y, c.z, p.input.a);
         },
     .lens = {
         .map_color = [](const Call& call, const LensCall&,
                         const Rgb& c) { return gamma_gain(call.as<GammaGain>(), c); },
         .traits =
             [](const ShaderNode& node) {
               return LensTraits{.gamma = node.constants<GammaGain>().gamma};
             },
     },
     .fallback = {.is_fallback = true}},
    {.name = "mip_rayswitch",
     .library = "hosts",
     .apply = kApplyMaterial | kApplyTexture | kApplyEnvironment | kApplyShadow | kApplyPhoton,
     .doc = "Fallback: a separate shader per ray type.",
     .params = kRaySwitchRows,
     .params_size = sizeof(RaySwitch),
     .value =
         [](const Call& call, void* result) {
           *static_cast<Rgba*>(result) = chosen_value(call, chosen(call.point.ray_kind));
         },
     .material = {
         .fill =
             [](const Call& call, Closure& closure) {
               const std::size_t at = chosen(call.point.ray_kind);
               shade_input(call, at, chosen_value(call, at), Rgb(1), closure);
             },
         .may_transmit = [](const ShaderNode& node) { return node.inputs_may_transmit(); },
         .max_lobes = [](const ShaderNode&) { return 0; },
         .one_material = true,
     },
     .fallback = {.is_fallback = true}},
    kMatte,
    renamed(kMatte, "mip_matteshadow_mtl"),
};

}  // namespace

std::span<const ShaderSpec> production_shaders() { return kNodes; }

}  // namespace oriel
