// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "runtime/bump.h"
#include "runtime/closure.h"
#include "shaders/max/max_shaders.h"
#include "shaders/maya/host_rows.h"

namespace oriel {
namespace {

struct Default {
  Rgba ambient, diffuse, specular;
  float shinyness;
};
struct Illumination {
  Rgba Ambient, Diffuse, Specular;
  bool UseSelfIllumColor;
  float SelfIllumAmount;
  Rgba SelfIllumColor;
  float SpecularLevel, Glossiness;
};
struct Standard {
  ShaderRef Shader;
  int OpacityType;
  float Opacity;
  Rgba FilterColor;
  ArrayView<bool> MapEnables;
  ArrayView<ShaderRef> Maps;
  ArrayView<float> MapAmounts;
};
/// Indices of the maps of a standard material.
enum Map { kDiffuseMap = 1, kSpecularMap = 2, kSelfIllumMap = 5, kOpacityMap = 6, kReflectMap = 9 };

constexpr auto kDefaultRows = about({
    {ORIEL_PARAM(Default, ambient), .doc = "Self-illumination colour.",
     .support = Support::Ignored},
    {ORIEL_PARAM(Default, diffuse), .fallback = {.5f, .5f, .5f}, .doc = "Colour."},
    {ORIEL_PARAM(Default, specular), .doc = "Highlight colour."},
    {ORIEL_PARAM(Default, shinyness), .min = 0, .max = 1, .doc = "Highlight exponent."},
});
constexpr auto kIlluminationRows = about({
    {ORIEL_PARAM(Illumination, Ambient), .doc = "Ambient colour.", .support = Support::Ignored},
    {ORIEL_PARAM(Illumination, Diffuse), .fallback = {.5f, .5f, .5f}, .doc = "Colour."},
    {ORIEL_PARAM(Illumination, Specular), .fallback = {.9f, .9f, .9f}, .doc = "Highlight colour."},
    {ORIEL_PARAM(Illumination, UseSelfIllumColor), .doc = "Whether SelfIllumColor is used."},
    {ORIEL_PARAM(Illumination, SelfIllumAmount),
     .doc = "Self-illumination fraction in the diffuse colour."},
    {ORIEL_PARAM(Illumination, SelfIllumColor), .doc = "Self-illumination colour, added."},
    {ORIEL_PARAM(Illumination, SpecularLevel), .doc = "Highlight strength."},
    {ORIEL_PARAM(Illumination, Glossiness), .fallback = {.1f},
     .doc = "Highlight narrowness: exponent 2^(10 Glossiness)."},
});
constexpr auto kStandardRows = about({
    {ORIEL_PARAM(Standard, Shader), .doc = "Illumination shader."},
    {ORIEL_PARAM(Standard, OpacityType), .min = 0, .max = 2,
     .doc = "Transparency type: 0 = filtered by FilterColor; other values = unfiltered."},
    {ORIEL_PARAM(Standard, Opacity), .fallback = {1}, .doc = "Opacity."},
    {ORIEL_PARAM(Standard, FilterColor), .fallback = {1, 1, 1},
     .doc = "Filter colour of the transparency."},
    {ORIEL_PARAM(Standard, MapEnables), .doc = "Whether each map is on."},
    {ORIEL_PARAM(Standard, Maps),
     .doc = "Maps; colour, highlight, self-illumination, opacity and reflection are used."},
    {ORIEL_PARAM(Standard, MapAmounts), .doc = "Map weights."},
});

/// Converts percentages to 0..1.
float share(float x) { return clamp01(x > 1 ? x / 100 : x); }

Rgb mix(const Rgb& a, const Rgb& b, float t) { return a * (1 - t) + b * t; }

float exponent_of(float glossiness) { return math::exp2(10 * share(glossiness)); }

void add(LobeKind kind, LobeType type, const Rgb& level, const Frame& frame, Closure& closure) {
  if (is_black(level)) return;
  closure.add(kind, type, level, frame);
  closure.albedo += level;
}

void highlight(const Rgb& level, float exponent, const Frame& frame, Closure& closure) {
  if (is_black(level)) return;
  Lobe& lobe = closure.add(LobeKind::PhongHighlight, LobeType::Reflection, level, frame);
  lobe.controls.highlights_only = true;
  lobe.roughness = exponent;
}

void default_material(const Call& call, Closure& closure) {
  const auto& p = call.as<Default>();
  const Frame frame(facing_viewer(call.point.normal, call.point));
  add(LobeKind::Diffuse, LobeType::Diffuse, clamped(p.diffuse), frame, closure);
  highlight(rgb(p.specular), exponent_of(p.shinyness), frame, closure);
}

/// `solid`: share that mirror and transparency leave.
void illuminate(const Illumination& p, const Frame& frame, const Rgb& solid, Closure& closure) {
  const float own = p.UseSelfIllumColor ? 0 : share(p.SelfIllumAmount);
  if (p.UseSelfIllumColor) closure.emission += rgb(p.SelfIllumColor) * solid;
  closure.emission += rgb(p.Diffuse) * solid * own;
  add(LobeKind::Diffuse, LobeType::Diffuse, clamped(p.Diffuse) * solid * (1 - own), frame, closure);
  const float level = p.SpecularLevel > 10 ? p.SpecularLevel / 100 : p.SpecularLevel;
  highlight(rgb(p.Specular) * std::max(0.0f, level), exponent_of(p.Glossiness), frame, closure);
}

void illumination(const Call& call, Closure& closure) {
  illuminate(call.as<Illumination>(), Frame(facing_viewer(call.point.normal, call.point)), Rgb(1),
             closure);
}

const ShaderNode* map_of(const Standard& p, int which) {
  if (which >= p.Maps.size) return nullptr;
  const ShaderNode* node = p.Maps.data[which].node;
  const bool on = which >= p.MapEnables.size || p.MapEnables.data[which];
  return on && node && node->spec().value ? node : nullptr;
}
float amount_of(const Standard& p, int which) {
  return which < p.MapAmounts.size ? share(p.MapAmounts.data[which]) : 1;
}
Rgb mapped(const Standard& p, int which, const Rgb& plain, ShadingPoint& point) {
  const ShaderNode* map = map_of(p, which);
  return map ? mix(plain, rgb(map->color(point)), amount_of(p, which)) : plain;
}
Rgba opaque(const Rgb& c) { return Rgba(c.x, c.y, c.z, 1); }

void standard(const Call& call, Closure& closure) {
  const auto& p = call.as<Standard>();
  ShadingPoint& point = call.point;
  const Rgba grey(.5f, .5f, .5f, 1), none(0);
  Illumination i{none, grey, none, false, 0, none, 0, 0};
  if (p.Shader.node && p.Shader.node->spec().material.fill == illumination)
    p.Shader.node->with_params(point, [&](const Call& c) { i = c.as<Illumination>(); });
  i.Diffuse = opaque(mapped(p, kDiffuseMap, rgb(i.Diffuse), point));
  i.Specular = opaque(mapped(p, kSpecularMap, rgb(i.Specular), point));
  if (map_of(p, kSelfIllumMap)) {
    i.UseSelfIllumColor = true;
    i.SelfIllumColor = opaque(mapped(p, kSelfIllumMap, rgb(i.SelfIllumColor), point));
  }
  const Rgb hidden = mapped(p, kOpacityMap, Rgb(share(p.Opacity)), point);
  const float opacity = clamp01((hidden.x + hidden.y + hidden.z) / 3);
  const Rgb mirror(p.Maps.size > kReflectMap && map_of(p, kReflectMap) ? amount_of(p, kReflectMap)
                                                                       : 0);
  const Rgb left = (Rgb(1) - mirror) * opacity;
  const Frame frame(facing_viewer(point.normal, point));
  illuminate(i, frame, left, closure);
  const Rgb filter = p.OpacityType == 0 ? clamped(p.FilterColor) : Rgb(1);
  add(LobeKind::ThinTransmission, LobeType::Refraction, filter * (1 - opacity), frame, closure);
  add(LobeKind::Mirror, LobeType::Reflection, mirror * opacity,
      Frame(reflecting_outward(frame.n, point)), closure);
}

bool standard_passes(const ShaderNode& node) {
  const auto& p = node.constants<Standard>();
  return share(p.Opacity) < 1 || node.connected(offsetof(Standard, Opacity)) ||
         map_of(p, kOpacityMap);
}

constexpr unsigned kApplySurface = kApplyMaterial | kApplyShadow | kApplyPhoton;

constexpr ShaderSpec kIllumination = {
    .name = "max_base_BlinnIllumination",
    .library = "hosts",
    .apply = kApplySurface,
    .doc = "Fallback for an illumination shader of the standard material of 3ds Max.",
    .params = kIlluminationRows,
    .params_size = sizeof(Illumination),
    .value = [](const Call& call,
                void* result) { *static_cast<Rgba*>(result) = call.as<Illumination>().Diffuse; },
    .material = {.fill = illumination, .max_lobes = [](const ShaderNode&) { return 2; }},
    .fallback = {.is_fallback = true},
};

constexpr ShaderSpec kNodes[] = {
    {.name = "max_DefaultMaterial",
     .library = "hosts",
     .apply = kApplySurface,
     .doc = "Fallback for the default material of objects without one.",
     .params = kDefaultRows,
     .params_size = sizeof(Default),
     .material = {.fill = default_material, .max_lobes = [](const ShaderNode&) { return 2; }},
     .fallback = {.is_fallback = true}},
    {.name = "max_StandardMaterial",
     .library = "hosts",
     .apply = kApplySurface,
     .doc = "Fallback for the standard material of 3ds Max.",
     .params = kStandardRows,
     .params_size = sizeof(Standard),
     .material = {.fill = standard,
                  .may_transmit = standard_passes,
                  .max_lobes = [](const ShaderNode&) { return 4; }},
     .fallback = {.is_fallback = true}},
    kIllumination,
    renamed(kIllumination, "max_base_PhongIllumination"),
    renamed(kIllumination, "max_base_MetalIllumination"),
    renamed(kIllumination, "max_base_OrenNayarBlinnIllumination"),
    renamed(kIllumination, "max_base_WardIllumination"),
    renamed(kIllumination, "max_base_MultiLayerIllumination"),
    renamed(kIllumination, "max_base_StraussIllumination"),
    renamed(kIllumination, "max_base_TranslucentIllumination"),
    {.name = "max_DefaultShadow",
     .library = "hosts",
     .apply = kApplyShadow,
     .doc = "Fallback for the shadow shader of 3ds Max; shadows use the transparency of "
            "the surface.",
     .fallback = {.is_fallback = true}},
};

}  // namespace

std::span<const ShaderSpec> max_materials() { return kNodes; }

}  // namespace oriel
