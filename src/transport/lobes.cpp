// SPDX-License-Identifier: Apache-2.0
#include "transport/lobes.h"

#include <algorithm>

#include "bsdf/glossy_reflection.h"
#include "bsdf/oren_nayar.h"
#include "bsdf/phong.h"
#include "bsdf/rough_refraction.h"
#include "bsdf/specular.h"
#include "bsdf/translucency.h"

namespace oriel {
namespace {

/// Calls f with the bsdf of a lobe that rays can follow.
template <class F>
auto with_bsdf(const Lobe& lobe, F&& f) {
  switch (lobe.kind) {
    case LobeKind::Mirror:
      return f(bsdf::Mirror{});
    case LobeKind::GlossyReflection:
      return f(bsdf::GlossyReflection(lobe.alpha_x, lobe.alpha_y, lobe.inverse_albedo));
    case LobeKind::ClearRefraction:
      return f(bsdf::ClearRefraction{lobe.eta});
    case LobeKind::GlossyRefraction:
      return f(bsdf::RoughRefraction(lobe.alpha_x, lobe.alpha_y, lobe.eta));
    case LobeKind::ThinTransmission:
      return f(bsdf::ClearThinTransmission{});
    case LobeKind::GlossyThin:
      return f(bsdf::RoughThinTransmission(lobe.alpha_x, lobe.alpha_y, lobe.inverse_albedo));
    case LobeKind::Translucency:
      return f(bsdf::Translucency{});
    default:
      return f(bsdf::OrenNayar(lobe.roughness));
  }
}

bool reflects(LobeKind kind) {
  return kind == LobeKind::GlossyReflection || kind == LobeKind::PhongHighlight ||
         kind == LobeKind::Mirror;
}

/// Whether the lobe may answer for a direction on that side of the geometric surface.
bool right_side(LobeKind kind, bool same_side) {
  switch (kind) {
    case LobeKind::Diffuse:
    case LobeKind::GlossyReflection:
    case LobeKind::PhongHighlight:
      return same_side;
    case LobeKind::GlossyThin:
    case LobeKind::Translucency:
      return !same_side;
    default:
      return true;  // rough refraction reflects totally as well
  }
}

}  // namespace

void make_ready(Closure& closure, const Vec3& wo) {
  for (int i = 0; i < closure.count; ++i) {
    Lobe& lobe = closure.lobes[i];
    if (lobe.kind != LobeKind::GlossyReflection && lobe.kind != LobeKind::GlossyThin) continue;
    const Vec3 o = lobe.frame.to_local(wo);
    lobe.inverse_albedo = o.z > 0 ? 1 / bsdf::ggx_albedo(lobe.alpha_x, lobe.alpha_y, o) : 1;
  }
}

Response evaluate_closure(const Closure& closure, const LobeChoice& choice,
                          const ShadingPoint& point, const Vec3& wo, const Vec3& wi,
                          bool seen_in_mirrors) {
  Response out;
  const bool same_side = dot(wi, point.geometric_normal) > 0;
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    if (is_delta(lobe.kind) || !right_side(lobe.kind, same_side)) continue;
    if (seen_in_mirrors && lobe.controls.mirrored) continue;
    Response::Part& part = is_diffuse(lobe.kind) ? out.diffuse : out.glossy;
    const Vec3 o = lobe.frame.to_local(wo), w = lobe.frame.to_local(wi);
    if (lobe.kind == LobeKind::PhongHighlight) {
      part.highlight += lobe.level * bsdf::PhongHighlight{lobe.roughness}.eval(o, w);
      continue;
    }
    float value = 0, pdf = 0;
    with_bsdf(lobe, [&](const auto& bsdf) {
      value = bsdf.eval(o, w);
      if (choice.probability[i] > 0) pdf = bsdf.pdf(o, w);
    });
    part.pdf += choice.probability[i] * pdf;
    if (!reflects(lobe.kind))
      part.plain += lobe.level * value;
    else if (lobe.controls.highlights_only)
      part.highlight += lobe.level * value;
    else
      part.reflective += lobe.level * value;
  }
  return out;
}

std::optional<ClosureSample> sample_closure(const Closure& closure, const LobeChoice& choice,
                                            const ShadingPoint& point, const Vec3& wo, float u_lobe,
                                            const Vec2& u) {
  int chosen = -1;
  for (int i = 0; i < closure.count; ++i) {
    if (choice.probability[i] <= 0) continue;
    chosen = i;
    if (u_lobe < choice.probability[i]) break;
    u_lobe -= choice.probability[i];
  }
  if (chosen < 0) return std::nullopt;
  const Lobe& lobe = closure.lobes[chosen];
  const float probability = choice.probability[chosen];
  const float u_rest = std::min(u_lobe / probability, 0x1.fffffep-1f);
  const auto sample_in = [&](const Frame& frame) {
    return with_bsdf(lobe,
                     [&](const auto& bsdf) { return bsdf.sample(frame.to_local(wo), u, u_rest); });
  };
  auto s = sample_in(lobe.frame);
  if (!s) return std::nullopt;

  ClosureSample out;
  out.wi = lobe.frame.to_world(s->wi);
  out.lobe = chosen;
  out.delta = s->delta;
  float side = dot(out.wi, point.geometric_normal);
  if (s->delta) {
    const auto on_its_side = [&] { return (s->wi.z > 0) == (side > 0); };
    if (!on_its_side()) {
      // Bent by an interpolated normal to the wrong side of the flat triangle: the triangle itself
      // reflects or refracts, or coarse meshes would have dark rims.
      const Frame flat(point.geometric_normal);
      s = sample_in(flat);
      if (!s) return std::nullopt;
      out.wi = flat.to_world(s->wi);
      side = dot(out.wi, point.geometric_normal);
      if (!on_its_side()) return std::nullopt;
    }
    const Rgb weight = lobe.level * (s->weight / probability);
    (reflects(lobe.kind) ? out.response.reflective : out.response.plain) = weight;
    return out;
  }
  if (!right_side(lobe.kind, side > 0)) return std::nullopt;
  const Response all = evaluate_closure(closure, choice, point, wo, out.wi);
  out.response = is_diffuse(lobe.kind) ? all.diffuse : all.glossy;
  out.pdf = out.response.pdf;
  if (!(out.pdf > 0)) return std::nullopt;
  const float inverse = 1 / out.pdf;
  out.response.plain *= inverse;
  out.response.reflective *= inverse;
  out.response.highlight *= inverse;
  return out;
}

}  // namespace oriel
