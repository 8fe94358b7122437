// SPDX-License-Identifier: Apache-2.0
#include "bsdf/ward_lobe.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "bsdf/highlights.h"
#include "sampling/warp.h"

namespace oriel::bsdf {
namespace {

/// Maximum mean slope, for shininess 0.
constexpr float kMaxWardSlope = 10;
/// Minimum slope; smaller highlights are below any pixel size.
constexpr float kMinWardSlope = 1e-4f;

}  // namespace

float ward_slope(float shininess) {
  return std::max(kMinWardSlope, 1 / std::max(shininess, 1 / kMaxWardSlope));
}

WardLobe::WardLobe(float shiny_u, float shiny_v)
    : ax_(ward_slope(shiny_u)), ay_(ward_slope(shiny_v)) {}

Vec3 WardLobe::sample(const Vec3& wo, const Vec2& u) const {
  const float r = std::sqrt(-math::log1p(-u.x));
  const sampling::SinCos turn = sampling::sincos_turns(u.y);
  const Vec3 h = normalize(Vec3(ax_ * r * turn.cos, ay_ * r * turn.sin, 1));
  Vec3 wi = h * (2 * dot(wo, h)) - wo;
  wi.z = std::max(std::abs(wi.z), 1e-7f);
  return normalize(wi);
}

float WardLobe::mirror_pdf(const Vec3& wo, const Vec3& wi) const {
  const Vec3 h = normalize(wo + wi);
  if (h.z == 0) return 0;
  const float slope2 = (sqr(h.x / ax_) + sqr(h.y / ay_)) / sqr(h.z);
  const float facets = math::exp(-slope2) / (kPi * ax_ * ay_ * std::abs(h.z) * sqr(h.z));
  return facets / (4 * std::abs(dot(wo, h)));
}

float WardLobe::pdf(const Vec3& wo, const Vec3& wi) const {
  if (wi.z <= 0) return 0;
  return mirror_pdf(wo, wi) + mirror_pdf(wo, Vec3(wi.x, wi.y, -wi.z));
}

float WardLobe::relative_to_lambert(const Vec3& wo, const Vec3& wi) const {
  const float value = WardHighlight{ax_, ay_}.eval(wo, wi);
  return value > 0 ? kPi * value / wi.z : 0;
}

}  // namespace oriel::bsdf
