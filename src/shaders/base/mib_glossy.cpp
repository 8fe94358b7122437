// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_glossy.h"

#include <algorithm>
#include <cmath>

#include "bsdf/fresnel.h"
#include "bsdf/gloss.h"
#include "runtime/bump.h"
#include "runtime/shade_input.h"

namespace oriel {
namespace {

struct Reflection {
  ShaderRef base_material;
  Rgba reflection_color;
  float max_distance, falloff;
  Rgba environment_color;
  float reflection_base_weight, reflection_edge_weight, edge_factor;
  ShaderRef environment;
  bool single_env_sample;
  int samples;
  float u_spread, v_spread;
  Vec3 u_axis, v_axis;
  float dispersion;
  ArrayView<Rgba> spectrum;
};
struct Refraction {
  ShaderRef top_material, deep_material, back_material;
  bool render_reverse_of_back_material;
  Rgba refraction_color;
  float max_distance, falloff;
  float refraction_base_weight, refraction_edge_weight, edge_factor;
  float ior;
  int samples;
  float u_spread, v_spread;
  Vec3 u_axis, v_axis;
  float dispersion;
  ArrayView<Rgba> spectrum;
};

constexpr const char* kDistance = "Maximum ray length; 0 = unlimited.";
constexpr const char* kFalloff =
    "Exponent of the fade towards max_distance; the fade is always linear.";
constexpr const char* kEdge = "Narrowness of the edge.";
constexpr const char* kSamples = "Maximum number of rays; 0 = no blur.";
constexpr const char* kSpread = "Blur along this axis.";
constexpr const char* kAxis = "Direction of the blur; null = any direction.";
constexpr const char* kDispersion = "Amount of dispersion.";

constexpr ParamSpec kReflectionRows[] = {
    {ORIEL_PARAM(Reflection, base_material), .doc = "Base material.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Reflection, reflection_color), .doc = "Reflection colour.",
     .declared_default = false},
    {ORIEL_PARAM(Reflection, max_distance), .min = 0, .unit = "scene units", .doc = kDistance},
    {ORIEL_PARAM(Reflection, falloff), .fallback = {2}, .doc = kFalloff,
     .support = Support::Ignored},
    {ORIEL_PARAM(Reflection, environment_color), .doc = "Factor of the environment; not applied.",
     .support = Support::Ignored, .declared_default = false},
    {ORIEL_PARAM(Reflection, reflection_base_weight), .fallback = {.6f}, .min = 0, .max = 1,
     .doc = "Reflectivity at normal incidence."},
    {ORIEL_PARAM(Reflection, reflection_edge_weight), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Reflectivity at the edge."},
    {ORIEL_PARAM(Reflection, edge_factor), .fallback = {5}, .min = 0, .doc = kEdge},
    {ORIEL_PARAM(Reflection, environment),
     .doc = "Own environment; that of the material or the scene is used instead.",
     .support = Support::Ignored, .declared_default = false},
    {ORIEL_PARAM(Reflection, single_env_sample), .fallback = {1},
     .doc = "Whether one environment look-up serves all rays."},
    {ORIEL_PARAM(Reflection, samples), .fallback = {16}, .min = 0, .doc = kSamples},
    {ORIEL_PARAM(Reflection, u_spread), .fallback = {.1f}, .min = 0, .doc = kSpread,
     .support = Support::Approximated},
    {ORIEL_PARAM(Reflection, v_spread), .fallback = {.1f}, .min = 0, .doc = kSpread,
     .support = Support::Approximated},
    {ORIEL_PARAM(Reflection, u_axis), .doc = kAxis, .declared_default = false},
    {ORIEL_PARAM(Reflection, v_axis),
     .doc = "Second axis, perpendicular to u_axis; used if that is null.",
     .declared_default = false},
    {ORIEL_PARAM(Reflection, dispersion), .doc = kDispersion, .support = Support::Ignored},
    {ORIEL_PARAM(Reflection, spectrum), .doc = "Dispersion colours.", .support = Support::Ignored,
     .declared_default = false},
};
constexpr ParamSpec kRefractionRows[] = {
    {ORIEL_PARAM(Refraction, top_material), .doc = "Top material.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Refraction, deep_material), .doc = "Colour beyond max_distance; black is used.",
     .support = Support::Ignored, .declared_default = false},
    {ORIEL_PARAM(Refraction, back_material), .doc = "Back face material.",
     .declared_default = false, .takes_material = true},
    {ORIEL_PARAM(Refraction, render_reverse_of_back_material), .fallback = {1},
     .doc = "Whether back faces are shaded with the flipped normal; always on.",
     .support = Support::Ignored},
    {ORIEL_PARAM(Refraction, refraction_color), .fallback = {1, 1, 1}, .doc = "Refraction colour."},
    {ORIEL_PARAM(Refraction, max_distance), .min = 0, .unit = "scene units", .doc = kDistance},
    {ORIEL_PARAM(Refraction, falloff), .fallback = {2}, .doc = kFalloff,
     .support = Support::Ignored},
    {ORIEL_PARAM(Refraction, refraction_base_weight), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Refraction weight at normal incidence."},
    {ORIEL_PARAM(Refraction, refraction_edge_weight), .fallback = {.6f}, .min = 0, .max = 1,
     .doc = "Refraction weight at the edge."},
    {ORIEL_PARAM(Refraction, edge_factor), .fallback = {5}, .min = 0, .doc = kEdge},
    {ORIEL_PARAM(Refraction, ior), .fallback = {1}, .min = 0, .doc = "Index of refraction."},
    {ORIEL_PARAM(Refraction, samples), .fallback = {16}, .min = 0, .doc = kSamples},
    {ORIEL_PARAM(Refraction, u_spread), .fallback = {.1f}, .min = 0, .doc = kSpread,
     .support = Support::Approximated},
    {ORIEL_PARAM(Refraction, v_spread), .fallback = {.1f}, .min = 0, .doc = kSpread,
     .support = Support::Approximated},
    {ORIEL_PARAM(Refraction, u_axis), .doc = kAxis, .declared_default = false},
    {ORIEL_PARAM(Refraction, v_axis),
     .doc = "Second axis, perpendicular to u_axis; used if that is null.",
     .declared_default = false},
    {ORIEL_PARAM(Refraction, dispersion), .doc = kDispersion, .support = Support::Ignored},
    {ORIEL_PARAM(Refraction, spectrum), .doc = "Dispersion colours.", .support = Support::Ignored,
     .declared_default = false},
};

Rgb level_of(const Rgba& color, float facing, float edge, float exponent, float cosine) {
  const float weight =
      clamp01(bsdf::ReflectivityCurve{facing, edge, std::max(0.0f, exponent)}(cosine));
  return Rgb(clamp01(color.r), clamp01(color.g), clamp01(color.b)) * weight;
}

template <class P>
Frame blurred_frame(const P& p, const Vec3& normal) {
  if (p.u_axis != Vec3(0)) return Frame::along(normal, p.u_axis);
  return p.v_axis != Vec3(0) ? Frame::along(normal, cross(p.v_axis, normal)) : Frame(normal);
}

/// Returns false if the lobe is not blurred.
template <class P>
bool blur(const P& p, Lobe& lobe) {
  lobe.controls.samples = static_cast<float>(std::max(1, p.samples));
  const bsdf::Roughness roughness = bsdf::limited_roughness(p.u_spread, p.v_spread);
  lobe.alpha_x = roughness.ax;
  lobe.alpha_y = roughness.ay;
  return p.samples > 0 && std::max(p.u_spread, p.v_spread) >= bsdf::kMinAlpha;
}

void reflection(const Call& call, Closure& closure) {
  const auto& p = call.as<Reflection>();
  const Vec3 normal = facing_viewer(call.point.normal, call.point);
  const Rgb k = level_of(p.reflection_color, p.reflection_base_weight, p.reflection_edge_weight,
                         p.edge_factor, dot(normal, call.point.wo()));
  shade_input(call, offsetof(Reflection, base_material), p.base_material, Rgb(1) - k, closure);
  if (is_black(k)) return;
  Lobe& lobe = closure.add(LobeKind::GlossyReflection, LobeType::Reflection, k,
                           blurred_frame(p, reflecting_outward(normal, call.point)));
  if (!blur(p, lobe)) lobe.kind = LobeKind::Mirror;
  lobe.controls.falloff_distance = std::max(0.0f, p.max_distance);
  lobe.controls.single_environment = p.single_env_sample && lobe.kind != LobeKind::Mirror;
  closure.albedo += k;
}

void refraction(const Call& call, Closure& closure) {
  const auto& p = call.as<Refraction>();
  const ShadingPoint& point = call.point;
  const Vec3 normal = facing_viewer(point.normal, point);
  const Rgb k = level_of(p.refraction_color, p.refraction_base_weight, p.refraction_edge_weight,
                         p.edge_factor, dot(normal, point.wo()));
  const bool back = point.back_side && p.back_material.node;
  if (back)
    shade_input(call, offsetof(Refraction, back_material), p.back_material, Rgb(1) - k, closure);
  else
    shade_input(call, offsetof(Refraction, top_material), p.top_material, Rgb(1) - k, closure);
  if (is_black(k)) return;
  const float index = clamp(p.ior > 0 ? p.ior : 1, 0.1f, 10);
  const bool straight = index == 1;
  Lobe& lobe = closure.add(straight ? LobeKind::GlossyThin : LobeKind::GlossyRefraction,
                           LobeType::Refraction, k, blurred_frame(p, normal));
  lobe.eta = point.back_side ? 1 / index : index;
  if (!blur(p, lobe)) lobe.kind = straight ? LobeKind::ThinTransmission : LobeKind::ClearRefraction;
  closure.thin_walled = straight;
  if (!straight && p.max_distance > 0) closure.inside.black_distance = p.max_distance;
  closure.albedo += k;
}

}  // namespace

const ShaderSpec kMibGlossyReflection = {
    .name = "mib_glossy_reflection",
    .library = "base",
    .version = 3,
    .apply = kApplyMaterial | kApplyTexture,
    .doc = "Blurred reflection blended over another material.",
    .params = kReflectionRows,
    .params_size = sizeof(Reflection),
    .material = {.fill = reflection,
                 .may_transmit = [](const ShaderNode& node) { return node.inputs_may_transmit(); }},
};

const ShaderSpec kMibGlossyRefraction = {
    .name = "mib_glossy_refraction",
    .library = "base",
    .version = 3,
    .apply = kApplyMaterial | kApplyTexture,
    .doc = "Blurred refraction blended over other materials.",
    .params = kRefractionRows,
    .params_size = sizeof(Refraction),
    .material = {.fill = refraction,
                 .may_transmit = [](const ShaderNode&) { return true; },
                 .one_material = true},
};

}  // namespace oriel
