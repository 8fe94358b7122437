// SPDX-License-Identifier: Apache-2.0
#include "shaders/maya/maya_surface.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "runtime/bump.h"
#include "runtime/shade_input.h"
#include "shaders/maya/host_rows.h"

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
  float roughness, highlightSize;
  Rgba whiteness;
  float angle, spreadX, spreadY, fresnelRefractiveIndex;
};
/// Result of a surface that is used as a value.
struct Shown {
  Rgba outColor, outTransparency;
};
struct Plain {
  Rgba outColor;
  Rgba outTransparency;
};

constexpr auto kRows = about({
    {ORIEL_PARAM(Surface, color), .fallback = {.5f, .5f, .5f}, .doc = "Colour."},
    {ORIEL_PARAM(Surface, transparency), .doc = "Transparency."},
    {ORIEL_PARAM(Surface, ambientColor), .doc = "Ambient emission, multiplied by the colour."},
    {ORIEL_PARAM(Surface, incandescence), .doc = "Self-illumination colour, added."},
    {ORIEL_PARAM(Surface, diffuse), .fallback = {.8f}, .min = 0, .max = 1, .doc = "Colour factor."},
    {ORIEL_PARAM(Surface, translucence), .min = 0, .max = 1,
     .doc = "Fraction of diffuse light from behind."},
    {ORIEL_PARAM(Surface, normalCamera),
     .doc = "Normal of a connected bump node, in camera space; a constant value is ignored."},
    {ORIEL_PARAM(Surface, refractions), .doc = "Whether transparency refracts."},
    {ORIEL_PARAM(Surface, refractiveIndex), .fallback = {1}, .min = 0,
     .doc = "Index of refraction."},
});
/// Parameters of surfaces with mirror reflection.
constexpr auto kMirrorRows = joined(
    kRows, about({
               {ORIEL_PARAM(Surface, specularColor), .fallback = {.5f, .5f, .5f},
                .doc = "Colour of highlight and reflection."},
               {ORIEL_PARAM(Surface, reflectivity), .min = 0, .max = 1, .doc = "Reflectivity."},
           }));
constexpr auto kPhongRows =
    joined(kMirrorRows, about({{ORIEL_PARAM(Surface, cosinePower), .fallback = {20}, .min = 0,
                                .doc = "Highlight exponent."}}));
constexpr auto kPhongERows =
    joined(kMirrorRows, about({
                            {ORIEL_PARAM(Surface, roughness), .fallback = {.7f}, .min = 0,
                             .doc = "Width of the highlight falloff."},
                            {ORIEL_PARAM(Surface, highlightSize), .fallback = {.5f}, .min = 0,
                             .doc = "Highlight size."},
                            {ORIEL_PARAM(Surface, whiteness), .fallback = {.5f, .5f, .5f},
                             .doc = "Colour of the highlight centre.", .support = Support::Ignored},
                        }));
constexpr auto kBlinnRows =
    joined(kMirrorRows, about({
                            {ORIEL_PARAM(Surface, eccentricity), .fallback = {.3f}, .min = 0,
                             .max = 1, .doc = "Highlight width."},
                            {ORIEL_PARAM(Surface, specularRollOff), .fallback = {.7f}, .min = 0,
                             .max = 1, .doc = "Highlight strength."},
                        }));
constexpr auto kAnisotropicRows = joined(
    kMirrorRows,
    about({
        {ORIEL_PARAM(Surface, angle), .unit = "radians", .doc = "Rotation of the anisotropy axes."},
        {ORIEL_PARAM(Surface, spreadX), .fallback = {13}, .min = 0,
         .doc = "Narrowness along the first axis."},
        {ORIEL_PARAM(Surface, spreadY), .fallback = {3}, .min = 0,
         .doc = "Narrowness along the second axis."},
        {ORIEL_PARAM(Surface, roughness), .fallback = {.7f}, .min = 0,
         .doc = "Roughness along both axes."},
        {ORIEL_PARAM(Surface, fresnelRefractiveIndex), .fallback = {1.45f},
         .doc = "Index of refraction of the highlight's Fresnel factor.",
         .support = Support::Ignored},
    }));
constexpr ParamSpec kShownResults[] = {
    {ORIEL_PARAM(Shown, outColor), .doc = "Unlit colour."},
    {ORIEL_PARAM(Shown, outTransparency), .doc = "Transparency."},
};
constexpr auto kPlainRows = about({
    {ORIEL_PARAM(Plain, outColor), .doc = "Visible colour."},
    {ORIEL_PARAM(Plain, outTransparency), .doc = "Transparency."},
});

void add(LobeKind kind, LobeType type, const Rgb& level, const Vec3& normal, Closure& closure) {
  if (is_black(level)) return;
  closure.add(kind, type, level, Frame(normal));
  closure.albedo += level;
}

/// Exporters write 1 1 1 without a bump node, so only a connection modifies the normal.
Vec3 normal_of(const Call& call) {
  constexpr int kSetInCameraSpace = 8;
  const Vec3& normal = call.point.normal;
  if (!call.node || !call.node->connected(offsetof(Surface, normalCamera))) return normal;
  return bump_normal(call.point, normal, call.as<Surface>().normalCamera, kSetInCameraSpace);
}

/// Common part of all surfaces; `left` is the share that the mirror leaves.
Vec3 body(const Call& call, const Rgb& left, Closure& closure) {
  const auto& p = call.as<Surface>();
  const ShadingPoint& point = call.point;
  const Vec3 normal = facing_viewer(normal_of(call), point);
  const Rgb through = clamped(p.transparency) * left, solid = left - through;
  const Rgb diffuse = clamped(p.color) * clamp01(p.diffuse) * solid;
  closure.emission += rgb(p.incandescence) + rgb(p.ambientColor) * clamped(p.color) * solid;
  const float behind = clamp01(p.translucence);
  add(LobeKind::Diffuse, LobeType::Diffuse, diffuse * (1 - behind), normal, closure);
  add(LobeKind::Translucency, LobeType::Translucency, diffuse * behind, normal, closure);
  const float index = p.refractions && p.refractiveIndex > 0 ? p.refractiveIndex : 1;
  const float eta = clamp(point.back_side ? 1 / index : index, 0.1f, 10);
  const int before = closure.count;
  add(eta == 1 ? LobeKind::ThinTransmission : LobeKind::ClearRefraction, LobeType::Refraction,
      through, normal, closure);
  if (eta != 1 && closure.count > before) {
    closure.lobes[before].eta = eta;
    closure.thin_walled = false;
  }
  return normal;
}

Lobe& shine(LobeKind kind, const Rgb& level, const Frame& frame, Closure& closure) {
  Lobe& lobe = closure.add(kind, LobeType::Reflection, level, frame);
  lobe.controls.highlights_only = true;
  return lobe;
}

/// The common part below a mirror of reflectivity x specularColor.
Vec3 coated(const Call& call, Closure& closure) {
  const auto& p = call.as<Surface>();
  const Rgb mirror = clamped(p.specularColor) * clamp01(p.reflectivity);
  const Vec3 normal = body(call, Rgb(1) - mirror, closure);
  add(LobeKind::Mirror, LobeType::Reflection, mirror, reflecting_outward(normal, call.point),
      closure);
  return normal;
}

void phong(const Call& call, Closure& closure) {
  const auto& p = call.as<Surface>();
  const Frame frame(coated(call, closure));
  shine(LobeKind::PhongHighlight, rgb(p.specularColor), frame, closure).roughness =
      std::max(0.0f, p.cosinePower);
}

void phong_e(const Call& call, Closure& closure) {
  const auto& p = call.as<Surface>();
  const Frame frame(coated(call, closure));
  const float width = std::max(.02f, p.roughness * p.highlightSize);
  shine(LobeKind::PhongHighlight, rgb(p.specularColor), frame, closure).roughness = 1 / sqr(width);
}

void blinn(const Call& call, Closure& closure) {
  const auto& p = call.as<Surface>();
  const Frame frame(coated(call, closure));
  Lobe& lobe = shine(LobeKind::TorranceHighlight, rgb(p.specularColor), frame, closure);
  lobe.roughness = std::max(0.01f, p.eccentricity);
  // With a strength of 0.7 the index is about that of plastic.
  lobe.eta = 1 + 0.7f * clamp01(p.specularRollOff);
}

void anisotropic(const Call& call, Closure& closure) {
  const auto& p = call.as<Surface>();
  const Vec3 normal = coated(call, closure);
  const Frame frame = Frame::along(normal, call.point.dpdu);
  const float angle = angle_of(p.angle), c = math::cos(angle), s = math::sin(angle);
  Lobe& lobe = shine(LobeKind::WardHighlight, rgb(p.specularColor),
                     Frame::along(normal, frame.s * c + frame.t * s), closure);
  lobe.alpha_x = clamp(p.roughness / std::max(.1f, p.spreadX), .01f, 1);
  lobe.alpha_y = clamp(p.roughness / std::max(.1f, p.spreadY), .01f, 1);
}

void show(const Call& call, void* result) {
  const auto& p = call.as<Surface>();
  const Rgb seen = rgb(p.color) * p.diffuse + rgb(p.incandescence);
  auto& out = *static_cast<Shown*>(result);
  out.outColor = Rgba(seen.x, seen.y, seen.z, 1);
  out.outTransparency = p.transparency;
}

bool body_passes(const ShaderNode& node) {
  return !is_black(rgb(node.constants<Surface>().transparency)) ||
         node.connected(offsetof(Surface, transparency));
}

bool plain_passes(const ShaderNode& node) {
  return !is_black(rgb(node.constants<Plain>().outTransparency)) ||
         node.connected(offsetof(Plain, outTransparency));
}

int most_coated(const ShaderNode&) { return 5; }

constexpr ShaderSpec surface(const char* name, const char* doc, std::span<const ParamSpec> rows,
                             void (*material)(const Call&, Closure&)) {
  return {
      .name = name,
      .library = "hosts",
      .apply = kApplyMaterial | kApplyShadow | kApplyPhoton,
      .doc = doc,
      .params = rows,
      .params_size = sizeof(Surface),
      .result = ParamType::Struct,
      .results = kShownResults,
      .result_size = sizeof(Shown),
      .value = show,
      .material = {.fill = material, .may_transmit = body_passes, .max_lobes = most_coated},
      .fallback = {.is_fallback = true},
  };
}

void lambert(const Call& call, Closure& closure) { body(call, Rgb(1), closure); }

}  // namespace

const ShaderSpec kMayaLambert = [] {
  ShaderSpec spec = surface("maya_lambert", "Fallback for Maya's lambert.", kRows, lambert);
  spec.material.max_lobes = [](const ShaderNode&) { return 3; };
  return spec;
}();
const ShaderSpec kMayaPhong =
    surface("maya_phong", "Fallback for Maya's phong.", kPhongRows, phong);
const ShaderSpec kMayaPhongE =
    surface("maya_phongE", "Fallback for Maya's phongE.", kPhongERows, phong_e);
const ShaderSpec kMayaBlinn =
    surface("maya_blinn", "Fallback for Maya's blinn.", kBlinnRows, blinn);
const ShaderSpec kMayaAnisotropic =
    surface("maya_anisotropic", "Fallback for Maya's anisotropic.", kAnisotropicRows, anisotropic);

const ShaderSpec kMayaSurfaceshader = {
    .name = "maya_surfaceshader",
    .library = "hosts",
    .apply = kApplyMaterial | kApplyShadow | kApplyPhoton,
    .doc = "Fallback for Maya's surfaceShader: an unlit colour.",
    .params = kPlainRows,
    .params_size = sizeof(Plain),
    .result = ParamType::Struct,
    .results = kShownResults,
    .result_size = sizeof(Shown),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<Plain>();
          *static_cast<Shown*>(result) = {p.outColor, p.outTransparency};
        },
    .material =
        {
            .fill =
                [](const Call& call, Closure& closure) {
                  const auto& p = call.as<Plain>();
                  closure.emission += rgb(p.outColor);
                  add(LobeKind::ThinTransmission, LobeType::Refraction, clamped(p.outTransparency),
                      facing_viewer(call.point.normal, call.point), closure);
                },
            .may_transmit = plain_passes,
        },
    .fallback = {.is_fallback = true},
};

}  // namespace oriel
