// SPDX-License-Identifier: Apache-2.0
#include "transport/lobes.h"

#include <algorithm>

#include "bsdf/burley_diffuse.h"
#include "bsdf/facet_reflection.h"
#include "bsdf/glossy_reflection.h"
#include "bsdf/highlights.h"
#include "bsdf/oren_nayar.h"
#include "bsdf/phong.h"
#include "bsdf/rough_refraction.h"
#include "bsdf/sheen.h"
#include "bsdf/specular.h"
#include "bsdf/terminator.h"
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
      if (lobe.eta != 1)
        return f(bsdf::FacetReflection(lobe.alpha_x, lobe.alpha_y, lobe.eta, lobe.inverse_albedo));
      return f(bsdf::GlossyReflection(lobe.alpha_x, lobe.alpha_y, lobe.inverse_albedo));
    case LobeKind::ClearRefraction:
      return f(bsdf::ClearRefraction{lobe.eta});
    case LobeKind::GlossyRefraction:
      return f(bsdf::RoughRefraction(lobe.alpha_x, lobe.alpha_y, lobe.eta, lobe.inverse_albedo));
    case LobeKind::ThinTransmission:
      return f(bsdf::ClearThinTransmission{});
    case LobeKind::GlossyThin:
      return f(bsdf::RoughThinTransmission(lobe.alpha_x, lobe.alpha_y, lobe.inverse_albedo));
    case LobeKind::Translucency:
      return f(bsdf::Translucency{});
    case LobeKind::Sheen:
      return f(bsdf::Sheen(lobe.roughness));
    default:
      if (lobe.inverse_albedo > 0)
        return f(bsdf::BurleyDiffuse(lobe.roughness, lobe.inverse_albedo));
      return f(bsdf::OrenNayar(lobe.roughness));
  }
}

/// Most surfaces have one lobe of this kind. Its value and density need no local frame.
bool is_lambert(const Lobe& lobe) {
  return lobe.kind == LobeKind::Diffuse && lobe.roughness == 0 && lobe.inverse_albedo == 0;
}

/// The value of a Lambert lobe, divided by its weight and by cos / pi.
float lambert_factor(const Lobe& lobe, const ShadingPoint& point, const Vec3& wi) {
  return bsdf::soft_terminator(point.geometric_normal, lobe.frame.n, wi);
}

/// Whether the lobe may answer for a direction on that side of the geometric surface.
bool right_side(LobeKind kind, bool same_side) {
  switch (kind) {
    case LobeKind::Diffuse:
    case LobeKind::GlossyReflection:
    case LobeKind::Sheen:
    case LobeKind::PhongHighlight:
    case LobeKind::TorranceHighlight:
    case LobeKind::WardHighlight:
      return same_side;
    case LobeKind::GlossyThin:
    case LobeKind::Translucency:
      return !same_side;
    default:
      return true;  // rough refraction reflects totally as well, hair is lit from all sides
  }
}

/// Whether the mirror that highlight `i` stands beside is one, and not a highlight itself: its own
/// depth or the material's switch may keep it from sending rays.
bool sends_rays(const Closure& closure, int i) {
  if (i == 0 || closure.lobes[i - 1].kind != LobeKind::Mirror) return true;
  return !closure.lobes[i - 1].controls.highlights_only;
}

/// Of lobes that show light sources alone.
float highlight(const Lobe& lobe, const Vec3& o, const Vec3& w) {
  switch (lobe.kind) {
    case LobeKind::TorranceHighlight:
      return bsdf::TorranceHighlight{lobe.roughness, lobe.eta}.eval(o, w);
    case LobeKind::WardHighlight:
      return bsdf::WardHighlight{lobe.alpha_x, lobe.alpha_y}.eval(o, w);
    case LobeKind::HairHighlight:
      return bsdf::HairHighlight{lobe.roughness}.eval(o, w);
    default:
      return bsdf::PhongHighlight{lobe.roughness}.eval(o, w);
  }
}

}  // namespace

void make_ready(Closure& closure, const Vec3& wo) {
  for (int i = 0; i < closure.count; ++i) {
    Lobe& lobe = closure.lobes[i];
    const bool refracts = lobe.kind == LobeKind::GlossyRefraction;
    if (lobe.kind != LobeKind::GlossyReflection && lobe.kind != LobeKind::GlossyThin && !refracts)
      continue;
    if (lobe.kind == LobeKind::GlossyReflection && lobe.eta != 1) continue;  // set by the shader
    Vec3 o = lobe.frame.to_local(wo);
    if (refracts && o.z > 0) o = bsdf::RoughRefraction::lobe_view(o, lobe.eta);
    lobe.inverse_albedo = o.z > 0 ? 1 / bsdf::ggx_albedo(lobe.alpha_x, lobe.alpha_y, o) : 1;
  }
}

LobeGroup group_of(LobeKind kind) {
  switch (kind) {
    case LobeKind::Diffuse:
    case LobeKind::Translucency:
      return LobeGroup::Diffuse;
    case LobeKind::Mirror:
    case LobeKind::GlossyReflection:
    case LobeKind::Sheen:
    case LobeKind::PhongHighlight:
    case LobeKind::TorranceHighlight:
    case LobeKind::WardHighlight:
    case LobeKind::HairHighlight:
      return LobeGroup::Reflection;
    default:
      return LobeGroup::Refraction;
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
    if (seen_in_mirrors && lobe.controls.mirrored && sends_rays(closure, i)) continue;
    if (is_lambert(lobe) && !lobe.controls.highlights_only) {
      const float cosine = dot(lobe.frame.n, wi);
      if (!(cosine > 0) || !(dot(lobe.frame.n, wo) > 0)) continue;
      const float density = cosine * kInvPi;
      out.diffuse.value += lobe.weight * (density * lambert_factor(lobe, point, wi));
      float pdf = choice.rays[i] * density;
      if (choice.guide && pdf > 0) pdf *= choice.guide.density(wi);
      out.diffuse.pdf += pdf;
      continue;
    }
    const Vec3 o = lobe.frame.to_local(wo), w = lobe.frame.to_local(wi);
    if (is_highlight(lobe.kind)) {
      out.highlight += lobe.weight * highlight(lobe, o, w);
      continue;
    }
    float value = 0, pdf = 0;
    with_bsdf(lobe, [&](const auto& bsdf) {
      value = bsdf.eval(o, w);
      if (choice.rays[i] > 0) pdf = choice.rays[i] * bsdf.pdf(o, w);
    });
    if (lobe.kind == LobeKind::Diffuse) {
      value *= bsdf::soft_terminator(point.geometric_normal, lobe.frame.n, wi);
      if (choice.guide && pdf > 0) pdf *= choice.guide.density(wi);
    }
    if (lobe.controls.highlights_only) {
      out.highlight += lobe.weight * value;
      continue;
    }
    Response::Part& part = out.of(lobe.kind);
    part.value += lobe.weight * value;
    part.pdf += pdf;
  }
  return out;
}

int choose_lobe(const Closure& closure, const LobeChoice& choice, float& u) {
  int chosen = -1;
  for (int i = 0; i < closure.count; ++i) {
    if (choice.rays[i] <= 0) continue;
    chosen = i;
    if (u < choice.rays[i]) break;
    u -= choice.rays[i];
  }
  if (chosen >= 0) u = std::min(u / choice.rays[chosen], 0x1.fffffep-1f);
  return chosen;
}

namespace {

/// As sample_lobe(), of the only lobe.
std::optional<ClosureSample> sample_lambert(const Lobe& lobe, const LobeChoice& choice,
                                            const ShadingPoint& point, const Vec3& wo,
                                            const Vec2& u) {
  if (!(dot(lobe.frame.n, wo) > 0)) return std::nullopt;
  ClosureSample out;
  float cosine = 0, rays = choice.rays[0];
  if (choice.guide) {
    const LocalGuide::Sample s = choice.guide.sample(u);
    out.wi = s.wi;
    cosine = s.cosine;
    rays *= s.density;
  } else {
    const Vec3 local = sampling::sample_cosine_hemisphere(u);
    out.wi = lobe.frame.to_world(local);
    cosine = local.z;
  }
  out.pdf = rays * sampling::cosine_hemisphere_pdf(cosine);
  if (!(dot(out.wi, point.geometric_normal) > 0) || !(out.pdf > 0)) return std::nullopt;
  out.weight = lobe.weight * (lambert_factor(lobe, point, out.wi) / rays);
  return out;
}

/// A direction of a lobe without delta, with its weight; empty if it is on the wrong side.
std::optional<ClosureSample> finish(const Closure& closure, const LobeChoice& choice, int index,
                                    const ShadingPoint& point, const Vec3& wo, ClosureSample out) {
  const LobeKind kind = closure.lobes[index].kind;
  if (!right_side(kind, dot(out.wi, point.geometric_normal) > 0)) return std::nullopt;
  const Response all = evaluate_closure(closure, choice, point, wo, out.wi);
  const Response::Part& part = all.of(kind);
  out.pdf = part.pdf;
  if (!(out.pdf > 0)) return std::nullopt;
  out.weight = part.value / out.pdf;
  return out;
}

}  // namespace

std::optional<ClosureSample> sample_lobe(const Closure& closure, const LobeChoice& choice,
                                         int index, const ShadingPoint& point, const Vec3& wo,
                                         float u_rest, const Vec2& u) {
  const Lobe& lobe = closure.lobes[index];
  const float rays = choice.rays[index];
  if (closure.count == 1 && is_lambert(lobe)) return sample_lambert(lobe, choice, point, wo, u);
  const auto sample_in = [&](const Frame& frame) {
    return with_bsdf(lobe,
                     [&](const auto& bsdf) { return bsdf.sample(frame.to_local(wo), u, u_rest); });
  };
  ClosureSample out;
  out.lobe = index;
  if (lobe.kind == LobeKind::Diffuse && choice.guide) {
    if (!(dot(lobe.frame.n, wo) > 0)) return std::nullopt;
    out.wi = choice.guide.sample(u).wi;
    return finish(closure, choice, index, point, wo, out);
  }
  auto s = sample_in(lobe.frame);
  if (!s) return std::nullopt;

  out.wi = lobe.frame.to_world(s->wi);
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
    out.weight = lobe.weight * (s->weight / rays);
    return out;
  }
  return finish(closure, choice, index, point, wo, out);
}

}  // namespace oriel
