// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_arithmetic.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/fraction.h"
#include "base/math.h"
#include "color/srgb.h"

namespace oriel {
namespace {

struct MathNode {
  int operation;
  Rgba input1, input2, input3;
  bool clamp;
};
struct BlendNode {
  int mode;
  float factor;
  Rgba below, above;
  bool clamp;
};
struct HueSaturation {
  Rgba input;
  float hue, saturation, value, factor;
};

using Operation = float (*)(float a, float b, float c);

float quotient(float a, float b) { return b != 0 ? a / b : 0; }

float power(float a, float b) { return a < 0 && b != std::floor(b) ? 0 : math::pow(a, b); }

float logarithm(float a, float b) {
  return a > 0 && b > 0 ? quotient(math::log(a), math::log(b)) : 0;
}

float smooth_minimum(float a, float b, float c) {
  if (c == 0) return std::min(a, b);
  const float h = std::max(c - std::abs(a - b), 0.0f) / c;
  return std::min(a, b) - h * h * h * c / 6;
}

/// a wrapped to the interval from c to b.
float wrapped(float a, float b, float c) {
  const float range = b - c;
  return range != 0 ? a - range * std::floor((a - c) / range) : c;
}

float ping_pong(float a, float b) {
  return b != 0 ? std::abs(fraction((a - b) / (2 * b)) * 2 * b - b) : 0;
}

constexpr Operation kOperations[] = {
    [](float a, float b, float) { return a + b; },
    [](float a, float b, float) { return a - b; },
    [](float a, float b, float) { return a * b; },
    [](float a, float b, float) { return quotient(a, b); },
    [](float a, float b, float c) { return a * b + c; },
    [](float a, float b, float) { return power(a, b); },
    [](float a, float b, float) { return logarithm(a, b); },
    [](float a, float, float) { return std::sqrt(std::max(a, 0.0f)); },
    [](float a, float, float) { return a > 0 ? 1 / std::sqrt(a) : 0; },
    [](float a, float, float) { return std::abs(a); },
    [](float a, float, float) { return math::exp(a); },
    [](float a, float b, float) { return std::min(a, b); },
    [](float a, float b, float) { return std::max(a, b); },
    [](float a, float b, float) { return a < b ? 1.0f : 0.0f; },
    [](float a, float b, float) { return a > b ? 1.0f : 0.0f; },
    [](float a, float, float) { return a > 0   ? 1.0f
                                       : a < 0 ? -1.0f
                                               : 0.0f; },
    [](float a, float b, float c) { return std::abs(a - b) <= std::max(c, 1e-5f) ? 1.0f : 0.0f; },
    smooth_minimum,
    [](float a, float b, float c) { return -smooth_minimum(-a, -b, c); },
    [](float a, float, float) { return std::floor(a + 0.5f); },
    [](float a, float, float) { return std::floor(a); },
    [](float a, float, float) { return std::ceil(a); },
    [](float a, float, float) { return std::trunc(a); },
    [](float a, float, float) { return fraction(a); },
    [](float a, float b, float) { return b != 0 ? std::fmod(a, b) : 0; },
    [](float a, float b, float) { return b != 0 ? a - b * std::floor(a / b) : 0; },
    wrapped,
    [](float a, float b, float) { return std::floor(quotient(a, b)) * b; },
    [](float a, float b, float) { return ping_pong(a, b); },
    [](float a, float, float) { return math::sin(a); },
    [](float a, float, float) { return math::cos(a); },
    [](float a, float, float) { return math::tan(a); },
    [](float a, float, float) { return std::abs(a) <= 1 ? math::asin(a) : 0; },
    [](float a, float, float) { return std::abs(a) <= 1 ? math::acos(a) : 0; },
    [](float a, float, float) { return math::atan(a); },
    [](float a, float b, float) { return a == 0 && b == 0 ? 0 : math::atan2(a, b); },
    [](float a, float, float) { return a * kPi / 180; },
    [](float a, float, float) { return a * 180 / kPi; },
    [](float a, float, float) { return a > 0 ? srgb_decode(math::pow(a, 1 / 2.2f)) : 0; },
};
constexpr int kLastOperation = static_cast<int>(std::size(kOperations)) - 1;

/// Result of a channel, not mixed with that below.
using ChannelBlend = float (*)(float below, float above);

float overlay(float a, float b) { return a < 0.5f ? 2 * a * b : 1 - 2 * (1 - a) * (1 - b); }

float soft_light(float a, float b) { return (1 - a) * a * b + a * (1 - (1 - a) * (1 - b)); }

/// The modes that mix their result with the colour below by the factor.
constexpr ChannelBlend kBlends[] = {
    [](float, float b) { return b; },
    [](float a, float b) { return a + b; },
    [](float a, float b) { return a * b; },
    [](float a, float b) { return a - b; },
    [](float a, float b) { return 1 - (1 - a) * (1 - b); },
    [](float a, float b) { return b != 0 ? a / b : a; },
    [](float a, float b) { return std::abs(a - b); },
    [](float a, float b) { return a + b - 2 * a * b; },
    [](float a, float b) { return std::min(a, b); },
    [](float a, float b) { return std::max(a, b); },
    overlay,
    soft_light,
    [](float a, float b) { return a + 2 * b - 1; },
};
constexpr int kDodge = static_cast<int>(std::size(kBlends)), kBurn = kDodge + 1, kHue = kDodge + 2,
              kSaturation = kDodge + 3, kColor = kDodge + 4, kValue = kDodge + 5;

float dodge(float a, float b, float factor) {
  const float left = 1 - factor * b;
  if (a == 0) return a;
  return left <= 0 ? 1 : std::min(a / left, 1.0f);
}

float burn(float a, float b, float factor) {
  const float part = 1 - factor + factor * b;
  return part <= 0 ? 0 : clamp01(1 - (1 - a) / part);
}

/// Hue in 0..1, saturation and value.
Vec3 hsv_of(const Rgb& c) {
  const float high = max_component(c), low = std::min({c.x, c.y, c.z}), range = high - low;
  if (!(range > 0) || high == 0) return Vec3(0, 0, high);
  const float turn = c.x == high   ? (c.y - c.z) / range
                     : c.y == high ? 2 + (c.z - c.x) / range
                                   : 4 + (c.x - c.y) / range;
  return Vec3(fraction(turn / 6), range / high, high);
}

Rgb rgb_of(const Vec3& hsv) {
  const auto channel = [&](float offset) {
    const float k = 6 * fraction((offset + 6 * hsv.x) / 6);
    return hsv.z * (1 - hsv.y * clamp01(std::min(k, 4 - k)));
  };
  return Rgb(channel(5), channel(3), channel(1));
}

/// The modes of the HSV space; mixed with the colour below by the factor.
Rgb component_blend(int mode, float factor, const Rgb& below, const Rgb& above) {
  const Vec3 a = hsv_of(below), b = hsv_of(above);
  const auto mixed = [&](const Rgb& c) { return below * (1 - factor) + c * factor; };
  switch (mode) {
    case kHue:
      return b.y != 0 ? mixed(rgb_of({b.x, a.y, a.z})) : below;
    case kSaturation:
      return a.y != 0 ? rgb_of({a.x, a.y + (b.y - a.y) * factor, a.z}) : below;
    case kColor:
      return b.y != 0 ? mixed(rgb_of({b.x, b.y, a.z})) : below;
    default:
      return rgb_of({a.x, a.y, a.z + (b.z - a.z) * factor});
  }
}

float finite_or_0(float x) { return std::isfinite(x) ? x : 0; }

Rgba with_channels(const Rgb& c, float alpha, bool clamp) {
  Rgb result(finite_or_0(c.x), finite_or_0(c.y), finite_or_0(c.z));
  if (clamp) result = Rgb(clamp01(result.x), clamp01(result.y), clamp01(result.z));
  return {result.x, result.y, result.z, alpha};
}

void give_math(const Call& call, void* result) {
  const auto& p = call.as<MathNode>();
  const Operation f = kOperations[std::clamp(p.operation, 0, kLastOperation)];
  const Rgb c(f(p.input1.r, p.input2.r, p.input3.r), f(p.input1.g, p.input2.g, p.input3.g),
              f(p.input1.b, p.input2.b, p.input3.b));
  *static_cast<Rgba*>(result) = with_channels(c, p.input1.a, p.clamp);
}

void give_blend(const Call& call, void* result) {
  const auto& p = call.as<BlendNode>();
  const float factor = clamp01(p.factor);
  const int mode = std::clamp(p.mode, 0, kValue);
  const Rgb below = rgb(p.below), above = rgb(p.above);
  Rgb c;
  for (int i = 0; i < 3; ++i) {
    const float a = below[i], b = above[i];
    c[i] = mode == kDodge  ? dodge(a, b, factor)
           : mode == kBurn ? burn(a, b, factor)
           : mode < kDodge ? a * (1 - factor) + kBlends[mode](a, b) * factor
                           : a;
  }
  if (mode >= kHue) c = component_blend(mode, factor, below, above);
  *static_cast<Rgba*>(result) = with_channels(c, p.below.a, p.clamp);
}

void give_hue_saturation(const Call& call, void* result) {
  const auto& p = call.as<HueSaturation>();
  Vec3 hsv = hsv_of(rgb(p.input));
  hsv.x = fraction(hsv.x + p.hue + 0.5f);
  hsv.y = clamp01(hsv.y * p.saturation);
  hsv.z *= p.value;
  const Rgb before = rgb(p.input), turned = rgb_of(hsv);
  Rgb c = before * (1 - p.factor) + turned * p.factor;
  c = Rgb(std::max(c.x, 0.0f), std::max(c.y, 0.0f), std::max(c.z, 0.0f));
  *static_cast<Rgba*>(result) = with_channels(c, p.input.a, false);
}

constexpr ParamSpec kMathRows[] = {
    {ORIEL_PARAM(MathNode, operation), .min = 0, .max = kLastOperation,
     .doc = "0 add, 1 subtract, 2 multiply, 3 divide, 4 multiply and add, 5 power, 6 logarithm, 7 "
            "root, 8 inverse root, 9 absolute value, 10 exponential, 11 minimum, 12 maximum, 13 "
            "less, 14 greater, 15 sign, 16 equal within input3, 17 smooth minimum, 18 smooth "
            "maximum, 19 round, 20 floor, 21 ceiling, 22 truncate, 23 fraction, 24 remainder, 25 "
            "remainder with the sign of input2, 26 wrap to input3..input2, 27 snap, 28 ping-pong, "
            "29 sine, 30 cosine, 31 tangent, 32 to 34 their inverses, 35 angle of input1 and "
            "input2, 36 to radians, 37 to degrees, 38 from a "
            "decoding by gamma 2.2 to that by the sRGB curve."},
    {ORIEL_PARAM(MathNode, input1), .doc = "First operand."},
    {ORIEL_PARAM(MathNode, input2), .doc = "Second operand."},
    {ORIEL_PARAM(MathNode, input3), .doc = "Third operand."},
    {ORIEL_PARAM(MathNode, clamp), .doc = "Whether results are clamped to 0..1."},
};
constexpr ParamSpec kBlendRows[] = {
    {ORIEL_PARAM(BlendNode, mode), .min = 0, .max = kValue,
     .doc =
         "0 mix, 1 add, 2 multiply, 3 subtract, 4 screen, 5 divide, 6 difference, 7 exclusion, 8 "
         "darken, 9 lighten, 10 overlay, 11 soft light, 12 linear light, 13 dodge, 14 burn, 15 "
         "hue, 16 saturation, 17 colour, 18 value."},
    {ORIEL_PARAM(BlendNode, factor), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Weight of the result; the rest is the colour below."},
    {ORIEL_PARAM(BlendNode, below), .doc = "Colour below."},
    {ORIEL_PARAM(BlendNode, above), .doc = "Colour above."},
    {ORIEL_PARAM(BlendNode, clamp), .doc = "Whether results are clamped to 0..1."},
};
constexpr ParamSpec kHueSaturationRows[] = {
    {ORIEL_PARAM(HueSaturation, input), .doc = "Colour to change."},
    {ORIEL_PARAM(HueSaturation, hue), .fallback = {.5f}, .unit = "turns",
     .doc = "Rotation of the hue; 0.5 = none."},
    {ORIEL_PARAM(HueSaturation, saturation), .fallback = {1}, .min = 0,
     .doc = "Factor of the saturation."},
    {ORIEL_PARAM(HueSaturation, value), .fallback = {1}, .min = 0, .doc = "Factor of the value."},
    {ORIEL_PARAM(HueSaturation, factor), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Weight of the changed colour."},
};

}  // namespace

const ShaderSpec kOrielMath = {
    .name = "oriel_math",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Arithmetic of numbers or of the channels of colours.",
    .params = kMathRows,
    .params_size = sizeof(MathNode),
    .value = give_math,
};

const ShaderSpec kOrielBlend = {
    .name = "oriel_blend",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Blends two colours by a mode of painting programs.",
    .params = kBlendRows,
    .params_size = sizeof(BlendNode),
    .value = give_blend,
};

const ShaderSpec kOrielHueSaturation = {
    .name = "oriel_hue_saturation",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Changes hue, saturation and value of a colour.",
    .params = kHueSaturationRows,
    .params_size = sizeof(HueSaturation),
    .value = give_hue_saturation,
};

}  // namespace oriel
