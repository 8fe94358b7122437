// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/seams.h"

#include <algorithm>
#include <cmath>

namespace oriel::geom::freeform {
namespace {

V3d place(const SeamSide& side, double t) { return on_surface(side.input, side.curve.at(t)); }

double parameter(const SeamSide& side, double share) {
  return side.part.min + (double{side.part.max} - side.part.min) * share;
}

/// The parameter in [lo, hi] where the second side is closest to a point. Golden section search;
/// assumes one minimum.
double nearest(const SeamSide& side, const V3d& target, double lo, double hi) {
  constexpr double kGolden = 0.618033988749895;
  constexpr int kSteps = 32;
  double a = lo, b = hi;
  for (int i = 0; i < kSteps; ++i) {
    const double c = b - kGolden * (b - a), d = a + kGolden * (b - a);
    if ((place(side, c) - target).length2() < (place(side, d) - target).length2())
      b = d;
    else
      a = c;
  }
  return (a + b) / 2;
}

void sort_by_parameter(Seam& seam) {
  if (seam.t.size() < 2 || seam.t.front() <= seam.t.back()) return;
  std::reverse(seam.t.begin(), seam.t.end());
  std::reverse(seam.place.begin(), seam.place.end());
}

}  // namespace

std::pair<Seam, Seam> make_seam(const SeamSide& a, const SeamSide& b, Budget& budget) {
  std::vector<double> shares;
  for (const SeamSide* side : {&a, &b}) {
    const double length = double{side->part.max} - side->part.min;
    for (const double t : sample_part(side->curve, side->part, side->input, budget))
      shares.push_back(length != 0 ? std::clamp((t - side->part.min) / length, 0.0, 1.0) : 0);
  }
  std::sort(shares.begin(), shares.end());
  // Skip nearly equal samples, which would make degenerate triangles.
  std::vector<double> different = {0};
  for (const double s : shares) {
    constexpr double kClose = 1e-3;
    if (s > different.back() + kClose && s < 1 - kClose) different.push_back(s);
  }
  different.push_back(1);

  Seam first, second;
  for (std::size_t i = 0; i < different.size(); ++i) {
    const V3d at = place(a, parameter(a, different[i]));
    double share = different[i];
    // Search no further than halfway to the neighbours, so that the order is kept.
    if (i > 0 && i + 1 < different.size())
      share = nearest(b, at, parameter(b, (different[i - 1] + share) / 2),
                      parameter(b, (different[i + 1] + share) / 2));
    else
      share = parameter(b, share);
    first.t.push_back(parameter(a, different[i]));
    second.t.push_back(share);
    first.place.push_back(at);
    second.place.push_back(at);
  }
  sort_by_parameter(first);
  sort_by_parameter(second);
  return {std::move(first), std::move(second)};
}

}  // namespace oriel::geom::freeform
