// SPDX-License-Identifier: Apache-2.0
#include "models/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/math.h"

namespace oriel::models {
namespace {

using Corner = std::array<double, 2>;

double turn(const Corner& a, const Corner& b, const Corner& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Whether two segments have a common point other than a common end.
bool crosses(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  if (a == c || a == d || b == c || b == d) {
    // With a common end, only an overlap counts.
    const Corner& common = a == c || a == d ? a : b;
    const Corner& one = common == a ? b : a;
    const Corner& two = common == c ? d : c;
    return turn(common, one, two) == 0 && (one[0] - common[0]) * (two[0] - common[0]) +
                                                  (one[1] - common[1]) * (two[1] - common[1]) >
                                              0;
  }
  const double c_side = turn(a, b, c), d_side = turn(a, b, d);
  const double a_side = turn(c, d, a), b_side = turn(c, d, b);
  if (c_side == 0 && d_side == 0)
    return std::max(a[0], b[0]) >= std::min(c[0], d[0]) &&
           std::max(c[0], d[0]) >= std::min(a[0], b[0]) &&
           std::max(a[1], b[1]) >= std::min(c[1], d[1]) &&
           std::max(c[1], d[1]) >= std::min(a[1], b[1]);
  return c_side * d_side <= 0 && a_side * b_side <= 0;
}

bool crosses_outline(const Corner& a, const Corner& b, const Outline& outline) {
  for (std::size_t i = 0; i < outline.size(); ++i)
    if (crosses(a, b, outline[i], outline[(i + 1) % outline.size()])) return true;
  return false;
}

/// Whether the direction to a point leads into a counter-clockwise outline at one of its corners.
bool leads_inside(const Outline& outline, std::size_t corner, const Corner& to) {
  const std::size_t n = outline.size();
  const Corner& at = outline[corner];
  const Corner& before = outline[(corner + n - 1) % n];
  const Corner& after = outline[(corner + 1) % n];
  const bool left_of_after = turn(at, after, to) > 0, left_of_before = turn(before, at, to) > 0;
  return turn(before, at, after) > 0 ? left_of_after && left_of_before
                                     : left_of_after || left_of_before;
}

struct Bridge {
  std::size_t hole, corner, hole_corner;
};

/// The shortest bridge from the outline to any of the holes.
std::optional<Bridge> shortest_bridge(const Outline& outline, const std::vector<Outline>& holes) {
  std::optional<Bridge> best;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t h = 0; h < holes.size(); ++h)
    for (std::size_t j = 0; j < holes[h].size(); ++j)
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Corner &a = outline[i], &b = holes[h][j];
        const double length = math::hypot(b[0] - a[0], b[1] - a[1]);
        if (!(length < shortest) || !leads_inside(outline, i, b)) continue;
        if (crosses_outline(a, b, outline) ||
            std::any_of(holes.begin(), holes.end(),
                        [&](const Outline& hole) { return crosses_outline(a, b, hole); }))
          continue;
        shortest = length;
        best = Bridge{h, i, j};
      }
  return best;
}

/// Rotates the corners so that the first and the last one are convex, if there are such.
void start_convex(Outline& outline) {
  const std::size_t n = outline.size();
  const auto is_convex = [&](std::size_t i) {
    return turn(outline[(i + n - 1) % n], outline[i % n], outline[(i + 1) % n]) > 0;
  };
  for (std::size_t i = 0; i < n; ++i)
    if (is_convex(i + n - 1) && is_convex(i)) {
      std::rotate(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(i), outline.end());
      return;
    }
}

}  // namespace

double signed_area(const Outline& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

Outline placed(Outline outline, const std::array<double, 4>& axes) {
  for (Corner& p : outline)
    p = {axes[0] + axes[2] * p[0] - axes[3] * p[1], axes[1] + axes[3] * p[0] + axes[2] * p[1]};
  return outline;
}

Outline with_holes(Outline outer, std::vector<Outline> holes) {
  if (signed_area(outer) < 0) std::reverse(outer.begin(), outer.end());
  for (Outline& hole : holes)
    if (signed_area(hole) > 0) std::reverse(hole.begin(), hole.end());
  while (const auto bridge = shortest_bridge(outer, holes)) {
    const Outline& hole = holes[bridge->hole];
    const auto at = static_cast<std::ptrdiff_t>(bridge->hole_corner);
    Outline path{outer[bridge->corner]};
    path.insert(path.end(), hole.begin() + at, hole.end());
    path.insert(path.end(), hole.begin(), hole.begin() + at + 1);
    outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(bridge->corner), path.begin(),
                 path.end());
    holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(bridge->hole));
  }
  start_convex(outer);
  return outer;
}

}  // namespace oriel::models
