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
constexpr int kMaxTerms = 16;
struct Sum {
  int operation, count1, count2, count3;
  float input1D[kMaxTerms];
  Vec3 input2D[kMaxTerms], input3D[kMaxTerms];
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

constexpr auto kUnaryRows = about({{ORIEL_PARAM(Unary, input), .doc = "Value to invert."}});
constexpr auto kBinaryRows = about({
    {ORIEL_PARAM(Binary, operation), .fallback = {1}, .min = 0, .max = 3,
     .doc = "Operation: 0 first value, 1 multiply, 2 divide, 3 power."},
    {ORIEL_PARAM(Binary, input1), .doc = "First colour."},
    {ORIEL_PARAM(Binary, input2), .fallback = {1, 1, 1}, .doc = "Second colour."},
});
/// The rows of one term.
#define ORIEL_TERM(i)                                                                       \
  {.name = "input1D[" #i "]",                                                               \
   .type = ParamType::Scalar,                                                               \
   .element = ParamType::Scalar,                                                            \
   .offset = offsetof(Sum, input1D) + (i) * sizeof(float),                                  \
   .doc = "Scalar input."},                                                                 \
      {.name = "input2D[" #i "]",                                                           \
       .type = ParamType::Vector,                                                           \
       .element = ParamType::Vector,                                                        \
       .offset = offsetof(Sum, input2D) + (i) * sizeof(Vec3),                               \
       .doc = "Two-component input."},                                                      \
  {                                                                                         \
    .name = "input3D[" #i "]", .type = ParamType::Vector, .element = ParamType::Vector,     \
    .offset = offsetof(Sum, input3D) + (i) * sizeof(Vec3), .doc = "Vector or colour input." \
  }
constexpr auto kSumRows = about({
    {ORIEL_PARAM(Sum, operation), .fallback = {1}, .min = 0, .max = 3,
     .doc = "Operation: 0 first value, 1 sum, 2 first value minus the others, 3 mean."},
    {.name = "input1D[]",
     .type = ParamType::Integer,
     .element = ParamType::Integer,
     .offset = offsetof(Sum, count1),
     .doc = "Number of scalars in use."},
    {.name = "input2D[]",
     .type = ParamType::Integer,
     .element = ParamType::Integer,
     .offset = offsetof(Sum, count2),
     .doc = "Number of pairs in use."},
    {.name = "input3D[]",
     .type = ParamType::Integer,
     .element = ParamType::Integer,
     .offset = offsetof(Sum, count3),
     .doc = "Number of vectors in use."},
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
    // The one that is connected most comes first.
    {ORIEL_PARAM(Sums, output3D), .doc = "Result of the vectors."},
    {ORIEL_PARAM(Sums, output2D), .doc = "Result of the pairs."},
    {ORIEL_PARAM(Sums, output1D), .doc = "Result of the scalars."},
};
constexpr auto kBlendRows = about({
    {ORIEL_PARAM(Blend, blender), .fallback = {.5f}, .min = 0, .max = 1,
     .doc = "Weight of the first colour."},
    {ORIEL_PARAM(Blend, color1), .fallback = {1, 0, 0}, .doc = "First colour."},
    {ORIEL_PARAM(Blend, color2), .fallback = {0, 0, 1}, .doc = "Second colour."},
});
constexpr auto kGammaRows = about({
    {ORIEL_PARAM(Range, value), .doc = "Value to correct."},
    {ORIEL_PARAM(Range, gamma), .fallback = {1, 1, 1},
     .doc = "Gamma; the value is raised to 1 / gamma."},
});
constexpr auto kClampRows = about({
    {ORIEL_PARAM(Range, input), .doc = "Value to clamp."},
    {ORIEL_PARAM(Range, min), .doc = "Minimum."},
    {ORIEL_PARAM(Range, max), .doc = "Maximum."},
});
constexpr auto kRangeRows = about({
    {ORIEL_PARAM(Range, value), .doc = "Value to map."},
    {ORIEL_PARAM(Range, min), .doc = "Value that oldMin maps to."},
    {ORIEL_PARAM(Range, max), .doc = "Value that oldMax maps to."},
    {ORIEL_PARAM(Range, oldMin), .doc = "Minimum."},
    {ORIEL_PARAM(Range, oldMax), .doc = "Maximum."},
});
constexpr auto kLuminanceRows = about({{ORIEL_PARAM(Luminance, value), .doc = "Colour."}});
constexpr auto kConditionRows = about({
    {ORIEL_PARAM(Condition, firstTerm), .doc = "First compared value."},
    {ORIEL_PARAM(Condition, secondTerm), .doc = "Second compared value."},
    {ORIEL_PARAM(Condition, operation), .min = 0, .max = 5,
     .doc = "Comparison: 0 equal, 1 not equal, 2 greater, 3 greater or equal, 4 less, 5 "
            "less or equal."},
    {ORIEL_PARAM(Condition, colorIfTrue), .doc = "Result if true."},
    {ORIEL_PARAM(Condition, colorIfFalse), .fallback = {1, 1, 1}, .doc = "Result if false."},
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
  count = std::clamp(count, 0, kMaxTerms);
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
  ShaderSpec spec = node("maya_plusminusavg", "Fallback for Maya's plusMinusAverage.", kSumRows,
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
    node("maya_reverse", "Fallback for Maya's reverse.", kUnaryRows, sizeof(Unary),
         ParamType::Vector, vector_of<Unary, reversed>),
    node("maya_multdiv", "Fallback for Maya's multiplyDivide.", kBinaryRows, sizeof(Binary),
         ParamType::Vector, vector_of<Binary, multiplied>),
    kSumming,
    node("maya_blend", "Fallback for Maya's blendColors.", kBlendRows, sizeof(Blend),
         ParamType::Color,
         [](const Call& call, void* result) {
           const auto& p = call.as<Blend>();
           const Rgb c = rgb(p.color1) * p.blender + rgb(p.color2) * (1 - p.blender);
           *static_cast<Rgba*>(result) = Rgba(c.x, c.y, c.z, 1);
         }),
    node("maya_gamma", "Fallback for Maya's gammaCorrect.", kGammaRows, sizeof(Range),
         ParamType::Vector, vector_of<Range, corrected>),
    node("maya_clamp", "Fallback for Maya's clamp.", kClampRows, sizeof(Range), ParamType::Vector,
         vector_of<Range, bounded>),
    node("maya_setrange", "Fallback for Maya's setRange.", kRangeRows, sizeof(Range),
         ParamType::Vector, vector_of<Range, ranged>),
    node("maya_luminance", "Fallback for Maya's luminance.", kLuminanceRows, sizeof(Luminance),
         ParamType::Scalar,
         [](const Call& call, void* result) {
           *static_cast<float*>(result) = maya_luminance(rgb(call.as<Luminance>().value));
         }),
    node("maya_condition", "Fallback for Maya's condition.", kConditionRows, sizeof(Condition),
         ParamType::Color,
         [](const Call& call, void* result) {
           const auto& p = call.as<Condition>();
           *static_cast<Rgba*>(result) = holds(p) ? p.colorIfTrue : p.colorIfFalse;
         }),
};

}  // namespace

std::span<const ShaderSpec> maya_arithmetic() { return kNodes; }

}  // namespace oriel
