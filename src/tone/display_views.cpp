// SPDX-License-Identifier: Apache-2.0
#include "tone/display_views.h"

#include <algorithm>
#include <array>

#include "base/math.h"

namespace oriel::lens {
namespace {

constexpr float kGrey = 0.18f;
constexpr float kStopsBelow = 10, kStopsAbove = 6.5f;

using Matrix = Imath::M33f;  // row vector convention of this file: out[i] = sum_j m[i][j] c[j]

Rgb apply(const Matrix& m, const Rgb& c) {
  Rgb out(0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out[i] += m[i][j] * c[j];
  return out;
}

struct Insets {
  Matrix inset, outset;
};

/// Matrix that moves the primaries towards white by a fifth, and its inverse.
const Insets& insets() {
  static const Insets both = [] {
    // Source: B. Wrensch, "Minimal AgX Implementation" (agx_mat).
    Matrix m(0.842479062253094f, 0.0784335999999992f, 0.0792237451477643f,  //
             0.0423282422610123f, 0.878468636469772f, 0.0791661274605434f,  //
             0.0423756549057051f, 0.0784336f, 0.879142973793104f);
    for (int i = 0; i < 3; ++i) {
      const float sum = m[i][0] + m[i][1] + m[i][2];
      for (int j = 0; j < 3; ++j) m[i][j] /= sum;
    }
    return Insets{m, m.inverse()};
  }();
  return both;
}

/// A branch of the curve: difference from the pivot at `distance`, reaching `to.y` at `to.x`.
float branch(float distance, const Vec2& to, float slope, float power) {
  const float scale = math::pow(
      math::pow(slope * to.x, -power) * (math::pow(slope * to.x / to.y, power) - 1), -1 / power);
  const float t = slope * distance / scale;
  return scale * t / math::pow(1 + math::pow(t, power), 1 / power);
}

float not_negative(float v) { return v > 0 ? std::min(v, 1e30f) : 0.0f; }

}  // namespace

float agx_curve(float x) {
  constexpr float kSlope = 2, kToe = 3, kShoulder = 3.25f, kMiddle = 0.5f;
  constexpr float kPivot = kStopsBelow / (kStopsBelow + kStopsAbove);
  x = clamp01(x);
  const float y =
      x < kPivot ? kMiddle - branch(kPivot - x, Vec2(kPivot, kMiddle), kSlope, kToe)
                 : kMiddle + branch(x - kPivot, Vec2(1 - kPivot, 1 - kMiddle), kSlope, kShoulder);
  return clamp01(y);
}

Rgb agx(const Rgb& linear) {
  const Rgb c = apply(insets().inset,
                      Rgb(not_negative(linear.x), not_negative(linear.y), not_negative(linear.z)));
  Rgb out(0);
  for (int i = 0; i < 3; ++i) {
    const float stops = math::log2(std::max(c[i], 1e-30f) / kGrey);
    out[i] = agx_curve((stops + kStopsBelow) / (kStopsBelow + kStopsAbove));
  }
  out = apply(insets().outset, out);
  return Rgb(clamp01(out.x), clamp01(out.y), clamp01(out.z));
}

Rgb pbr_neutral(const Rgb& linear) {
  constexpr float kReflected = 0.04f;          // F90 of the specification: at normal incidence
  constexpr float kStart = 0.8f - kReflected;  // K_s
  constexpr float kDesaturation = 0.15f;       // K_d
  Rgb c(not_negative(linear.x), not_negative(linear.y), not_negative(linear.z));
  const float least = std::min({c.x, c.y, c.z});
  c -= Rgb(least <= 2 * kReflected ? least - sqr(least) / (4 * kReflected) : kReflected);
  const float peak = max_component(c);
  if (peak <= kStart) return c;
  const float room = 1 - kStart;
  const float lowered = 1 - sqr(room) / (peak + room - kStart);
  const float kept = 1 / (kDesaturation * (peak - lowered) + 1);
  return c * (lowered / peak) * kept + Rgb(lowered) * (1 - kept);
}

}  // namespace oriel::lens
