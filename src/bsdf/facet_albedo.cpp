// SPDX-License-Identifier: Apache-2.0
#include "bsdf/facet_albedo.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/fraction.h"
#include "base/math.h"
#include "bsdf/facet_reflection.h"

namespace oriel::bsdf {
namespace {

constexpr int kFacetCosines = 16, kFacetAlphas = 12, kFacetEtas = 16;
constexpr float kLeastFacetCosine = 1e-3f, kMostEta = 10;
constexpr float kMostRoot = (kMostEta - 1) / (kMostEta + 1), kLeastUnit = 0.01f;

/// Mean weight of samples, which are placed by a lattice.
float sampled(float alpha, float eta, float cosine) {
  if (alpha <= 0) return fresnel_dielectric(cosine, eta);
  constexpr int kDirections = 128;
  constexpr float kGolden = 0.61803399f;
  const FacetReflection facets(alpha, alpha, eta);
  const Vec3 wo(std::sqrt(std::max(0.0f, 1 - cosine * cosine)), 0, cosine);
  float sum = 0;
  for (int i = 0; i < kDirections; ++i) {
    const float turn = static_cast<float>(i) * kGolden;
    const Vec2 u((static_cast<float>(i) + 0.5f) / kDirections, fraction(turn));
    if (const auto s = facets.sample(wo, u, 0.5f)) sum += s->weight;
  }
  return sum / kDirections;
}

/// The root of the reflectance at normal incidence where steps are equal in `unit`. Small ones are
/// close together, since even they reflect nearly all light at grazing angles.
float normal_root(float unit) { return kMostRoot * unit * unit * unit; }

/// Cosines vary fastest, then alphas.
const std::vector<float>& facet_table() {
  static const std::vector<float> table = [] {
    std::vector<float> values;
    const auto step = [](int i, int count) {
      return static_cast<float>(i) / static_cast<float>(count - 1);
    };
    for (int k = 0; k < kFacetEtas; ++k)
      for (int j = 0; j < kFacetAlphas; ++j)
        for (int i = 0; i < kFacetCosines; ++i) {
          const float root = normal_root(std::max(step(k, kFacetEtas), kLeastUnit));
          const float cosine = std::max(sqr(step(i, kFacetCosines)), kLeastFacetCosine);
          values.push_back(sampled(sqr(step(j, kFacetAlphas)), (1 + root) / (1 - root), cosine));
        }
    return values;
  }();
  return table;
}

/// A place between two of `count` nodes.
struct Between {
  int first;
  float share;

  Between(float unit, int count) {
    const float x = clamp01(unit) * static_cast<float>(count - 1);
    first = std::min(static_cast<int>(x), count - 2);
    share = x - static_cast<float>(first);
  }
};

}  // namespace

float facet_albedo(float alpha, float eta, float cosine) {
  const std::vector<float>& table = facet_table();
  const Between of_cosine(std::sqrt(clamp01(cosine)), kFacetCosines);
  const Between of_alpha(std::sqrt(clamp01(alpha)), kFacetAlphas);
  const float root = std::max((eta - 1) / (eta + 1), 0.0f);
  const Between of_eta(math::cbrt(root / kMostRoot), kFacetEtas);
  const auto row = [&](int k, int j) {
    const std::ptrdiff_t line =
        std::ptrdiff_t{of_eta.first + k} * kFacetAlphas + of_alpha.first + j;
    const float* value = table.data() + line * kFacetCosines + of_cosine.first;
    return lerp(value[0], value[1], of_cosine.share);
  };
  const auto plane = [&](int k) { return lerp(row(k, 0), row(k, 1), of_alpha.share); };
  return lerp(plane(0), plane(1), of_eta.share);
}

}  // namespace oriel::bsdf
