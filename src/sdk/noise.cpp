// SPDX-License-Identifier: Apache-2.0
// mi_noise_*, mi_unoise_* and splines.
#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "oriel/sdk/shader/sample.h"
#include "sdk/lattice_noise.h"

namespace {

using oriel::sdk::lattice_noise;
using oriel::sdk::NoiseAt;

/// An odd polynomial of the lattice noise, which the logistic function takes to 0...1.
struct Curve {
  float linear, cubic = 0, quintic = 0;
};

/// A bell about .5 of standard deviation .14: 0.65 by the standard deviation of the lattice noise,
/// which is .2906, .3126 and .2368 (4 million places).
constexpr Curve kBell[3] = {{2.237f}, {2.080f}, {2.745f}};

/// Logarithm of the odds of the lattice noise's distribution, fitted to 4 million places: within
/// .002 of even.
constexpr Curve kEven[3] = {
    {4.6254f, 4.0652f, 16.7919f}, {4.6736f, 2.8982f, 4.1761f}, {6.3930f, 5.5716f, 12.2233f}};

/// The noise in 0...1, and its gradient in place of the lattice noise's.
template <int kDimensions>
NoiseAt<kDimensions> shaped(const std::array<float, kDimensions>& at, const Curve (&curves)[3]) {
  const Curve& curve = curves[kDimensions - 1];
  NoiseAt<kDimensions> n = lattice_noise<kDimensions>(at);
  const float x = n.value, x2 = x * x;
  const float odds = x * (curve.linear + x2 * (curve.cubic + x2 * curve.quintic));
  const float rise = curve.linear + x2 * (3 * curve.cubic + x2 * 5 * curve.quintic);
  n.value = 1 / (1 + oriel::math::exp(-odds));
  for (float& s : n.slope) s *= n.value * (1 - n.value) * rise;
  return n;
}

miScalar along_line(miScalar x, miScalar* g, const Curve (&curves)[3]) {
  const NoiseAt<1> n = shaped<1>({x}, curves);
  if (g) *g = n.slope[0];
  return n.value;
}

miScalar in_plane(miScalar x, miScalar y, miScalar* gx, miScalar* gy, const Curve (&curves)[3]) {
  const NoiseAt<2> n = shaped<2>({x, y}, curves);
  if (gx) *gx = n.slope[0];
  if (gy) *gy = n.slope[1];
  return n.value;
}

miScalar in_space(const miVector* p, miVector* g, const Curve (&curves)[3]) {
  const NoiseAt<3> n = shaped<3>({p->x, p->y, p->z}, curves);
  if (g) *g = {n.slope[0], n.slope[1], n.slope[2]};
  return n.value;
}

}  // namespace

miScalar mi_noise_1d(miScalar x) { return along_line(x, nullptr, kBell); }
miScalar mi_noise_2d(miScalar x, miScalar y) { return in_plane(x, y, nullptr, nullptr, kBell); }
miScalar mi_noise_3d(const miVector* p) { return in_space(p, nullptr, kBell); }
miScalar mi_unoise_1d(miScalar x) { return along_line(x, nullptr, kEven); }
miScalar mi_unoise_2d(miScalar x, miScalar y) { return in_plane(x, y, nullptr, nullptr, kEven); }
miScalar mi_unoise_3d(const miVector* p) { return in_space(p, nullptr, kEven); }

miScalar mi_noise_1d_grad(miScalar x, miScalar* g) { return along_line(x, g, kBell); }
miScalar mi_noise_2d_grad(miScalar x, miScalar y, miScalar* gx, miScalar* gy) {
  return in_plane(x, y, gx, gy, kBell);
}
miScalar mi_noise_3d_grad(const miVector* p, miVector* g) { return in_space(p, g, kBell); }
miScalar mi_unoise_1d_grad(miScalar x, miScalar* g) { return along_line(x, g, kEven); }
miScalar mi_unoise_2d_grad(miScalar x, miScalar y, miScalar* gx, miScalar* gy) {
  return in_plane(x, y, gx, gy, kEven);
}
miScalar mi_unoise_3d_grad(const miVector* p, miVector* g) { return in_space(p, g, kEven); }

// Catmull and Rom's member of the family (tension 1/2). Beyond the ends the outermost two points
// go on straight, so that points on a line give the line.
miScalar mi_spline(miScalar t, int n, const miScalar* ctl) {
  if (n < 2) return n == 1 ? ctl[0] : 0;
  const float at = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(n - 1);
  const int first = std::min(static_cast<int>(at), n - 2);
  const float f = at - static_cast<float>(first);
  const float b = ctl[first], c = ctl[first + 1];
  const float a = first > 0 ? ctl[first - 1] : 2 * b - c;
  const float d = first + 2 < n ? ctl[first + 2] : 2 * c - b;
  return b + 0.5f * f * (c - a + f * (2 * a - 5 * b + 4 * c - d + f * (3 * (b - c) + d - a)));
}
