// SPDX-License-Identifier: Apache-2.0
// mi_noise_*, mi_unoise_* and splines.
#include <algorithm>

#include "base/spline.h"
#include "oriel/sdk/shader/sample.h"
#include "sampling/lattice_noise.h"

namespace {

using oriel::sampling::NoiseAt;
using oriel::sampling::NoiseShape;
using oriel::sampling::shaped_noise;

constexpr NoiseShape kBell = NoiseShape::Bell, kEven = NoiseShape::Even;

miScalar along_line(miScalar x, miScalar* g, NoiseShape shape) {
  const NoiseAt<1> n = shaped_noise<1>({x}, shape);
  if (g) *g = n.slope[0];
  return n.value;
}

miScalar in_plane(miScalar x, miScalar y, miScalar* gx, miScalar* gy, NoiseShape shape) {
  const NoiseAt<2> n = shaped_noise<2>({x, y}, shape);
  if (gx) *gx = n.slope[0];
  if (gy) *gy = n.slope[1];
  return n.value;
}

miScalar in_space(const miVector* p, miVector* g, NoiseShape shape) {
  const NoiseAt<3> n = shaped_noise<3>({p->x, p->y, p->z}, shape);
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

miScalar mi_spline(miScalar t, int n, const miScalar* ctl) {
  return oriel::catmull_rom(t, {ctl, static_cast<std::size_t>(std::max(n, 0))});
}
