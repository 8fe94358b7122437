// SPDX-License-Identifier: Apache-2.0
#include "transport/path/resolve_outputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace oriel {
namespace resolve_outputs_test {

/// The outputs of a pixel by name.
struct Resolved {
  MaterialOutputs all;
  Resolved(const AovValues& means, const Rgb& beauty) : all(resolve_outputs(means, beauty)) {}
  Rgb operator[](const std::string& name) const {
    const auto& names = kMaterialOutputNames;
    return all[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) -
                                        names.begin())];
  }
};

void expect_rgb(const Rgb& a, const Rgb& b, const std::string& what) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-6f * std::abs(b[k])) << what << ' ' << k;
}

TEST(ResolveOutputs, EachPartHasItsName) {
  AovValues o;
  float value = 1;
  for (Rgb& c : o.result) c = Rgb(value, value + .25f, value + .5f), value += 1;
  for (Rgb& c : o.level) c = Rgb(.5f, .25f, .125f);
  const Resolved r(o, Rgb(90));
  const std::pair<const char*, Aov> named[] = {{"diffuse_result", Aov::Diffuse},
                                               {"spec_result", Aov::Specular},
                                               {"refl_result", Aov::Reflection},
                                               {"refr_result", Aov::Refraction},
                                               {"tran_result", Aov::Translucency},
                                               {"indirect_result", Aov::Indirect},
                                               {"add_result", Aov::Added},
                                               {"opacity_result", Aov::Background},
                                               {"other", Aov::Other}};
  for (const auto& [name, component] : named) EXPECT_EQ(r[name], o[component]) << name;
  EXPECT_EQ(r["result"], Rgb(90));
  for (const std::string part : {"diffuse", "spec", "refl", "refr", "tran"}) {
    EXPECT_EQ(r[part + "_level"], Rgb(.5f, .25f, .125f)) << part;
    expect_rgb(r[part + "_raw"], r[part + "_result"] * Rgb(2, 4, 8), part);
  }
}

TEST(ResolveOutputs, IndirectLightIsDividedByColourThenByOcclusion) {
  AovValues o;
  o[Aov::Indirect] = Rgb(.3f, .2f, .1f);
  o.level_of(Aov::Diffuse) = Rgb(.5f, 1, .25f);
  o.occlusion = o.dimming = Rgb(.5f, .25f, .8f);
  const Resolved r(o, Rgb(0));
  expect_rgb(r["indirect_post_ao"], Rgb(.6f, .2f, .4f), "post");
  expect_rgb(r["indirect_raw"], Rgb(1.2f, .8f, .5f), "raw");
  EXPECT_EQ(r["ao_raw"], o.occlusion);
}

TEST(ResolveOutputs, OcclusionWithoutEffectIsStillOutput) {
  AovValues o;
  o[Aov::Indirect] = Rgb(.3f, .2f, .1f);
  o.level_of(Aov::Diffuse) = Rgb(.5f, 1, .25f);
  o.occlusion = Rgb(.5f, .25f, .8f);
  const Resolved r(o, Rgb(0));
  expect_rgb(r["indirect_raw"], Rgb(.6f, .2f, .4f), "raw");
  expect_rgb(r["indirect_post_ao"], Rgb(.6f, .2f, .4f), "post");
  EXPECT_EQ(r["ao_raw"], o.occlusion);
}

TEST(ResolveOutputs, RawLightOfNoLevelIsBlack) {
  AovValues o;
  o[Aov::Diffuse] = Rgb(0, .5f, 0);
  o.level_of(Aov::Diffuse) = Rgb(0, .5f, .5f);
  const Resolved r(o, Rgb(0));
  EXPECT_EQ(r["diffuse_raw"], Rgb(0, 1, 0));
  EXPECT_EQ(r["refl_raw"], Rgb(0));
  EXPECT_EQ(r["indirect_raw"], Rgb(0));
}

TEST(ResolveOutputs, FullOcclusionLeavesFiniteRawLight) {
  AovValues o;
  o.level_of(Aov::Diffuse) = Rgb(1);
  o.occlusion = o.dimming = Rgb(0);
  EXPECT_EQ(Resolved(o, Rgb(0))["ao_raw"], Rgb(0)) << "written as it is where nothing is lit";
  o[Aov::Indirect] = Rgb(.1f);
  const Resolved r(o, Rgb(0));
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isfinite(r["indirect_raw"][k]));
  expect_rgb(r["indirect_raw"] * r["ao_raw"], Rgb(.1f), "product");
}

TEST(ResolveOutputs, BackgroundIsNotScaledByMissingWeights) {
  AovValues o;
  o[Aov::Background] = Rgb(.3f, .6f, .9f);
  o.opacity = .25f;
  const Resolved r(o, Rgb(0));
  expect_rgb(r["opacity_raw"], Rgb(.4f, .8f, 1.2f), "raw");
  EXPECT_EQ(r["opacity"], Rgb(.25f));
  o.opacity = 1;
  o[Aov::Background] = Rgb(0);
  EXPECT_EQ(Resolved(o, Rgb(0))["opacity_raw"], Rgb(0));
}

// acceptance: U3
TEST(ResolveOutputs, BothFormsGiveTheSumOfTheResults) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> unit(0, 1);
  const auto color = [&] { return Rgb(unit(engine), unit(engine), unit(engine)); };
  for (int n = 0; n < 10000; ++n) {
    AovValues o;
    for (Rgb& c : o.level) c = color() + Rgb(1e-3f);
    for (Rgb& c : o.result) c = color() * 4.0f;
    o.occlusion = o.dimming = color();
    o.opacity = unit(engine) * .999f;
    Rgb beauty(0);
    for (const Rgb& c : o.result) beauty += c;
    const Resolved r(o, beauty);
    Rgb complex = r["diffuse_level"] * (r["diffuse_raw"] + r["indirect_raw"] * r["ao_raw"]) +
                  r["add_result"] + r["other"] + (Rgb(1) - r["opacity"]) * r["opacity_raw"];
    for (const std::string part : {"spec", "refl", "refr", "tran"})
      complex += r[part + "_level"] * r[part + "_raw"];
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(complex[k], beauty[k], 2e-6f * beauty[k]) << n;
  }
}

}  // namespace resolve_outputs_test
}  // namespace oriel
