// SPDX-License-Identifier: Apache-2.0
// Test shaders that show bound values: one parameter of each type, results of each type.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "prepare/testing/prepared_scene.h"

namespace oriel {

struct ProbeParams {
  bool flag;
  int count;
  float amount;
  Rgba tint;
  Vec3 place;
  Mat4 matrix;
  std::string_view text;
  ShaderRef other;
  LightRef lamp;
  ColorTextureRef picture;
  ScalarTextureRef mask;
  ArrayView<LightRef> lights;
  ArrayView<float> weights;
  ArrayView<Rgba> tints;
  bool flag_on;
  int count_seven;
  float amount_half;
  Rgba tint_warm;
};

inline constexpr ParamSpec kProbeRows[] = {
    {ORIEL_PARAM(ProbeParams, flag)},
    {ORIEL_PARAM(ProbeParams, count)},
    {ORIEL_PARAM(ProbeParams, amount), .alias = "quantity"},
    {ORIEL_PARAM(ProbeParams, tint)},
    {ORIEL_PARAM(ProbeParams, place)},
    {ORIEL_PARAM(ProbeParams, matrix)},
    {ORIEL_PARAM(ProbeParams, text)},
    {ORIEL_PARAM(ProbeParams, other)},
    {ORIEL_PARAM(ProbeParams, lamp)},
    {ORIEL_PARAM(ProbeParams, picture)},
    {ORIEL_PARAM(ProbeParams, mask)},
    {ORIEL_PARAM(ProbeParams, lights)},
    {ORIEL_PARAM(ProbeParams, weights)},
    {ORIEL_PARAM(ProbeParams, tints)},
    {ORIEL_PARAM(ProbeParams, flag_on), .fallback = {1}},
    {ORIEL_PARAM(ProbeParams, count_seven), .fallback = {7}},
    {ORIEL_PARAM(ProbeParams, amount_half), .fallback = {.5f}},
    {ORIEL_PARAM(ProbeParams, tint_warm), .fallback = {.9f, .6f, .3f}},
};

/// Its value is `tint`, so that probes can be chained.
inline constexpr ShaderSpec kProbe = {
    .name = "probe",
    .library = "test",
    .apply = kApplyTexture | kApplyMaterial,
    .doc = "One parameter of each type.",
    .params = kProbeRows,
    .params_size = sizeof(ProbeParams),
    .value = [](const Call& call,
                void* result) { *static_cast<Rgba*>(result) = call.as<ProbeParams>().tint; },
};

struct ProbeResults {
  Rgba out_color;
  float out_alpha;
  Vec3 out_normal;
};
inline constexpr ParamSpec kManyResults[] = {
    {ORIEL_PARAM(ProbeResults, out_color)},
    {ORIEL_PARAM(ProbeResults, out_alpha)},
    {ORIEL_PARAM(ProbeResults, out_normal)},
};
/// A struct of results: (.1 .2 .3 .4), .75, (1 2 3).
inline constexpr ShaderSpec kProbeMany = {
    .name = "probe_many",
    .library = "test",
    .apply = kApplyTexture,
    .doc = "Several results.",
    .result = ParamType::Struct,
    .results = kManyResults,
    .result_size = sizeof(ProbeResults),
    .value =
        [](const Call&, void* result) {
          *static_cast<ProbeResults*>(result) = {Rgba(.1f, .2f, .3f, .4f), .75f, Vec3(1, 2, 3)};
        },
};

struct ProbeScalar {
  float amount;
};
inline constexpr ParamSpec kScalarRows[] = {{ORIEL_PARAM(ProbeScalar, amount)}};
inline constexpr ShaderSpec kProbeScalar = {
    .name = "probe_scalar",
    .library = "test",
    .apply = kApplyTexture,
    .doc = "A scalar.",
    .params = kScalarRows,
    .params_size = sizeof(ProbeScalar),
    .result = ParamType::Scalar,
    .result_size = sizeof(float),
    .value = [](const Call& call,
                void* result) { *static_cast<float*>(result) = call.as<ProbeScalar>().amount; },
};

struct ProbeVector {
  Vec3 place;
};
inline constexpr ParamSpec kVectorRows[] = {{ORIEL_PARAM(ProbeVector, place)}};
inline constexpr ShaderSpec kProbeVector = {
    .name = "probe_vector",
    .library = "test",
    .apply = kApplyTexture,
    .doc = "A vector.",
    .params = kVectorRows,
    .params_size = sizeof(ProbeVector),
    .result = ParamType::Vector,
    .result_size = sizeof(Vec3),
    .value = [](const Call& call,
                void* result) { *static_cast<Vec3*>(result) = call.as<ProbeVector>().place; },
};

/// The built-in shaders and the probes.
inline const Registry& probe_registry() {
  static const Registry registry([] {
    std::vector<const ShaderSpec*> all = builtin_shaders().all();
    for (const ShaderSpec* probe : {&kProbe, &kProbeMany, &kProbeScalar, &kProbeVector})
      all.push_back(probe);
    return all;
  }());
  return registry;
}

/// A scene that shows the result of material "m".
struct ProbeScene : testing::PreparedScene {
  explicit ProbeScene(std::string_view elements, std::string_view members = {})
      : PreparedScene(testing::scene_text(elements, members), probe_registry()) {}

  /// The last shader of the material's surface list.
  const ShaderNode* node(std::string_view name = "m") const {
    const Material* m = material(name);
    return m && !m->surface.empty() ? m->surface.back() : nullptr;
  }
  /// Its parameters with connections evaluated. Fails the test when there is no probe.
  ProbeParams params(std::string_view name = "m") const {
    ProbeParams out{};
    const ShaderNode* n = node(name);
    if (!n || &n->spec() != &kProbe) {
      ADD_FAILURE() << "no probe \"" << name << "\"\n" << messages();
      return out;
    }
    ShadingPoint point;
    point.world = world.get();
    n->with_params(point, [&](const Call& call) { out = call.as<ProbeParams>(); });
    return out;
  }
};

/// A scene with material "m" = probe ( arguments ), after `before`.
inline std::string probe_call(std::string_view arguments, std::string_view before = {}) {
  return std::string(before) + "\nmaterial \"m\" \"probe\" (" + std::string(arguments) +
         ") end material\n";
}

inline void expect_color(const Rgba& c, float r, float g, float b, float a) {
  EXPECT_FLOAT_EQ(c.r, r);
  EXPECT_FLOAT_EQ(c.g, g);
  EXPECT_FLOAT_EQ(c.b, b);
  EXPECT_FLOAT_EQ(c.a, a);
}

}  // namespace oriel
