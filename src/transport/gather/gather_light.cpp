// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/gather_light.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace oriel {
namespace {

/// Weight of the mirrored lower hemisphere in the fit; an estimate. At 0 the fit oscillates below
/// the horizon; at 1 it is symmetric about it.
constexpr float kMirror = 0.03f;

/// Integrals over sin^2(theta) < s2 of the polar parts of the moments' functions times the sine of
/// the solid angle. Each ring adds a difference of two.
struct Polar {
  float one, z, zz, s, sz, ss;

  explicit Polar(float s2) {
    const float sine = std::sqrt(s2), mu2 = 1 - s2, mu = std::sqrt(std::max(0.0f, mu2));
    // 1 - mu without cancellation.
    const float cap = s2 / (1 + mu);
    one = cap;
    z = 0.5f * s2;
    zz = cap * (1 + mu + mu2) / 3;
    s = 0.5f * (math::atan2(sine, mu) - sine * mu);
    sz = s2 * sine / 3;
    ss = one - zz;
  }
};

struct Solution2 {
  Rgb even, odd;
};
/// Fit of the pair x (even in z) and xz (odd), or of y and yz.
Solution2 fit_azimuthal(const Rgb& even, const Rgb& odd) {
  constexpr float kSame = 1 + kMirror, kCross = 1 - kMirror;
  constexpr float kEe = kSame * 2 * kPi / 3, kEo = kCross * kPi / 4, kOo = kSame * 2 * kPi / 15;
  constexpr float kDet = kEe * kOo - kEo * kEo;
  const Rgb e = even * kSame, o = odd * kCross;
  return {(e * kOo - o * kEo) * (1 / kDet), (o * kEe - e * kEo) * (1 / kDet)};
}

}  // namespace

HemisphereMoments hemisphere_moments(std::span<const Rgb> radiance, int rings, int sectors) {
  HemisphereMoments m;
  const float half = kPi / static_cast<float>(sectors);
  const float first = 2 * math::sin(half), second = math::sin(2 * half);
  Polar inner(0);
  for (int j = 0; j < rings; ++j) {
    const Polar outer(static_cast<float>(j + 1) / static_cast<float>(rings));
    // Azimuth first: the ring's sums of 1, cos, sin, cos 2 and sin 2.
    Rgb sum(0), c(0), s(0), c2(0), s2(0);
    for (int k = 0; k < sectors; ++k) {
      const Rgb& l = radiance[static_cast<std::size_t>(j) * static_cast<std::size_t>(sectors) +
                              static_cast<std::size_t>(k)];
      const float phi = half * static_cast<float>(2 * k + 1);
      const float cosine = math::cos(phi), sine = math::sin(phi);
      sum += l;
      c += l * cosine;
      s += l * sine;
      c2 += l * (cosine * cosine - sine * sine);
      s2 += l * (2 * cosine * sine);
    }
    m.one += sum * (2 * half * (outer.one - inner.one));
    m.z += sum * (2 * half * (outer.z - inner.z));
    m.zz += sum * (2 * half * (outer.zz - inner.zz));
    m.x += c * (first * (outer.s - inner.s));
    m.y += s * (first * (outer.s - inner.s));
    m.xz += c * (first * (outer.sz - inner.sz));
    m.yz += s * (first * (outer.sz - inner.sz));
    m.xx_yy += c2 * (second * (outer.ss - inner.ss));
    m.xy2 += s2 * (second * (outer.ss - inner.ss));
    inner = outer;
  }
  return m;
}

void IncomingLight::add(const IncomingLight& other, float weight) {
  mean += other.mean * weight;
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] += other.linear[i] * weight;
  for (std::size_t i = 0; i < quadratic.size(); ++i) quadratic[i] += other.quadratic[i] * weight;
}

IncomingLight fit_incoming(const HemisphereMoments& m, const Frame& frame) {
  // Azimuthally constant part: 1, z, z^2 with the integrals 2 pi / (n + 1) of z^n, by Cramer's
  // rule.
  constexpr float kSame = 1 + kMirror, kCross = 1 - kMirror;
  constexpr float a = kSame * 2 * kPi, b = kCross * kPi, c = kSame * 2 * kPi / 3,
                  d = kSame * 2 * kPi / 3, e = kCross * kPi / 2, f = kSame * 2 * kPi / 5;
  constexpr float kInverseDet =
      1 / (a * (d * f - e * e) - b * (b * f - c * e) + c * (b * e - c * d));
  const Rgb r0 = m.one * kSame, r1 = m.z * kCross, r2 = m.zz * kSame;
  const Rgb one =
      (r0 * (d * f - e * e) + r1 * (c * e - b * f) + r2 * (b * e - c * d)) * kInverseDet;
  const Rgb z = (r0 * (c * e - b * f) + r1 * (a * f - c * c) + r2 * (b * c - a * e)) * kInverseDet;
  const Rgb zz = (r0 * (b * e - c * d) + r1 * (b * c - a * e) + r2 * (a * d - b * b)) * kInverseDet;

  const Solution2 x = fit_azimuthal(m.x, m.xz), y = fit_azimuthal(m.y, m.yz);
  constexpr float kTwoFold = 15 / (8 * kPi);
  const Rgb xx_yy = m.xx_yy * kTwoFold, xy = m.xy2 * kTwoFold;

  // Sorted by band, in the local frame; z^2 = 1/3 + (z^2 - 1/3).
  IncomingLight light;
  light.mean = one + zz * (1 / 3.0f);
  const std::array<Rgb, 3> linear = {x.even, y.even, z};
  const Rgb third = zz * (1 / 3.0f), xz = x.odd * 0.5f, yz = y.odd * 0.5f;
  const Rgb q[3][3] = {{xx_yy - third, xy, xz}, {xy, -xx_yy - third, yz}, {xz, yz, third + third}};

  // Transforms to world space.
  const Vec3 axes[3] = {frame.s, frame.t, frame.n};
  const auto rotated = [&](int row, int column) {
    Rgb sum(0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum += q[i][j] * (axes[i][row] * axes[j][column]);
    return sum;
  };
  for (int row = 0; row < 3; ++row)
    for (int i = 0; i < 3; ++i)
      light.linear[static_cast<std::size_t>(row)] +=
          linear[static_cast<std::size_t>(i)] * axes[i][row];
  light.quadratic = {rotated(0, 0), rotated(1, 1), rotated(0, 1), rotated(0, 2), rotated(1, 2)};
  return light;
}

Rgb blurred_radiance(const IncomingLight& light, const Vec3& w, float roughness) {
  const float a2 = sqr(clamp01(roughness));
  const float first = math::exp(-2 * a2 / (1 + 4 * a2));
  const float second = first * first * first;
  const auto& l = light.linear;
  const auto& q = light.quadratic;
  const Rgb band1 = l[0] * w.x + l[1] * w.y + l[2] * w.z;
  const Rgb band2 = q[0] * (w.x * w.x - w.z * w.z) + q[1] * (w.y * w.y - w.z * w.z) +
                    (q[2] * (w.x * w.y) + q[3] * (w.x * w.z) + q[4] * (w.y * w.z)) * 2.0f;
  const Rgb sum = light.mean + band1 * first + band2 * second;
  return Rgb(std::max(0.0f, sum.x), std::max(0.0f, sum.y), std::max(0.0f, sum.z));
}

}  // namespace oriel
