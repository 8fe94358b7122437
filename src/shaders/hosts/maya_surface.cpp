// SPDX-License-Identifier: Apache-2.0
#include "shaders/hosts/maya_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/bump.h"
#include "runtime/shade_input.h"

namespace oriel {
namespace {

struct Surface {
  Rgba color, transparency, ambientColor, incandescence;
  float diffuse, translucence;
  Vec3 normalCamera;
  bool refractions;
  float refractiveIndex;
  Rgba specularColor;
  float reflectivity, cosinePower, eccentricity, specularRollOff;
};
struct Plain {
  Rgba outColor;
  Rgba outTransparency;
};
struct Engine {
  Rgba surfaceShader;
  float cutAwayOpacity;
};
struct Shadow {
  Rgba transparency;
};

constexpr Support kAbout = Support::Approximated;

constexpr ParamSpec kRows[] = {
    {ORIEL_PARAM(Surface, color), .fallback = {.5f, .5f, .5f}, .doc = "Colour.", .support = kAbout},
    {ORIEL_PARAM(Surface, transparency), .doc = "Share that is seen through.", .support = kAbout},
    {ORIEL_PARAM(Surface, ambientColor), .doc = "Light of its own, times the colour.",
     .support = kAbout},
    {ORIEL_PARAM(Surface, incandescence), .doc = "Light that is added.", .support = kAbout},
    {ORIEL_PARAM(Surface, diffuse), .fallback = {.8f}, .min = 0, .max = 1,
     .doc = "Factor of the colour.", .support = kAbout},
    {ORIEL_PARAM(Surface, translucence), .min = 0, .max = 1,
     .doc = "Share of the diffuse light that comes from behind.", .support = kAbout},
    {ORIEL_PARAM(Surface, normalCamera), .doc = "Normal of a bump node, in camera space.",
     .support = kAbout},
    {ORIEL_PARAM(Surface, refractions), .doc = "Bend what is seen through.", .support = kAbout},
    {ORIEL_PARAM(Surface, refractiveIndex), .fallback = {1}, .min = 0,
     .doc = "Index of refraction.", .support = kAbout},
};
/// Rows of those that mirror.
constexpr ParamSpec kSpecularRow = {ORIEL_PARAM(Surface, specularColor),
                                    .fallback = {.5f, .5f, .5f},
                                    .doc = "Colour of highlight and mirror.", .support = kAbout};
constexpr ParamSpec kReflectivityRow = {ORIEL_PARAM(Surface, reflectivity), .min = 0, .max = 1,
                                        .doc = "Share of the mirror.", .support = kAbout};
constexpr ParamSpec kPhongTail[] = {
    kSpecularRow,
    kReflectivityRow,
    {ORIEL_PARAM(Surface, cosinePower), .fallback = {20}, .min = 0,
     .doc = "Narrowness of the highlight.", .support = kAbout},
};
constexpr ParamSpec kBlinnTail[] = {
    kSpecularRow,
    kReflectivityRow,
    {ORIEL_PARAM(Surface, eccentricity), .fallback = {.3f}, .min = 0, .max = 1,
     .doc = "Width of the highlight.", .support = kAbout},
    {ORIEL_PARAM(Surface, specularRollOff), .fallback = {.7f}, .min = 0, .max = 1,
     .doc = "Strength of the highlight.", .support = kAbout},
};

template <std::size_t N, std::size_t M>
constexpr std::array<ParamSpec, N + M> joined(const ParamSpec (&head)[N],
                                              const ParamSpec (&tail)[M]) {
  std::array<ParamSpec, N + M> all{};
  for (std::size_t i = 0; i < N; ++i) all[i] = head[i];
  for (std::size_t i = 0; i < M; ++i) all[N + i] = tail[i];
  return all;
}
constexpr auto kPhongRows = joined(kRows, kPhongTail);
constexpr auto kBlinnRows = joined(kRows, kBlinnTail);

constexpr ParamSpec kPlainRows[] = {
    {ORIEL_PARAM(Plain, outColor), .doc = "What is seen.", .support = kAbout},
    {ORIEL_PARAM(Plain, outTransparency), .doc = "Share that is seen through.", .support = kAbout},
};
constexpr ParamSpec kEngineRows[] = {
    {ORIEL_PARAM(Engine, surfaceShader), .doc = "The surface.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Engine, cutAwayOpacity), .doc = "Alpha of what is transparent.",
     .support = Support::Ignored},
};
constexpr ParamSpec kShadowRows[] = {
    {ORIEL_PARAM(Shadow, transparency), .doc = "Share of the light that passes.",
     .support = kAbout},
};

Rgb clamped(const Rgba& c) { return Rgb(clamp01(c.r), clamp01(c.g), clamp01(c.b)); }

void add(LobeKind kind, Channel channel, const Rgb& level, const Vec3& normal, Closure& closure) {
  if (is_black(level)) return;
  closure.add(kind, channel, level, Frame(normal));
  closure.albedo += level;
}

/// What lambert, phong and blinn share; `left` is what a mirror leaves.
Vec3 body(const Surface& p, const ShadingPoint& point, const Rgb& left, Closure& closure) {
  constexpr int kSetInCameraSpace = 8;
  const Vec3 normal =
      facing_viewer(bump_normal(point, point.normal, p.normalCamera, kSetInCameraSpace), point);
  const Rgb through = clamped(p.transparency) * left, solid = left - through;
  const Rgb diffuse = clamped(p.color) * clamp01(p.diffuse) * solid;
  closure.emission += rgb(p.incandescence) + rgb(p.ambientColor) * clamped(p.color) * solid;
  const float behind = clamp01(p.translucence);
  add(LobeKind::Diffuse, Channel::Diffuse, diffuse * (1 - behind), normal, closure);
  add(LobeKind::Translucency, Channel::Translucency, diffuse * behind, normal, closure);
  const float index = p.refractions && p.refractiveIndex > 0 ? p.refractiveIndex : 1;
  const float eta = clamp(point.back_side ? 1 / index : index, 0.1f, 10);
  const int before = closure.count;
  add(eta == 1 ? LobeKind::ThinTransmission : LobeKind::ClearRefraction, Channel::Refraction,
      through, normal, closure);
  if (eta != 1 && closure.count > before) {
    closure.lobes[before].eta = eta;
    closure.thin_walled = false;
  }
  return normal;
}

Lobe& shine(LobeKind kind, const Rgb& level, const Vec3& normal, Closure& closure) {
  Lobe& lobe = closure.add(kind, Channel::Reflection, level, Frame(normal));
  lobe.controls.highlights_only = true;
  return lobe;
}

/// Body under a mirror of reflectivity x specularColor.
Vec3 coated(const Surface& p, const ShadingPoint& point, Closure& closure) {
  const Rgb mirror = clamped(p.specularColor) * clamp01(p.reflectivity);
  const Vec3 normal = body(p, point, Rgb(1) - mirror, closure);
  add(LobeKind::Mirror, Channel::Reflection, mirror, reflecting_outward(normal, point), closure);
  return normal;
}

void phong(const Call& call, Closure& closure) {
  const auto& p = call.as<Surface>();
  const Vec3 normal = coated(p, call.point, closure);
  shine(LobeKind::PhongHighlight, rgb(p.specularColor), normal, closure).roughness =
      std::max(0.0f, p.cosinePower);
}

void blinn(const Call& call, Closure& closure) {
  const auto& p = call.as<Surface>();
  const Vec3 normal = coated(p, call.point, closure);
  Lobe& lobe = shine(LobeKind::TorranceHighlight, rgb(p.specularColor), normal, closure);
  lobe.roughness = std::max(0.01f, p.eccentricity);
  // A strength of 0.7 is about the index of plastic.
  lobe.eta = 1 + 0.7f * clamp01(p.specularRollOff);
}

bool body_passes(const ShaderNode& node) {
  return !is_black(rgb(node.constants<Surface>().transparency)) ||
         node.connected(offsetof(Surface, transparency));
}

bool plain_passes(const ShaderNode& node) {
  return !is_black(rgb(node.constants<Plain>().outTransparency)) ||
         node.connected(offsetof(Plain, outTransparency));
}

constexpr unsigned kApplySurface = kApplyMaterial | kApplyShadow | kApplyPhoton;

}  // namespace

const ShaderSpec kMayaLambert = {
    .name = "maya_lambert",
    .library = "hosts",
    .apply = kApplySurface,
    .doc = "Stand-in for the host's lambert.",
    .params = kRows,
    .params_size = sizeof(Surface),
    .material = [](const Call& call,
                   Closure& closure) { body(call.as<Surface>(), call.point, Rgb(1), closure); },
    .may_transmit = body_passes,
    .most_lobes = [](const ShaderNode&) { return 3; },
};

const ShaderSpec kMayaPhong = {
    .name = "maya_phong",
    .library = "hosts",
    .apply = kApplySurface,
    .doc = "Stand-in for the host's phong.",
    .params = kPhongRows,
    .params_size = sizeof(Surface),
    .material = phong,
    .may_transmit = body_passes,
    .most_lobes = [](const ShaderNode&) { return 5; },
};

const ShaderSpec kMayaBlinn = {
    .name = "maya_blinn",
    .library = "hosts",
    .apply = kApplySurface,
    .doc = "Stand-in for the host's blinn.",
    .params = kBlinnRows,
    .params_size = sizeof(Surface),
    .material = blinn,
    .may_transmit = body_passes,
    .most_lobes = [](const ShaderNode&) { return 5; },
};

const ShaderSpec kMayaSurfaceshader = {
    .name = "maya_surfaceshader",
    .library = "hosts",
    .apply = kApplySurface,
    .doc = "Stand-in for the host's surface shader: a colour as it stands.",
    .params = kPlainRows,
    .params_size = sizeof(Plain),
    .value = [](const Call& call,
                void* result) { *static_cast<Rgba*>(result) = call.as<Plain>().outColor; },
    .material =
        [](const Call& call, Closure& closure) {
          const auto& p = call.as<Plain>();
          closure.emission += rgb(p.outColor);
          add(LobeKind::ThinTransmission, Channel::Refraction, clamped(p.outTransparency),
              facing_viewer(call.point.normal, call.point), closure);
        },
    .may_transmit = plain_passes,
};

const ShaderSpec kMayaShadingengine = {
    .name = "maya_shadingengine",
    .library = "hosts",
    .apply = kApplySurface,
    .doc = "Stand-in for the host's shading engine: the surface it is connected to.",
    .params = kEngineRows,
    .params_size = sizeof(Engine),
    .material =
        [](const Call& call, Closure& closure) {
          const auto& p = call.as<Engine>();
          shade_input(call, offsetof(Engine, surfaceShader), p.surfaceShader, Rgb(1), closure);
        },
    .may_transmit = [](const ShaderNode& node) { return node.inputs_may_transmit(); },
    .most_lobes = [](const ShaderNode&) { return 0; },
};

const ShaderSpec kMayaShadow = {
    .name = "maya_shadow",
    .library = "hosts",
    .apply = kApplyShadow,
    .doc = "Stand-in for the host's shadows.",
    .params = kShadowRows,
    .params_size = sizeof(Shadow),
    .shadow = [](const Call& call,
                 const Rgb& light) { return light * clamped(call.as<Shadow>().transparency); },
    .may_transmit =
        [](const ShaderNode& node) {
          return !is_black(rgb(node.constants<Shadow>().transparency)) ||
                 node.connected(offsetof(Shadow, transparency));
        },
};

}  // namespace oriel
