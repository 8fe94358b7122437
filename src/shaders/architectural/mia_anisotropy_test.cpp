// SPDX-License-Identifier: Apache-2.0
// Direction of highlight stretching of the architectural material, measured from samples of its
// lobes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "bsdf/glossy_reflection.h"
#include "bsdf/rough_refraction.h"
#include "runtime/closure.h"
#include "sampling/sampler.h"
#include "shaders/architectural/mia_material.h"

namespace oriel {
namespace mia_anisotropy_test {

using P = MiaMaterialParams;

P brushed(float anisotropy, float rotation) {
  P p{};
  p.reflectivity = 0.5f;
  p.refl_color = p.refr_color = Rgba(1, 1, 1, 1);
  p.brdf_0_degree_refl = p.brdf_90_degree_refl = 1;
  p.brdf_curve = 5;
  p.brdf_conserve_energy = true;
  p.refl_gloss = p.refr_gloss = 0.5f;
  p.refl_gloss_samples = p.refr_gloss_samples = 8;
  p.transparency = 1;
  p.refr_ior = 1.5f;
  p.cutout_opacity = p.hl_vs_refl_balance = 1;
  p.anisotropy = anisotropy;
  p.anisotropy_rotation = rotation;
  p.anisotropy_channel = -1;
  return p;
}

/// View along the normal: slopes of half vectors are then those of the microfacets.
ShadingPoint from_above() {
  ShadingPoint point;
  point.ray_direction = Vec3(0, 0, -1);
  return point;
}

/// Ellipse fitted to directions around the normal: ratio of its axes, and angle of the longer axis
/// from world x in turns, 0...0.5.
struct Fit {
  float ratio = 0, turns = 0;
};

Fit fit(const std::vector<Vec2>& slopes) {
  // The mean of doubled angles is the axis for any tail of the distribution.
  double c = 0, s = 0;  // double: sums of 1e5 terms
  for (const Vec2& v : slopes) {
    const double angle = 2 * std::atan2(v.y, v.x);
    c += std::cos(angle);
    s += std::sin(angle);
  }
  const auto axis = static_cast<float>(std::atan2(s, c) / 2);
  const auto width = [&](float angle) {
    std::vector<float> along;
    for (const Vec2& v : slopes)
      along.push_back(std::abs(v.x * std::cos(angle) + v.y * std::sin(angle)));
    std::nth_element(along.begin(), along.begin() + static_cast<long>(along.size() / 2),
                     along.end());
    return along[along.size() / 2];
  };
  const float turns = axis / kTwoPi;
  return {width(axis) / width(axis + kPi / 2), turns < 0 ? turns + 0.5f : turns};
}

/// Slopes of `count` samples of the lobe of the material.
Fit fit_lobe(const P& p, LobeKind kind, ShadingPoint point = from_above()) {
  Closure closure;
  kMiaMaterialX.material.fill(Call{&p, nullptr, point}, closure);
  const Lobe* lobe = nullptr;
  for (int i = 0; i < closure.count; ++i)
    if (closure.lobes[i].kind == kind) lobe = &closure.lobes[i];
  if (!lobe) return {};
  std::vector<Vec2> slopes;
  const Vec3 wo = lobe->frame.to_local(point.wo());
  for (int n = 0; n < 60000; ++n) {
    sampling::Sampler sampler(n, 7, 0);
    const Vec2 u = sampler.next_2d();
    const auto s =
        kind == LobeKind::GlossyReflection
            ? bsdf::GlossyReflection(lobe->alpha_x, lobe->alpha_y).sample(wo, u, 0)
            : bsdf::RoughRefraction(lobe->alpha_x, lobe->alpha_y, lobe->eta).sample(wo, u, 0);
    if (!s) continue;
    const Vec3 w = lobe->frame.to_world(s->wi);
    if (kind == LobeKind::GlossyRefraction && s->wi.z >= 0) continue;
    // Small slopes: the deviation of a direction is proportional to the facet slope in both cases.
    const Vec3 h = kind == LobeKind::GlossyReflection ? normalize(point.wo() + w) : w;
    slopes.emplace_back(h.x / h.z, h.y / h.z);
  }
  return fit(slopes);
}

constexpr float kAngleTolerance = 0.005f;  // turns; 1.8 degrees

float turns_apart(float a, float b) {
  const float d = std::abs(a - b);
  return std::min(d, 0.5f - d);
}

// acceptance: A1
TEST(MiaAnisotropy, WidthsOfReflectionsHaveTheWrittenRatio) {
  for (const float a : {2.0f, 4.0f, 9.0f}) {
    const Fit wide = fit_lobe(brushed(a, 0), LobeKind::GlossyReflection);
    EXPECT_NEAR(wide.ratio / a, 1, 0.03) << a;
    EXPECT_LT(turns_apart(wide.turns, 0), kAngleTolerance) << a;
  }
}

// acceptance: A1
TEST(MiaAnisotropy, TheReciprocalIsTurnedByNinetyDegrees) {
  for (const float a : {2.0f, 5.0f}) {
    const Fit direct = fit_lobe(brushed(a, 0.07f), LobeKind::GlossyReflection);
    const Fit reciprocal = fit_lobe(brushed(1 / a, 0.07f), LobeKind::GlossyReflection);
    EXPECT_NEAR(reciprocal.ratio / direct.ratio, 1, 0.03);
    EXPECT_LT(turns_apart(reciprocal.turns, direct.turns + 0.25f), kAngleTolerance);
  }
}

// acceptance: A2
TEST(MiaAnisotropy, OneIsAFullTurnAndAQuarterIsNinetyDegrees) {
  for (const float rotation : {0.0f, 0.1f, 0.25f, 0.4f, 1.0f, 1.1f, -0.1f}) {
    const Fit f = fit_lobe(brushed(4, rotation), LobeKind::GlossyReflection);
    EXPECT_NEAR(f.ratio, 4, 0.12) << rotation;
    const float expected = rotation * 2 - std::floor(rotation * 2);  // an axis repeats twice a turn
    EXPECT_LT(turns_apart(f.turns, expected / 2), kAngleTolerance) << rotation;
  }
}

// acceptance: A4
TEST(MiaAnisotropy, RefractionsStretchAlongTheSameAxis) {
  const Fit f = fit_lobe(brushed(4, 0.15f), LobeKind::GlossyRefraction);
  EXPECT_NEAR(f.ratio, 4, 0.16);
  EXPECT_LT(turns_apart(f.turns, 0.15f), kAngleTolerance);
}

// acceptance: A3
TEST(MiaAnisotropy, TheChannelChoosesTheBaseDirection) {
  const auto unit = [](float turns) {
    return Vec3(std::cos(turns * kTwoPi), std::sin(turns * kTwoPi), 0);
  };
  ShadingPoint point = from_above();
  point.texture_spaces = 2;
  point.dpdu = unit(0.05f) * 3;
  point.bump_u[0] = unit(0.10f) * 0.5f;
  point.bump_u[1] = unit(0.15f);
  point.tex_vector = unit(0.20f);
  // The x axis of the object is 0.3 turns from world x.
  const float c = std::cos(0.3f * kTwoPi), s = std::sin(0.3f * kTwoPi);
  const Mat4 to_world(c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  point.to_world = &to_world;
  // Without a scene the only texture space is that of the derivatives; TextureDirection tests the
  // others.
  const std::pair<int, float> kCases[] = {{0, 0.05f},  {1, 0.3f},   {-1, 0.3f},
                                          {-2, 0.10f}, {-3, 0.05f}, {-4, 0.20f}};
  for (const auto& [channel, turns] : kCases) {
    P p = brushed(5, 0);
    p.anisotropy_channel = channel;
    const Fit f = fit_lobe(p, LobeKind::GlossyReflection, point);
    EXPECT_LT(turns_apart(f.turns, turns), kAngleTolerance) << channel;
  }
}

// acceptance: A3
TEST(MiaAnisotropy, ZeroActsAsTheMinimumRatio) {
  P p = brushed(0, 0.1f);
  const Fit f = fit_lobe(p, LobeKind::GlossyReflection),
            least = fit_lobe(brushed(.1f, .1f), LobeKind::GlossyReflection);
  EXPECT_LT(turns_apart(f.turns, least.turns), kAngleTolerance);
  EXPECT_LT(turns_apart(f.turns, 0.35f), kAngleTolerance);
}

TEST(MiaAnisotropy, FramesStayOrthonormalWhereTheBaseDirectionIsMissing) {
  for (int channel = -4; channel < 12; ++channel) {
    P p = brushed(3, 0.2f);
    p.anisotropy_channel = channel;
    Closure closure;
    ShadingPoint point = from_above();
    kMiaMaterialX.material.fill(Call{&p, nullptr, point}, closure);
    for (int i = 0; i < closure.count; ++i) {
      const Frame& f = closure.lobes[i].frame;
      EXPECT_NEAR(length(f.s), 1, 1e-5);
      EXPECT_NEAR(length(f.t), 1, 1e-5);
      EXPECT_NEAR(dot(f.s, f.t), 0, 1e-5);
      EXPECT_NEAR(dot(f.s, f.n), 0, 1e-5);
    }
  }
}

}  // namespace mia_anisotropy_test
}  // namespace oriel
