// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "runtime/bump.h"
#include "runtime/closure.h"
#include "runtime/shade_input.h"
#include "shaders/subsurface/scatter_params.h"
#include "shaders/subsurface/subsurface.h"

namespace oriel {

Rgb add_skin_specular(const Call& call, const ScatterParams& p, const Vec3& normal,
                      Closure& closure) {
  const float cosine = clamp01(dot(normal, call.point.wo()));
  const float edge = math::pow(1 - cosine, std::max(0.0f, p.edge_factor));
  const float overall = std::max(0.0f, p.overall_weight);
  const auto highlight = [&](const Rgba& color, float weight, float edge_weight, float exponent) {
    const Rgb level = rgb(color) * (overall * (weight + edge_weight * edge));
    if (is_black(level)) return;
    Lobe& lobe = closure.add(LobeKind::PhongHighlight, LobeType::Reflection, level, Frame(normal));
    lobe.controls.highlights_only = true;
    lobe.roughness = std::max(0.0f, exponent);
  };
  highlight(p.primary_spec_color, p.primary_weight, p.primary_edge_weight, p.primary_shinyness);
  highlight(p.secondary_spec_color, p.secondary_weight, p.secondary_edge_weight,
            p.secondary_shinyness);
  const Rgb mirror(clamp01(overall * (p.reflect_weight + p.reflect_edge_weight * edge)));
  if (is_black(mirror)) return Rgb(1);
  const bool glossy = p.reflect_shinyness > 0;
  Lobe& lobe =
      closure.add(glossy ? LobeKind::GlossyReflection : LobeKind::Mirror, LobeType::Reflection,
                  mirror, Frame(reflecting_outward(normal, call.point)));
  // The slope of a Phong exponent: B. Walter et al., "Microfacet Models for Refraction", EGSR 2007.
  lobe.alpha_x = lobe.alpha_y = glossy ? std::sqrt(2 / (p.reflect_shinyness + 2)) : 0;
  closure.albedo += mirror;
  return Rgb(1) - mirror;
}

namespace {

struct LambertGamma {
  Rgba ambient, ambience, diffuse;
  int flip;
  bool indirect;
  float diffuse_curve;
  int mode;
};
struct CallShader {
  ShaderRef shader, default_shader;
  int mode;
};
struct SetNormal {
  Vec3 normal;
  int space;
  bool add;
};
struct LightmapWrite {
  Rgba input;
  float lightmap_size, scatter_bias, lightmap_gamma;
  Rgba ambient;
  bool indirect;
  int write_lightmap, samples, mode;
};

constexpr auto kLambertGammaRows = about({
    {ORIEL_PARAM(LambertGamma, ambient), .doc = "Ambient colour, multiplied by ambience."},
    {ORIEL_PARAM(LambertGamma, ambience), .doc = "Ambient light."},
    {ORIEL_PARAM(LambertGamma, diffuse), .fallback = {1, 1, 1}, .doc = "Diffuse colour."},
    {ORIEL_PARAM(LambertGamma, flip), .doc = "Whether light from the other side is shown."},
    {ORIEL_PARAM(LambertGamma, indirect), .doc = "Whether indirect light is included.",
     .support = Support::Ignored},
    {ORIEL_PARAM(LambertGamma, diffuse_curve), .fallback = {1},
     .doc = "Exponent of the cosine to the light.", .support = Support::Ignored},
    {ORIEL_PARAM(LambertGamma, mode), .doc = "Light list mode.", .support = Support::Ignored},
});
constexpr auto kCallShaderRows = about({
    {ORIEL_PARAM(CallShader, shader), .doc = "Shader to call.", .takes_material = true},
    {ORIEL_PARAM(CallShader, default_shader), .doc = "Shader to call if there is no other.",
     .takes_material = true},
    {ORIEL_PARAM(CallShader, mode), .doc = "Kind of call.", .support = Support::Ignored},
});
constexpr auto kSetNormalRows = about({
    {ORIEL_PARAM(SetNormal, normal), .doc = "Normal.", .support = Support::Ignored},
    {ORIEL_PARAM(SetNormal, space), .doc = "Space of the normal.", .support = Support::Ignored},
    {ORIEL_PARAM(SetNormal, add), .doc = "Whether the normal is added.",
     .support = Support::Ignored},
});
constexpr auto kLightmapRows = about({
    {ORIEL_PARAM(LightmapWrite, input), .doc = "Light to store.", .support = Support::Ignored},
    {ORIEL_PARAM(LightmapWrite, lightmap_size), .doc = "Size of the light map.",
     .support = Support::Ignored},
    {ORIEL_PARAM(LightmapWrite, scatter_bias), .doc = "Direction of scattering.",
     .support = Support::Ignored},
    {ORIEL_PARAM(LightmapWrite, lightmap_gamma), .doc = "Curve of the light map.",
     .support = Support::Ignored},
    {ORIEL_PARAM(LightmapWrite, ambient), .doc = "Ambient light.", .support = Support::Ignored},
    {ORIEL_PARAM(LightmapWrite, indirect), .doc = "Whether indirect light is stored.",
     .support = Support::Ignored},
    {ORIEL_PARAM(LightmapWrite, write_lightmap), .doc = "Whether the light map is written.",
     .support = Support::Ignored},
    {ORIEL_PARAM(LightmapWrite, samples), .doc = "Samples of the light map.",
     .support = Support::Ignored},
    {ORIEL_PARAM(LightmapWrite, mode), .doc = "Light list mode.", .support = Support::Ignored},
});

void lambert_gamma(const Call& call, Closure& closure) {
  const auto& p = call.as<LambertGamma>();
  const Rgb diffuse = clamped(p.diffuse);
  const bool behind = p.flip != 0;
  closure.emission += rgb(p.ambient) * rgb(p.ambience);
  closure.add(behind ? LobeKind::Translucency : LobeKind::Diffuse,
              behind ? LobeType::Translucency : LobeType::Diffuse, diffuse,
              Frame(facing_viewer(call.point.normal, call.point)));
  closure.albedo += diffuse;
}

void skin_specular(const Call& call, Closure& closure) {
  add_skin_specular(call, call.as<ScatterParams>(), facing_viewer(call.point.normal, call.point),
                    closure);
}

void called_shader(const Call& call, Closure& closure) {
  const auto& p = call.as<CallShader>();
  if (p.shader.node)
    shade_input(call, offsetof(CallShader, shader), p.shader, Rgb(1), closure);
  else
    shade_input(call, offsetof(CallShader, default_shader), p.default_shader, Rgb(1), closure);
}

constexpr unsigned kApplyScattering = kApplyMaterial | kApplyShadow | kApplyPhoton;

constexpr ShaderSpec without_effect(const char* name, const char* doc,
                                    std::span<const ParamSpec> rows, std::size_t size,
                                    const char* aliases) {
  return {
      .name = name,
      .library = "hosts",
      .apply = kApplyTexture,
      .doc = doc,
      .params = rows,
      .params_size = size,
      .value = [](const Call&, void* result) { *static_cast<Rgba*>(result) = Rgba(0); },
      .fallback = {.is_fallback = true, .aliases = aliases},
  };
}

constexpr ShaderSpec kSubsurfaceHelpers[] = {
    {.name = "misss_skin_specular",
     .library = "hosts",
     .apply = kApplyScattering,
     .doc = "Fallback for the highlights and reflection of skin.",
     .params = kSkinSpecularRows,
     .params_size = sizeof(ScatterParams),
     .material = {.fill = skin_specular,
                  .max_lobes = [](const ShaderNode&) { return kSkinSpecularLobes; }},
     .fallback = {.is_fallback = true}},
    {.name = "misss_lambert_gamma",
     .library = "hosts",
     .apply = kApplyScattering,
     .doc = "Fallback for the illumination of light maps: a Lambert surface.",
     .params = kLambertGammaRows,
     .params_size = sizeof(LambertGamma),
     .material = {.fill = lambert_gamma, .max_lobes = [](const ShaderNode&) { return 1; }},
     .fallback = {.is_fallback = true}},
    {.name = "misss_call_shader",
     .library = "hosts",
     .apply = kApplyScattering,
     .doc = "Fallback for calls of a shader.",
     .params = kCallShaderRows,
     .params_size = sizeof(CallShader),
     .material = {.fill = called_shader,
                  .may_transmit = [](const ShaderNode& node) { return node.inputs_may_transmit(); },
                  .max_lobes = [](const ShaderNode&) { return 0; }},
     .fallback = {.is_fallback = true}},
    without_effect("misss_set_normal", "Change of the normal in light maps; no effect.",
                   kSetNormalRows, sizeof(SetNormal), "misss_set_normal_mod"),
    without_effect("misss_lightmap_write", "Writes light maps; no effect.", kLightmapRows,
                   sizeof(LightmapWrite), "misss_lightmap_phen misss_fast_lmap_maya"),
};

}  // namespace

std::span<const ShaderSpec> subsurface_helpers() { return kSubsurfaceHelpers; }

}  // namespace oriel
