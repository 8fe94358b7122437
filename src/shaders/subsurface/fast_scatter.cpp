// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "runtime/bump.h"
#include "runtime/closure.h"
#include "runtime/shade_input.h"
#include "shaders/subsurface/scatter_light.h"
#include "shaders/subsurface/scatter_params.h"
#include "shaders/subsurface/subsurface.h"

namespace oriel {
namespace {

// Weights of the layers: the values that the Softimage guide recommends for skin. Colours of the
// back layer: defaults of 3ds Max for the materials misss_fast_simple_phen and _skin_phen.
constexpr auto kScatterDiffuseRows = about({
    {ORIEL_PARAM(ScatterParams, bump), .doc = "Bump shader."},
    {ORIEL_PARAM(ScatterParams, diffuse_color), .fallback = {1, 1, 1},
     .doc = "Colour of the unscattered diffuse layer."},
    {ORIEL_PARAM(ScatterParams, diffuse_weight), .fallback = {.3f}, .min = 0, .max = 1,
     .doc = "Weight of the unscattered diffuse layer."},
    {ORIEL_PARAM(ScatterParams, front_sss_color), .fallback = {1, 1, 1},
     .doc = "Colour of front scattering."},
    {ORIEL_PARAM(ScatterParams, front_sss_weight), .fallback = {.5f}, .min = 0, .max = 1,
     .doc = "Weight of front scattering."},
    {ORIEL_PARAM(ScatterParams, screen_composit), .fallback = {1},
     .doc = "Whether layers are combined as 1 - product(1 - layer) instead of added."},
});
constexpr auto kScatterOverallRows = about({
    {ORIEL_PARAM(ScatterParams, ambient), .doc = "Ambient light on all layers."},
    {ORIEL_PARAM(ScatterParams, overall_color), .fallback = {1, 1, 1},
     .doc = "Colour factor of all layers."},
});
constexpr auto kScatterMidRows = about({
    {ORIEL_PARAM(ScatterParams, mid_sss_color), .fallback = {1, 1, 1},
     .doc = "Colour of the second scattering layer."},
    {ORIEL_PARAM(ScatterParams, mid_sss_weight), .fallback = {.5f}, .min = 0, .max = 1,
     .doc = "Weight of the second scattering layer."},
    {ORIEL_PARAM(ScatterParams, mid_sss_radius), .min = 0, .unit = "scene units",
     .doc = "Scatter radius of the second scattering layer; 0 = none."},
});
constexpr auto kScatterBackRows = about({
    {ORIEL_PARAM(ScatterParams, back_sss_color), .fallback = {.8f, .4f, .1f},
     .doc = "Colour of light from the other side of a thin wall."},
    {ORIEL_PARAM(ScatterParams, back_sss_weight), .fallback = {.5f}, .min = 0, .max = 1,
     .doc = "Weight of light from the other side of a thin wall."},
});
constexpr auto kScatterSkinBackRows = about({
    {ORIEL_PARAM(ScatterParams, back_sss_color), .fallback = {.7f, .1f, .1f},
     .doc = "Colour of light from the other side of a thin wall."},
    {ORIEL_PARAM(ScatterParams, back_sss_weight), .fallback = {.5f}, .min = 0, .max = 1,
     .doc = "Weight of light from the other side of a thin wall."},
});
constexpr auto kScatterSpecularRows = about({
    {ORIEL_PARAM(ScatterParams, specular), .doc = "Colour of the highlight.",
     .alias = "specular_color"},
    {ORIEL_PARAM(ScatterParams, exponent), .fallback = {20}, .min = 0,
     .doc = "Exponent of the highlight."},
});
constexpr auto kScatterInputRows = about({
    {ORIEL_PARAM(ScatterParams, diffuse_illum),
     .doc = "Material of the diffuse layer; none = a Lambert surface.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(ScatterParams, specular_illum), .doc = "Material whose light is added.",
     .declared_default = false, .takes_material = true},
    {ORIEL_PARAM(ScatterParams, output_sss_only), .doc = "Whether the diffuse layer is left out."},
});
constexpr auto kScatterRadiusRows = about({
    {ORIEL_PARAM(ScatterParams, front_sss_radius), .min = 0, .unit = "scene units",
     .doc = "Scatter radius of the front; 0 = none."},
    {ORIEL_PARAM(ScatterParams, back_sss_radius), .min = 0, .unit = "scene units",
     .doc = "Scatter radius of the back."},
    {ORIEL_PARAM(ScatterParams, back_sss_depth), .min = 0, .unit = "scene units",
     .doc = "Thickness that light from the back passes; 0 = thin walls only."},
});
constexpr auto kScatterMapRows = about({
    {ORIEL_PARAM(ScatterParams, lightmap_size), .doc = "Size of the light map.",
     .support = Support::Ignored},
    {ORIEL_PARAM(ScatterParams, samples), .doc = "Samples of the light map.",
     .support = Support::Ignored},
    {ORIEL_PARAM(ScatterParams, lightmap_gamma), .doc = "Curve of the light map.",
     .support = Support::Ignored},
    {ORIEL_PARAM(ScatterParams, indirect), .doc = "Whether indirect light is scattered.",
     .support = Support::Ignored},
    {ORIEL_PARAM(ScatterParams, scale_conversion), .fallback = {1}, .min = 0,
     .doc = "Factor of radii and depth."},
    {ORIEL_PARAM(ScatterParams, scatter_bias), .doc = "Direction of scattering.",
     .support = Support::Ignored},
    {ORIEL_PARAM(ScatterParams, falloff), .doc = "Shape of the profile.",
     .support = Support::Ignored},
    {ORIEL_PARAM(ScatterParams, mode), .doc = "Light list mode.", .support = Support::Ignored},
});

constexpr auto kFastRows =
    joined(joined(kScatterOverallRows, kScatterDiffuseRows),
           joined(kScatterRadiusRows, joined(kScatterMapRows, kScatterInputRows)));
constexpr auto kFastSimpleRows = joined(kFastRows, joined(kScatterBackRows, kScatterSpecularRows));
constexpr auto kFastSkinRows =
    joined(kFastRows, joined(joined(kScatterMidRows, kScatterSkinBackRows), kSkinSpecularRows));
constexpr auto kFastShaderRows =
    joined(joined(kScatterDiffuseRows, kScatterBackRows),
           joined(kScatterRadiusRows, joined(kScatterMapRows, kScatterInputRows)));
// Its radii are vectors, which are not declared.
constexpr auto kFastShader2Rows =
    joined(kScatterDiffuseRows, joined(kScatterBackRows, kScatterInputRows));

/// Which layers a shader has; the others count nothing.
enum ScatterLayers : unsigned { kOverall = 1, kMid = 2, kPhong = 4, kSkin = 8 };

Rgb layer(const Rgba& color, float weight) { return clamped(color) * clamp01(weight); }

/// Factor of all layers such that they reflect at most 1 together.
Rgb composition(const Rgb (&layers)[4], bool screen) {
  Rgb sum(0), left(1), factor(1);
  for (const Rgb& l : layers) {
    sum += l;
    left *= Rgb(1) - l;
  }
  for (int k = 0; k < 3; ++k)
    if (sum[k] > 0) factor[k] = (screen ? 1 - left[k] : std::min(1.0f, sum[k])) / sum[k];
  return factor;
}

Vec3 scatter_normal(const Call& call, const ScatterParams& p) {
  ShadingPoint bumped = call.point;
  if (p.bump.node && p.bump.node->spec().value) p.bump.node->vector(bumped);
  return facing_viewer(bumped.normal, call.point);
}

void add_scatter(LobeKind kind, LobeType type, const Rgb& weight, const Vec3& normal,
                 Closure& closure) {
  if (is_black(weight)) return;
  closure.add(kind, type, weight, Frame(normal));
  closure.albedo += weight;
}

bool has_input(const Call& call, std::size_t offset) {
  return call.node && call.node->material_input(offset);
}

/// What the closure reflects where light enters, after layers with a radius were added as light.
struct ScatterSum {
  const Call& call;
  Closure& closure;
  Rgb factor;
  float scale;
  Rgb reflected{0};

  /// Scene units; 0 below, and limited above, what rays resolve.
  float length_of(float parameter) const {
    constexpr float kMin = 1e-6f, kMax = 1e6f;
    const float x = parameter * scale;
    return x > kMin ? std::min(x, kMax) : 0;
  }
  void add(const Rgb& layer, float radius) {
    if (is_black(layer)) return;
    const float spread = length_of(radius);
    if (spread == 0 || !scatters_below(call.point)) {
      reflected += layer;
      return;
    }
    closure.emission += layer * factor * scattered_light(call.point, spread);
    closure.albedo += layer * factor;
  }
  void add_back(const Rgb& layer, float radius, float depth, const Vec3& normal) {
    if (is_black(layer)) return;
    if (length_of(depth) == 0 || !scatters_below(call.point))
      return add_scatter(LobeKind::Translucency, LobeType::Translucency, layer * factor, normal,
                         closure);
    closure.emission +=
        layer * factor * back_scattered_light(call.point, length_of(radius), length_of(depth));
    closure.albedo += layer * factor;
  }
};

template <unsigned kLayers>
void fill_scatter(const Call& call, Closure& closure) {
  const auto& p = call.as<ScatterParams>();
  const Vec3 normal = scatter_normal(call, p);
  Rgb layers[4] = {p.output_sss_only ? Rgb(0) : layer(p.diffuse_color, p.diffuse_weight),
                   layer(p.front_sss_color, p.front_sss_weight),
                   kLayers & kMid ? layer(p.mid_sss_color, p.mid_sss_weight) : Rgb(0),
                   layer(p.back_sss_color, p.back_sss_weight)};
  if (kLayers & kOverall)
    for (Rgb& l : layers) l *= clamped(p.overall_color);
  Rgb factor = composition(layers, p.screen_composit);
  if (kLayers & kSkin) factor *= add_skin_specular(call, p, normal, closure);
  if (kLayers & kOverall)
    closure.emission += rgb(p.ambient) * (layers[0] + layers[1] + layers[2]) * factor;
  ScatterSum sum{call, closure, factor, p.scale_conversion > 0 ? p.scale_conversion : 1};
  sum.add(layers[1], p.front_sss_radius);
  sum.add(layers[2], p.mid_sss_radius);
  if (has_input(call, offsetof(ScatterParams, diffuse_illum)))
    shade_input(call, offsetof(ScatterParams, diffuse_illum), p.diffuse_illum, layers[0] * factor,
                closure);
  else
    sum.reflected += layers[0];
  add_scatter(LobeKind::Diffuse, LobeType::Diffuse, sum.reflected * factor, normal, closure);
  sum.add_back(layers[3], p.back_sss_radius, p.back_sss_depth, normal);
  if (has_input(call, offsetof(ScatterParams, specular_illum)))
    shade_input(call, offsetof(ScatterParams, specular_illum), p.specular_illum, Rgb(1), closure);
  if (!(kLayers & kPhong) || is_black(rgb(p.specular))) return;
  Lobe& highlight =
      closure.add(LobeKind::PhongHighlight, LobeType::Reflection, rgb(p.specular), Frame(normal));
  highlight.controls.highlights_only = true;
  highlight.roughness = std::max(0.0f, p.exponent);
}

template <unsigned kLayers>
constexpr ShaderSpec scattering(const char* name, const char* doc, const char* aliases,
                                std::span<const ParamSpec> rows) {
  return {
      .name = name,
      .library = "hosts",
      .apply = kApplyMaterial | kApplyShadow | kApplyPhoton,
      .doc = doc,
      .params = rows,
      .params_size = sizeof(ScatterParams),
      .material = {
          .fill = fill_scatter<kLayers>,
          .may_transmit = [](const ShaderNode& node) { return node.inputs_may_transmit(); },
          .max_lobes =
              [](const ShaderNode&) {
                return 2 + (kLayers & kPhong ? 1 : 0) + (kLayers & kSkin ? kSkinSpecularLobes : 0);
              },
      },
      .fallback = {.is_fallback = true, .aliases = aliases},
  };
}

}  // namespace

const ShaderSpec kMisssFastSimple = scattering<kOverall | kPhong>(
    "misss_fast_simple_maya",
    "Fallback for the simple subsurface material: layers of a diffusion profile.",
    "misss_fast_simple_phen misss_fast_simple_phen_d misss_fast_simple", kFastSimpleRows);
const ShaderSpec kMisssFastSkin = scattering<kOverall | kMid | kSkin>(
    "misss_fast_skin_maya",
    "Fallback for the skin material: layers of a diffusion profile, highlights, reflection.",
    "misss_fast_skin_phen misss_fast_skin_phen_d misss_fast_skin misss_mia_skin2_phen "
    "misss_mia_skin2_phen_d misss_mia_skin2_surface_phen misss_mia_skin",
    kFastSkinRows);
const ShaderSpec kMisssFastShader = scattering<0>(
    "misss_fast_shader", "Fallback for the scattering component: layers of a diffusion profile.",
    "misss_fast_shader_x", kFastShaderRows);
const ShaderSpec kMisssFastShader2 =
    scattering<0>("misss_fast_shader2",
                  "Fallback for the second scattering component: layers without scatter radius.",
                  "misss_fast_shader2_x", kFastShader2Rows);

}  // namespace oriel
