// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_plastic.h"

#include <algorithm>
#include <cmath>

#include "bsdf/burley_diffuse.h"
#include "bsdf/facet_albedo.h"
#include "bsdf/fresnel.h"
#include "bsdf/gloss.h"
#include "runtime/bump.h"
#include "runtime/shade_input.h"

namespace oriel {
namespace {

struct Plastic {
  ShaderRef base_material;
  Rgba diffuse;
  bool retro_reflective;
  Rgba reflection_color;
  float ior, roughness;
  bool conserve;
  float albedo_0, albedo_90, albedo_curve;
  Vec3 bump;
  int bump_mode;
};

constexpr ParamSpec kOrielPlasticRows[] = {
    {ORIEL_PARAM(Plastic, base_material), .doc = "Material that is added, e.g. one that emits.",
     .takes_material = true},
    {ORIEL_PARAM(Plastic, diffuse), .fallback = {.5f, .5f, .5f}, .doc = "Diffuse colour."},
    {ORIEL_PARAM(Plastic, retro_reflective),
     .doc =
         "Whether rough diffuse surfaces are brighter at grazing angles, and smooth ones darker."},
    {ORIEL_PARAM(Plastic, reflection_color), .fallback = {1, 1, 1},
     .doc = "Factor of the reflection."},
    {ORIEL_PARAM(Plastic, ior), .fallback = {1.5f}, .min = 1, .max = 10,
     .doc = "Index of refraction; 1 = no reflection."},
    {ORIEL_PARAM(Plastic, roughness), .fallback = {.5f}, .min = 0, .max = 1,
     .doc = "Roughness of both; its square is the roughness of the facets."},
    {ORIEL_PARAM(Plastic, conserve), .fallback = {1},
     .doc = "Whether reflected light is missing below the boundary."},
    {ORIEL_PARAM(Plastic, albedo_0), .fallback = {.04f}, .min = 0, .max = 1,
     .doc = "Reflected share of light at normal incidence, for conserve."},
    {ORIEL_PARAM(Plastic, albedo_90), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Reflected share of light at grazing incidence, for conserve."},
    {ORIEL_PARAM(Plastic, albedo_curve), .fallback = {5}, .min = 0,
     .doc = "Exponent of its curve between them."},
    {ORIEL_PARAM(Plastic, bump), .doc = "Bump vector."},
    {ORIEL_PARAM(Plastic, bump_mode), .fallback = {5}, .min = 1, .max = 8,
     .doc = "Use of the bump vector: 1 to 4 added to the normal, 5 to 8 in its place, in internal, "
            "world, object, camera space."},
};

/// The normal after the bump shader, which returns a vector or turns the normal itself.
Vec3 bumped(const Call& call, const Plastic& p) {
  ShadingPoint moved = call.point;
  Vec3 v = p.bump;
  if (call.node) call.node->ask(offsetof(Plastic, bump), moved, &v);
  const Vec3 normal =
      v == Vec3(0) ? moved.normal : bump_normal(call.point, call.point.normal, v, p.bump_mode);
  return facing_viewer(normal, call.point);
}

bsdf::Roughness facet_roughness(const Plastic& p) {
  return bsdf::anisotropic_roughness(sqr(clamp01(p.roughness)), 1);
}

void add_diffuse_part(const Plastic& p, const Vec3& normal, float cosine, float left,
                      Closure& closure) {
  Rgb color(std::max(p.diffuse.r, 0.0f), std::max(p.diffuse.g, 0.0f), std::max(p.diffuse.b, 0.0f));
  color *= left;
  const float roughness = clamp01(p.roughness);
  const float albedo = p.retro_reflective ? bsdf::BurleyDiffuse::albedo(roughness, cosine) : 1;
  const Rgb weight = color * albedo;
  if (is_black(weight)) return;
  Lobe& lobe = closure.add(LobeKind::Diffuse, LobeType::Diffuse, weight, Frame(normal));
  if (p.retro_reflective) {
    lobe.roughness = roughness;
    lobe.inverse_albedo = 1 / albedo;
  }
  closure.albedo += weight;
}

void add_facets(const Plastic& p, const Vec3& normal, float share, const ShadingPoint& point,
                Closure& closure) {
  const Rgb tint(clamp01(p.reflection_color.r), clamp01(p.reflection_color.g),
                 clamp01(p.reflection_color.b));
  if (p.ior <= 1 || is_black(tint)) return;
  const float cosine = clamp01(dot(normal, point.wo()));
  const bsdf::Roughness roughness = facet_roughness(p);
  const float smooth = bsdf::fresnel_dielectric(cosine, p.ior);
  const Rgb weight = tint * (roughness.is_mirror() ? smooth : share);
  Lobe& lobe = closure.add(roughness.is_mirror() ? LobeKind::Mirror : LobeKind::GlossyReflection,
                           LobeType::Reflection, weight, Frame(reflecting_outward(normal, point)));
  closure.albedo += weight;
  if (roughness.is_mirror()) return;
  lobe.alpha_x = roughness.ax;
  lobe.alpha_y = roughness.ay;
  lobe.eta = p.ior;
  lobe.inverse_albedo = 1 / share;
}

void shade_plastic(const Call& call, Closure& closure) {
  const auto& p = call.as<Plastic>();
  const Vec3 normal = bumped(call, p);
  const float cosine = clamp01(dot(normal, call.point.wo()));
  /// Smaller shares would hardly be sampled.
  constexpr float kMinShare = 0.01f;
  const float reflected = clamp01(
      bsdf::ReflectivityCurve{p.albedo_0, p.albedo_90, std::max(p.albedo_curve, 0.0f)}(cosine));
  const float facets = bsdf::facet_albedo(facet_roughness(p).ax, p.ior, cosine);
  const float left = p.conserve && p.ior > 1 ? 1 - std::max(reflected, facets) : 1;
  shade_input(call, offsetof(Plastic, base_material), p.base_material, Rgb(left), closure);
  add_diffuse_part(p, normal, cosine, left, closure);
  add_facets(p, normal, std::max(reflected, kMinShare), call.point, closure);
}

}  // namespace

const ShaderSpec kOrielPlastic = {
    .name = "oriel_plastic",
    .library = "oriel",
    .apply = kApplyMaterial | kApplyTexture,
    .doc =
        "Diffuse surface under a rough dielectric boundary, whose facets reflect by their own "
        "angles.",
    .params = kOrielPlasticRows,
    .params_size = sizeof(Plastic),
    .material = {.fill = shade_plastic,
                 .may_transmit = [](const ShaderNode& node) { return node.inputs_may_transmit(); },
                 .max_lobes = [](const ShaderNode&) { return 2; }},
};

}  // namespace oriel
