// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "shaders/maya/host_rows.h"
#include "shaders/maya/maya_utility.h"

namespace oriel {
namespace {

struct Unary {
  Vec3 input;
};
struct Binary {
  int operation;
  Vec3 input1, input2;
};
constexpr int kMostTerms = 16;
struct Sum {
  int operation, count1, count2, count3;
  float input1D[kMostTerms];
  Vec3 input2D[kMostTerms], input3D[kMostTerms];
};
struct Sums {
  float output1D;
  Vec3 output2D, output3D;
};
struct Blend {
  float blender;
  Rgba color1, color2;
};
struct Range {
  Vec3 value, gamma, input, min, max, oldMin, oldMax;
};
struct Luminance {
  Rgba value;
};
struct Condition {
  float firstTerm, secondTerm;
  int operation;
  Rgba colorIfTrue, colorIfFalse;
};

constexpr auto kUnaryRows = about({{ORIEL_PARAM(Unary, input), .doc = "What is reversed."}});
constexpr auto kBinaryRows = about({
    {ORIEL_PARAM(Binary, operation), .fallback = {1}, .min = 0, .max = 3,
     .doc = "0 the first, 1 product, 2 quotient, 3 power."},
    {ORIEL_PARAM(Binary, input1), .doc = "First."},
    {ORIEL_PARAM(Binary, input2), .fallback = {1, 1, 1}, .doc = "Second."},
});
/// The rows of one term.
#define ORIEL_TERM(i)                                                                   \
  {.name = "input1D[" #i "]",                                                           \
   .type = ParamType::Scalar,                                                           \
   .element = ParamType::Scalar,                                                        \
   .offset = offsetof(Sum, input1D) + (i) * sizeof(float),                              \
   .doc = "A number."},                                                                 \
      {.name = "input2D[" #i "]",                                                       \
       .type = ParamType::Vector,                                                       \
       .element = ParamType::Vector,                                                    \
       .offset = offsetof(Sum, input2D) + (i) * sizeof(Vec3),                           \
       .doc = "A pair."},                                                               \
  {                                                                                     \
    .name = "input3D[" #i "]", .type = ParamType::Vector, .element = ParamType::Vector, \
    .offset = offsetof(Sum, input3D) + (i) * sizeof(Vec3), .doc = "A vector or colour." \
  }
constexpr auto kSumRows = about({
    {ORIEL_PARAM(Sum, operation), .fallback = {1}, .min = 0, .max = 3,
     .doc = "0 the first, 1 sum, 2 the first less the others, 3 mean."},
    {.name = "input1D[]",
     .type = ParamType::Integer,
     .element = ParamType::Integer,
     .offset = offsetof(Sum, count1),
     .doc = "How many numbers."},
    {.name = "input2D[]",
     .type = ParamType::Integer,
     .element = ParamType::Integer,
     .offset = offsetof(Sum, count2),
     .doc = "How many pairs."},
    {.name = "input3D[]",
     .type = ParamType::Integer,
     .element = ParamType::Integer,
     .offset = offsetof(Sum, count3),
     .doc = "How many vectors."},
    ORIEL_TERM(0),
    ORIEL_TERM(1),
    ORIEL_TERM(2),
    ORIEL_TERM(3),
    ORIEL_TERM(4),
    ORIEL_TERM(5),
    ORIEL_TERM(6),
    ORIEL_TERM(7),
    ORIEL_TERM(8),
    ORIEL_TERM(9),
    ORIEL_TERM(10),
    ORIEL_TERM(11),
    ORIEL_TERM(12),
    ORIEL_TERM(13),
    ORIEL_TERM(14),
    ORIEL_TERM(15),
});
#undef ORIEL_TERM
constexpr ParamSpec kSumResults[] = {
    // The result that is connected most often comes first.
    {ORIEL_PARAM(Sums, output3D), .doc = "Of the vectors."},
    {ORIEL_PARAM(Sums, output2D), .doc = "Of the pairs."},
    {ORIEL_PARAM(Sums, output1D), .doc = "Of the numbers."},
};
constexpr auto kBlendRows = about({
    {ORIEL_PARAM(Blend, blender), .fallback = {.5f}, .min = 0, .max = 1,
     .doc = "Share of the first."},
    {ORIEL_PARAM(Blend, color1), .fallback = {1, 0, 0}, .doc = "First."},
    {ORIEL_PARAM(Blend, color2), .fallback = {0, 0, 1}, .doc = "Second."},
});
constexpr auto kGammaRows = about({
    {ORIEL_PARAM(Range, value), .doc = "What is corrected."},
    {ORIEL_PARAM(Range, gamma), .fallback = {1, 1, 1}, .doc = "Value to the power of 1 / gamma."},
});
constexpr auto kClampRows = about({
    {ORIEL_PARAM(Range, input), .doc = "What is bounded."},
    {ORIEL_PARAM(Range, min), .doc = "Least."},
    {ORIEL_PARAM(Range, max), .doc = "Most."},
});
constexpr auto kRangeRows = about({
    {ORIEL_PARAM(Range, value), .doc = "What is mapped."},
    {ORIEL_PARAM(Range, min), .doc = "What oldMin becomes."},
    {ORIEL_PARAM(Range, max), .doc = "What oldMax becomes."},
    {ORIEL_PARAM(Range, oldMin), .doc = "Least."},
    {ORIEL_PARAM(Range, oldMax), .doc = "Most."},
});
constexpr auto kLuminanceRows = about({{ORIEL_PARAM(Luminance, value), .doc = "A colour."}});
constexpr auto kConditionRows = about({
    {ORIEL_PARAM(Condition, firstTerm), .doc = "Compared."},
    {ORIEL_PARAM(Condition, secondTerm), .doc = "With."},
    {ORIEL_PARAM(Condition, operation), .min = 0, .max = 5,
     .doc = "0 equal, 1 not, 2 greater, 3 or equal, 4 less, 5 or equal."},
    {ORIEL_PARAM(Condition, colorIfTrue), .doc = "If so."},
    {ORIEL_PARAM(Condition, colorIfFalse), .fallback = {1, 1, 1}, .doc = "If not."},
});

template <class F>
Vec3 by_component(F&& f) {
  return Vec3(f(0), f(1), f(2));
}

float finite(float x) { return std::isfinite(x) ? x : 0; }

Vec3 multiplied(const Binary& p) {
  return by_component([&](int i) {
    switch (p.operation) {
      case 1:
        return p.input1[i] * p.input2[i];
      case 2:
        return p.input2[i] != 0 ? p.input1[i] / p.input2[i] : 0.0f;
      case 3:
        return finite(math::pow(p.input1[i], p.input2[i]));
      default:
        return p.input1[i];
    }
  });
}

template <class T>
T summed(int operation, const T* terms, int count) {
  count = std::clamp(count, 0, kMostTerms);
  if (count == 0) return T(0);
  T sum = terms[0];
  for (int i = 1; i < count && operation != 0; ++i)
    sum = operation == 2 ? sum - terms[i] : sum + terms[i];
  return operation == 3 ? sum * (1 / static_cast<float>(count)) : sum;
}

Vec3 ranged(const Range& p) {
  return by_component([&](int i) {
    const float span = p.oldMax[i] - p.oldMin[i];
    const float t = span != 0 ? clamp01((p.value[i] - p.oldMin[i]) / span) : 0;
    return p.min[i] + (p.max[i] - p.min[i]) * t;
  });
}

bool holds(const Condition& p) {
  switch (p.operation) {
    case 1:
      return p.firstTerm != p.secondTerm;
    case 2:
      return p.firstTerm > p.secondTerm;
    case 3:
      return p.firstTerm >= p.secondTerm;
    case 4:
      return p.firstTerm < p.secondTerm;
    case 5:
      return p.firstTerm <= p.secondTerm;
    default:
      return p.firstTerm == p.secondTerm;
  }
}

constexpr ShaderSpec node(const char* name, const char* doc, std::span<const ParamSpec> rows,
                          std::size_t size, ParamType result, void (*value)(const Call&, void*)) {
  ShaderSpec spec = {.name = name,
                     .library = "hosts",
                     .apply = kApplyTexture,
                     .doc = doc,
                     .params = rows,
                     .params_size = size,
                     .result = result,
                     .value = value,
                     .fallback = {.is_fallback = true}};
  if (result == ParamType::Vector) spec.result_size = sizeof(Vec3);
  if (result == ParamType::Scalar) spec.result_size = sizeof(float);
  return spec;
}

template <class P, Vec3 (*kOf)(const P&)>
void vector_of(const Call& call, void* result) {
  *static_cast<Vec3*>(result) = kOf(call.as<P>());
}

Vec3 reversed(const Unary& p) { return Vec3(1) - p.input; }
Vec3 corrected(const Range& p) {
  return by_component([&](int i) {
    return p.gamma[i] > 0 ? math::pow(std::max(0.0f, p.value[i]), 1 / p.gamma[i]) : 0.0f;
  });
}
Vec3 bounded(const Range& p) {
  return by_component([&](int i) { return std::max(p.min[i], std::min(p.input[i], p.max[i])); });
}

constexpr ShaderSpec kSumming = [] {
  ShaderSpec spec = node("maya_plusminusavg", "Stand-in for the host's sums and means.", kSumRows,
                         sizeof(Sum), ParamType::Struct, [](const Call& call, void* result) {
                           const auto& p = call.as<Sum>();
                           *static_cast<Sums*>(result) = {summed(p.operation, p.input1D, p.count1),
                                                          summed(p.operation, p.input2D, p.count2),
                                                          summed(p.operation, p.input3D, p.count3)};
                         });
  spec.results = kSumResults;
  spec.result_size = sizeof(Sums);
  return spec;
}();

constexpr ShaderSpec kNodes[] = {
    node("maya_reverse", "Stand-in for the host's reverse.", kUnaryRows, sizeof(Unary),
         ParamType::Vector, vector_of<Unary, reversed>),
    node("maya_multdiv", "Stand-in for the host's products and quotients.", kBinaryRows,
         sizeof(Binary), ParamType::Vector, vector_of<Binary, multiplied>),
    kSumming,
    node("maya_blend", "Stand-in for the host's blend of colours.", kBlendRows, sizeof(Blend),
         ParamType::Color,
         [](const Call& call, void* result) {
           const auto& p = call.as<Blend>();
           const Rgb c = rgb(p.color1) * p.blender + rgb(p.color2) * (1 - p.blender);
           *static_cast<Rgba*>(result) = Rgba(c.x, c.y, c.z, 1);
         }),
    node("maya_gamma", "Stand-in for the host's gamma.", kGammaRows, sizeof(Range),
         ParamType::Vector, vector_of<Range, corrected>),
    node("maya_clamp", "Stand-in for the host's clamp.", kClampRows, sizeof(Range),
         ParamType::Vector, vector_of<Range, bounded>),
    node("maya_setrange", "Stand-in for the host's set range.", kRangeRows, sizeof(Range),
         ParamType::Vector, vector_of<Range, ranged>),
    node("maya_luminance", "Stand-in for the host's luminance.", kLuminanceRows, sizeof(Luminance),
         ParamType::Scalar,
         [](const Call& call, void* result) {
           *static_cast<float*>(result) = maya_luminance(rgb(call.as<Luminance>().value));
         }),
    node("maya_condition", "Stand-in for the host's condition.", kConditionRows, sizeof(Condition),
         ParamType::Color,
         [](const Call& call, void* result) {
           const auto& p = call.as<Condition>();
           *static_cast<Rgba*>(result) = holds(p) ? p.colorIfTrue : p.colorIfFalse;
         }),
};

}  // namespace

std::span<const ShaderSpec> maya_arithmetic() { return kNodes; }

}  // namespace oriel
