// SPDX-License-Identifier: Apache-2.0
#include "bsdf/highlights.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "bsdf/fresnel.h"

namespace oriel::bsdf {
namespace {

/// Minimum slope; smaller highlights are below any pixel size.
constexpr float kMinSlope = 1e-3f;

}  // namespace

float TorranceHighlight::eval(const Vec3& wo, const Vec3& wi) const {
  if (wo.z <= 0 || wi.z <= 0) return 0;
  const Vec3 h = normalize(wo + wi);
  const float m2 = sqr(std::max(slope, kMinSlope)), cos2 = h.z * h.z;
  const float facets = math::exp((cos2 - 1) / (cos2 * m2)) / (kPi * m2 * cos2 * cos2);
  const float oh = dot(wo, h);
  const float seen = std::min(1.0f, 2 * h.z * std::min(wo.z, wi.z) / oh);
  return fresnel_dielectric(oh, std::max(eta, 1.0f)) * facets * seen / (4 * wo.z);
}

float WardHighlight::eval(const Vec3& wo, const Vec3& wi) const {
  if (wo.z <= 0 || wi.z <= 0) return 0;
  const Vec3 h = normalize(wo + wi);
  const float ax = std::max(alpha_x, kMinSlope), ay = std::max(alpha_y, kMinSlope);
  const float slope2 = (sqr(h.x / ax) + sqr(h.y / ay)) / sqr(h.z);
  return math::exp(-slope2) * std::sqrt(wi.z / wo.z) / (4 * kPi * ax * ay);
}

float HairHighlight::eval(const Vec3& wo, const Vec3& wi) const {
  const auto sine = [](float c) { return std::sqrt(std::max(0.0f, 1 - c * c)); };
  const float c = sine(wo.x) * sine(wi.x) - wo.x * wi.x;
  return c > 0 ? math::pow(c, exponent) * kInvPi : 0;
}

}  // namespace oriel::bsdf
