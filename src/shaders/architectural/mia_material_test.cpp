// SPDX-License-Identifier: Apache-2.0
// Energy distribution of the architectural material: weights, angle curves, lobes and their
// controls.
#include "shaders/architectural/mia_material.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <random>

#include "bsdf/gloss.h"
#include "runtime/closure.h"

namespace oriel {
namespace mia_material_test {

using P = MiaMaterialParams;

/// Default parameters.
P declared_defaults() {
  P p{};
  for (const ParamSpec& row : mia_material_rows()) {
    auto* target = reinterpret_cast<std::byte*>(&p) + row.offset;
    const float* v = row.fallback.data();
    const bool flag = v[0] != 0;
    const int count = static_cast<int>(v[0]);
    const Rgba color(v[0], v[1], v[2], 1);
    switch (row.type) {
      case ParamType::Boolean:
        std::memcpy(target, &flag, sizeof flag);
        break;
      case ParamType::Integer:
        std::memcpy(target, &count, sizeof count);
        break;
      case ParamType::Scalar:
        std::memcpy(target, v, sizeof *v);
        break;
      case ParamType::Color:
        std::memcpy(target, &color, sizeof color);
        break;
      default:
        break;
    }
  }
  return p;
}

P with_constant_curve(float reflectivity, float transparency) {
  P p = declared_defaults();
  p.reflectivity = reflectivity;
  p.transparency = transparency;
  p.brdf_0_degree_refl = p.brdf_90_degree_refl = 1;
  return p;
}

/// A point on the plane z = 0, seen from `wo`.
ShadingPoint seen_from(const Vec3& wo) {
  ShadingPoint point;
  point.ray_direction = -normalize(wo);
  return point;
}

Closure shade(const P& p, ShadingPoint point, const ShaderSpec& spec = kMiaMaterialX) {
  Closure closure;
  spec.material.fill(Call{&p, nullptr, point}, closure);
  return closure;
}

const Lobe* find(const Closure& closure, LobeKind kind) {
  for (int i = 0; i < closure.count; ++i)
    if (closure.lobes[i].kind == kind) return &closure.lobes[i];
  return nullptr;
}

void expect_rgb(const Rgb& actual, double r, double g, double b, double tolerance = 1e-6) {
  EXPECT_NEAR(actual.x, r, tolerance);
  EXPECT_NEAR(actual.y, g, tolerance);
  EXPECT_NEAR(actual.z, b, tolerance);
}

class RandomMaterial {
 public:
  explicit RandomMaterial(unsigned seed) : engine_(seed) {}
  float unit() { return distribution_(engine_); }
  bool coin() { return unit() < 0.5f; }
  Rgba color() { return Rgba(unit(), unit(), unit(), 1); }

  /// All parameters that affect weights, random within their range and often at its ends.
  P next() {
    P p = declared_defaults();
    p.diffuse_weight = end_or_inside();
    p.diffuse = color();
    p.diffuse_roughness = end_or_inside();
    p.reflectivity = end_or_inside();
    p.refl_color = color();
    p.refl_is_metal = coin();
    p.transparency = end_or_inside();
    p.refr_color = color();
    p.refr_ior = 0.2f + 3 * unit();
    p.refr_translucency = coin();
    p.refr_trans_color = color();
    p.refr_trans_weight = end_or_inside();
    p.brdf_fresnel = coin();
    p.brdf_0_degree_refl = end_or_inside();
    p.brdf_90_degree_refl = end_or_inside();
    p.brdf_curve = 0.1f + 9 * unit();
    p.thin_walled = coin();
    return p;
  }

 private:
  float end_or_inside() {
    const float u = unit();
    return u < 0.1f ? 0.0f : (u > 0.9f ? 1.0f : unit());
  }
  std::mt19937 engine_;
  std::uniform_real_distribution<float> distribution_{0, 1};
};

// acceptance: E2
TEST(MiaLevels, FollowTheManualsOrderExactly) {
  RandomMaterial random(11);
  for (int n = 0; n < 20000; ++n) {
    const P p = random.next();
    const float cos_view = random.unit();
    const MiaLevels levels = mia_levels(p, cos_view, random.coin());
    const double rho = levels.curve, t = p.refr_translucency ? p.refr_trans_weight : 0;
    for (int i = 0; i < 3; ++i) {
      const double diffuse = (&p.diffuse.r)[i];
      const double taken = double{p.reflectivity} * (&p.refl_color.r)[i] * rho, left = 1 - taken;
      const double through = left * p.transparency;
      ASSERT_NEAR(levels.reflection[i], taken * (p.refl_is_metal ? diffuse : 1), 1e-6);
      ASSERT_NEAR(levels.refraction[i], through * (1 - t) * (&p.refr_color.r)[i], 1e-6);
      ASSERT_NEAR(levels.translucency[i], through * t * (&p.refr_trans_color.r)[i], 1e-6);
      ASSERT_NEAR(levels.diffuse[i], left * (1 - p.transparency) * p.diffuse_weight * diffuse,
                  1e-6);
    }
  }
}

// acceptance: E2
TEST(MiaLevels, FullReflectivityLeavesNothingElse) {
  P p = with_constant_curve(1, 0.7f);
  p.refr_translucency = true;
  const MiaLevels levels = mia_levels(p, 0.6f, false);
  expect_rgb(levels.reflection, 1, 1, 1, 0);
  EXPECT_TRUE(is_black(levels.refraction));
  EXPECT_TRUE(is_black(levels.translucency));
  EXPECT_TRUE(is_black(levels.diffuse));
}

// acceptance: E2
TEST(MiaLevels, FullTransparencyLeavesNoDiffuse) {
  const MiaLevels levels = mia_levels(with_constant_curve(0, 1), 0.6f, false);
  EXPECT_TRUE(is_black(levels.diffuse));
  expect_rgb(levels.refraction, 1, 1, 1, 0);
}

// acceptance: E3
TEST(MiaLevels, WithoutConservationNothingIsReduced) {
  P p = with_constant_curve(0.9f, 0.8f);
  p.brdf_conserve_energy = false;
  p.diffuse = Rgba(0.9f, 1.5f, 0.2f, 1);
  p.diffuse_weight = 2;
  p.refl_color = Rgba(1, 0.5f, 2, 1);
  p.refr_color = Rgba(0.3f, 0.4f, 0.5f, 1);
  p.refr_translucency = true;
  p.refr_trans_weight = 0.25f;
  p.refr_trans_color = Rgba(1, 0.5f, 0, 1);
  const MiaLevels levels = mia_levels(p, 0.6f, false);
  expect_rgb(levels.reflection, 0.9, 0.45, 1.8);
  expect_rgb(levels.refraction, 0.8 * 0.75 * 0.3, 0.8 * 0.75 * 0.4, 0.8 * 0.75 * 0.5);
  expect_rgb(levels.translucency, 0.2, 0.1, 0);
  expect_rgb(levels.diffuse, 1.8, 3.0, 0.4);
}

// acceptance: E1
TEST(MiaLevels, SumToAtMostOneForAnyParameters) {
  RandomMaterial random(5);
  for (int n = 0; n < 50000; ++n) {
    P p = random.next();
    // Parameters beyond their range, for example from textures.
    if (n % 3 == 0) {
      p.diffuse *= 4;
      p.reflectivity *= 3;
      p.refl_color *= 2;
      p.brdf_90_degree_refl *= 5;
      p.transparency *= 2;
      p.refr_trans_weight = 3 * p.refr_trans_weight - 1;
      p.diffuse_weight = 4 * p.diffuse_weight - 1;
    }
    const MiaLevels l = mia_levels(p, random.unit(), random.coin());
    const Rgb sum = l.reflection + l.refraction + l.translucency + l.diffuse;
    ASSERT_LE(max_component(sum), 1 + 1e-6f) << n;
    for (const Rgb& c : {l.reflection, l.refraction, l.translucency, l.diffuse})
      ASSERT_TRUE(c.x >= 0 && c.y >= 0 && c.z >= 0) << n;
  }
}

struct AngleRow {
  double degrees, value;
};

float cos_deg(double degrees) {
  return static_cast<float>(std::cos(degrees * std::numbers::pi / 180));
}

// acceptance: E5
TEST(MiaLevels, FresnelModeReflectsByTheIndexAlone) {
  P p = declared_defaults();
  p.brdf_fresnel = true;
  p.refr_ior = 1.5f;
  p.reflectivity = 1;
  // Neither end of the custom curve nor its exponent has an effect.
  p.brdf_0_degree_refl = 0.9f;
  p.brdf_90_degree_refl = 0.3f;
  p.brdf_curve = 1;
  constexpr AngleRow kRows[] = {{0, .04},      {30, .041523}, {45, .050240},
                                {60, .089187}, {70, .171043}, {75, .253061},
                                {80, .387704}, {85, .612800}, {89, .904185}};
  for (const AngleRow& row : kRows)
    EXPECT_NEAR(mia_levels(p, cos_deg(row.degrees), false).curve, row.value, 2e-5) << row.degrees;
  p.refr_ior = 1.33f;
  EXPECT_NEAR(mia_levels(p, 1, false).curve, .020059, 1e-6);
  EXPECT_NEAR(mia_levels(p, cos_deg(60), false).curve, .059126, 1e-5);
}

// acceptance: E5
TEST(MiaLevels, CustomCurveFollowsItsTableForAnyIndex) {
  P p = declared_defaults();
  constexpr AngleRow kRows[] = {{0, .2}, {45, .201724}, {60, .225}, {75, .378942}, {85, .707076}};
  for (const float ior : {1.0f, 1.5f, 3.0f}) {
    p.refr_ior = ior;
    for (const AngleRow& row : kRows)
      EXPECT_NEAR(mia_levels(p, cos_deg(row.degrees), false).curve, row.value, 1e-5);
    EXPECT_FLOAT_EQ(mia_levels(p, 0, false).curve, 1);
  }
  p.brdf_curve = 1;
  EXPECT_NEAR(mia_levels(p, 0.25f, false).curve, 0.2 + 0.8 * 0.75, 1e-6);
}

// acceptance: T2
TEST(MiaLevels, ThinWallsReflectAsThePaneOfTwoFaces) {
  P p = declared_defaults();
  p.brdf_fresnel = p.thin_walled = true;
  p.refr_ior = 1.5f;
  p.reflectivity = p.transparency = 1;
  constexpr AngleRow kRows[] = {{0, .076923}, {60, .163768}, {75, .403908}};
  for (const AngleRow& row : kRows) {
    const MiaLevels levels = mia_levels(p, cos_deg(row.degrees), false);
    EXPECT_NEAR(levels.reflection.x, row.value, 2e-5);
    EXPECT_NEAR(levels.refraction.x, 1 - row.value, 2e-5);
  }
}

// acceptance: T1
TEST(MiaLevels, TotalReflectionInsideBeginsAtTheCriticalAngle) {
  P p = declared_defaults();
  p.refr_ior = 1.5f;
  p.transparency = 1;
  for (const bool fresnel : {true, false}) {
    p.brdf_fresnel = fresnel;
    EXPECT_FALSE(mia_levels(p, cos_deg(41.80), true).total_reflection);
    EXPECT_TRUE(mia_levels(p, cos_deg(41.82), true).total_reflection);
    EXPECT_FALSE(mia_levels(p, cos_deg(89), false).total_reflection);
  }
}

// acceptance: R4
TEST(MiaLevels, ReflectionColourTintsAndMetalsTakeTheDiffuseColour) {
  P p = with_constant_curve(0.6f, 0);
  p.diffuse = Rgba(0.9f, 0.6f, 0.2f, 1);
  p.refl_color = Rgba(0.5f, 1, 1, 1);
  expect_rgb(mia_levels(p, 1, false).reflection, 0.3, 0.6, 0.6);
  p.refl_color = Rgba(1, 1, 1, 1);
  p.refl_is_metal = true;
  const MiaLevels half = mia_levels(p, 1, false);
  expect_rgb(half.reflection, 0.6 * 0.9, 0.6 * 0.6, 0.6 * 0.2);
  // Reflectivity blends between reflection and diffuse, both in the diffuse colour.
  expect_rgb(half.diffuse, 0.4 * 0.9, 0.4 * 0.6, 0.4 * 0.2);
  expect_rgb(half.reflection + half.diffuse, 0.9, 0.6, 0.2);
}

TEST(MiaMaterial, DefaultsGiveADiffuseLobeAndAMirror) {
  const Closure c = shade(declared_defaults(), seen_from(Vec3(0, 0, 1)));
  ASSERT_EQ(c.count, 2);
  ASSERT_NE(find(c, LobeKind::Diffuse), nullptr);
  ASSERT_NE(find(c, LobeKind::Mirror), nullptr);
  // reflectivity .6 x curve .2 = .12 of the light; the rest times .5 is diffuse.
  expect_rgb(find(c, LobeKind::Mirror)->weight, .12, .12, .12);
  expect_rgb(find(c, LobeKind::Diffuse)->weight, .44, .44, .44);
  expect_rgb(c.albedo, .56, .56, .56);
  EXPECT_EQ(c.opacity, 1);
  EXPECT_EQ(c.light_mode, 4);
}

// acceptance: R1
TEST(MiaMaterial, FullGlossIsOneMirrorLobe) {
  P p = with_constant_curve(1, 0);
  const Closure c = shade(p, seen_from(Vec3(0, 0.5f, 1)));
  ASSERT_EQ(c.count, 1);
  EXPECT_EQ(c.lobes[0].kind, LobeKind::Mirror);
  EXPECT_FALSE(c.lobes[0].controls.highlights_only);
}

// acceptance: R2
TEST(MiaMaterial, NoSamplesIsAMirrorWhoseHighlightFollowsTheGloss) {
  P p = with_constant_curve(1, 0);
  p.refl_gloss = 0.5f;
  p.refl_gloss_samples = 0;
  const Closure c = shade(p, seen_from(Vec3(0, 0, 1)));
  ASSERT_EQ(c.count, 2);
  const Lobe* mirror = find(c, LobeKind::Mirror);
  const Lobe* highlight = find(c, LobeKind::GlossyReflection);
  ASSERT_TRUE(mirror && highlight);
  EXPECT_FALSE(mirror->controls.highlights_only);
  EXPECT_TRUE(highlight->controls.highlights_only);
  EXPECT_FLOAT_EQ(highlight->alpha_x, 0.03125f);
  EXPECT_EQ(highlight->weight, mirror->weight);
}

// acceptance: R5
TEST(MiaMaterial, HighlightsOnlySendsNoReflectionRays) {
  P p = with_constant_curve(0.5f, 0);
  p.refl_hl_only = true;
  for (const float gloss : {0.3f, 1.0f}) {
    for (const int samples : {0, 8}) {
      p.refl_gloss = gloss;
      p.refl_gloss_samples = samples;
      const Closure c = shade(p, seen_from(Vec3(0, 0, 1)));
      for (int i = 0; i < c.count; ++i)
        if (c.lobes[i].type == LobeType::Reflection) {
          EXPECT_TRUE(c.lobes[i].controls.highlights_only) << gloss << ' ' << samples;
        }
    }
  }
}

// acceptance: T1
TEST(MiaMaterial, SideOfTheSurfaceDecidesEnteringOrLeaving) {
  P p = with_constant_curve(0, 1);
  p.refr_ior = 1.5f;
  ShadingPoint point = seen_from(Vec3(0.2f, 0, 1));
  const Closure outside = shade(p, point);
  ASSERT_EQ(outside.count, 1);
  EXPECT_EQ(outside.lobes[0].kind, LobeKind::ClearRefraction);
  EXPECT_FLOAT_EQ(outside.lobes[0].eta, 1.5f);
  EXPECT_FALSE(outside.thin_walled);
  point.back_side = true;
  const Closure inside = shade(p, point);
  ASSERT_EQ(inside.count, 1);
  EXPECT_FLOAT_EQ(inside.lobes[0].eta, 1 / 1.5f);
}

// acceptance: T2
TEST(MiaMaterial, ThinWallsDoNotRefract) {
  P p = with_constant_curve(0, 1);
  p.thin_walled = true;
  for (const bool back : {false, true}) {
    ShadingPoint point = seen_from(Vec3(0.2f, 0, 1));
    point.back_side = back;
    EXPECT_NE(find(shade(p, point), LobeKind::ThinTransmission), nullptr);
    P blurred = p;
    blurred.refr_gloss = 0.5f;
    EXPECT_NE(find(shade(blurred, point), LobeKind::GlossyThin), nullptr);
    EXPECT_TRUE(shade(p, point).thin_walled);
  }
}

// acceptance: T3
TEST(MiaMaterial, RefractionGlossOfNoSamplesIsClear) {
  P p = with_constant_curve(0, 1);
  p.refr_gloss = 0.25f;
  const ShadingPoint point = seen_from(Vec3(0, 0, 1));
  const Closure rough = shade(p, point);
  ASSERT_NE(find(rough, LobeKind::GlossyRefraction), nullptr);
  EXPECT_NEAR(find(rough, LobeKind::GlossyRefraction)->alpha_x, .105112, 1e-6);
  p.refr_gloss_samples = 0;
  EXPECT_NE(find(shade(p, point), LobeKind::ClearRefraction), nullptr);
}

// acceptance: T7
TEST(MiaMaterial, WeakInnerReflectionsAreSkippedTotalOnesKept) {
  P p = declared_defaults();
  p.brdf_fresnel = true;
  p.refr_ior = 1.5f;
  p.reflectivity = p.transparency = 1;
  ShadingPoint inside = seen_from(Vec3(std::sin(0.5f), 0, std::cos(0.5f)));  // 28.6 degrees
  inside.back_side = true;
  EXPECT_EQ(find(shade(p, inside), LobeKind::Mirror), nullptr);
  ShadingPoint beyond = seen_from(Vec3(1, 0, 1));  // 45 degrees
  beyond.back_side = true;
  ASSERT_NE(find(shade(p, beyond), LobeKind::Mirror), nullptr);
  expect_rgb(find(shade(p, beyond), LobeKind::Mirror)->weight, 1, 1, 1);
  p.skip_inside_refl = false;
  EXPECT_NE(find(shade(p, inside), LobeKind::Mirror), nullptr);
  // A thin wall has no inside, an opaque solid no inner reflection to skip.
  p.skip_inside_refl = p.thin_walled = true;
  EXPECT_NE(find(shade(p, inside), LobeKind::Mirror), nullptr);
  p.thin_walled = false;
  p.transparency = 0;
  EXPECT_NE(find(shade(p, inside), LobeKind::Mirror), nullptr);
}

// acceptance: T4
TEST(MiaMaterial, AbsorptionReachesItsColourAtItsDistance) {
  P p = with_constant_curve(0, 1);
  p.refr_falloff_on = p.refr_falloff_color_on = true;
  p.refr_falloff_dist = 2.5f;
  p.refr_falloff_color = Rgba(0.8f, 0.5f, 0.1f, 1);
  const Medium medium = shade(p, seen_from(Vec3(0, 0, 1))).inside;
  for (int i = 0; i < 3; ++i) {
    const double c = (&p.refr_falloff_color.r)[i];
    EXPECT_NEAR(std::exp(-double{medium.absorption[i]} * 2.5), c, 1e-6);
    EXPECT_NEAR(std::exp(-double{medium.absorption[i]} * 5), c * c, 1e-6);
  }
  p.refr_falloff_color_on = false;
  EXPECT_EQ(shade(p, seen_from(Vec3(0, 0, 1))).inside.black_distance, 2.5f);
  p.refr_falloff_on = false;
  EXPECT_TRUE(shade(p, seen_from(Vec3(0, 0, 1))).inside.clear());
}

// acceptance: T10
TEST(MiaMaterial, TranslucencySplitsTheTransparencyByWeight) {
  P p = with_constant_curve(0, 0.8f);
  p.refr_translucency = true;
  p.refr_trans_weight = 0.25f;
  p.refr_trans_color = Rgba(1, 1, 1, 1);
  const Closure c = shade(p, seen_from(Vec3(0, 0, 1)));
  ASSERT_TRUE(find(c, LobeKind::Translucency) && find(c, LobeKind::ClearRefraction));
  expect_rgb(find(c, LobeKind::Translucency)->weight, .2, .2, .2);
  expect_rgb(find(c, LobeKind::ClearRefraction)->weight, .6, .6, .6);
}

// acceptance: B3
TEST(MiaMaterial, FullCutOutHasNeitherLobesNorEmission) {
  P p = declared_defaults();
  p.cutout_opacity = 0;
  p.additional_color = Rgba(1, 1, 1, 1);
  const Closure c = shade(p, seen_from(Vec3(0, 0, 1)));
  EXPECT_EQ(c.opacity, 0);
  EXPECT_EQ(c.count, 0);
  EXPECT_TRUE(is_black(c.emission));
}

// acceptance: B4
TEST(MiaMaterial, AdditionalColourIsAddedUnchanged) {
  P p = declared_defaults();
  p.additional_color = Rgba(3, 0.5f, 0, 0);
  expect_rgb(shade(p, seen_from(Vec3(0, 0, 1))).emission, 3, 0.5, 0);
}

// acceptance: B2
TEST(MiaMaterial, StandardBumpIsAddedAndMayExcludeDiffuse) {
  P p = with_constant_curve(0.5f, 0);
  p.bump_mode = 2;
  p.overall_bump = Vec3(0.3f, 0, 0);
  p.standard_bump = Vec3(0, 0.4f, 0);
  const ShadingPoint point = seen_from(Vec3(0, 0, 1));
  const Vec3 overall = normalize(Vec3(0.3f, 0, 1));
  const Vec3 both = normalize(overall + Vec3(0, 0.4f, 0));
  for (const bool spared : {false, true}) {
    p.no_diffuse_bump = spared;
    const Closure c = shade(p, point);
    ASSERT_TRUE(find(c, LobeKind::Mirror) && find(c, LobeKind::Diffuse));
    EXPECT_LT(length(find(c, LobeKind::Mirror)->frame.n - both), 1e-6f);
    EXPECT_LT(length(find(c, LobeKind::Diffuse)->frame.n - (spared ? overall : both)), 1e-6f);
  }
  // The old interface lacks them.
  const Closure old = shade(p, point, kMiaMaterial);
  EXPECT_EQ(find(old, LobeKind::Mirror)->frame.n, Vec3(0, 0, 1));
}

TEST(MiaMaterial, NamesOfAllThreeInterfacesShareOneTable) {
  EXPECT_EQ(kMiaMaterial.params.size(), kMiaMaterialRows);
  EXPECT_STREQ(kMiaMaterial.params.back().name, "lights");
  EXPECT_EQ(kMiaMaterialX.params.size(), mia_material_rows().size());
  EXPECT_EQ(kMiaMaterialXPasses.params.data(), kMiaMaterialX.params.data());
}

}  // namespace mia_material_test
}  // namespace oriel
