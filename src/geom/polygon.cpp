// SPDX-License-Identifier: Apache-2.0
#include "geom/polygon.h"

#include <algorithm>
#include <cmath>

// Projection plane and the cases without ear clipping; ear_clipping.cpp has the rest. Uses double,
// because sums and products of float differences are then nearly exact and the algorithm depends on
// the sign of turns.
namespace oriel::geom {

namespace {

using Imath::V3d;

V3d newell_normal(std::span<const Vec3> outline) {
  const V3d origin(outline[0]);
  V3d sum(0);
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
    sum += (V3d(outline[i]) - origin).cross(V3d(outline[i + 1]) - origin);
  return sum;
}

// A normal for outlines whose area cancels (bow-ties): that of the largest triangle at the first
// corner.
V3d widest_normal(std::span<const Vec3> outline) {
  const V3d origin(outline[0]);
  V3d far(0);
  for (const Vec3& p : outline)
    if ((V3d(p) - origin).length2() > far.length2()) far = V3d(p) - origin;
  V3d widest(0);
  for (const Vec3& p : outline) {
    const V3d n = far.cross(V3d(p) - origin);
    if (n.length2() > widest.length2()) widest = n;
  }
  return widest;
}

double turn2(const Vec3& p, const Vec3& q, const Vec3& r, int x, int y) {
  const double ax = double(q[x]) - p[x], ay = double(q[y]) - p[y];
  const double bx = double(r[x]) - p[x], by = double(r[y]) - p[y];
  return ax * by - ay * bx;
}

// Recursive halving avoids the needle triangles that a fan would make in a disc.
void cut_convex(std::uint32_t first, std::uint32_t last, std::vector<Triangle>& out) {
  if (last - first < 2) return;
  const std::uint32_t middle = (first + last) / 2;
  out.push_back({first, middle, last});
  cut_convex(first, middle, out);
  cut_convex(middle, last, out);
}

}  // namespace

bool PolygonTriangulator::choose_plane(std::span<const Vec3> outline) {
  V3d normal = newell_normal(outline);
  V3d low(outline[0]), high(outline[0]);
  for (const Vec3& p : outline)
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], double(p[k]));
      high[k] = std::max(high[k], double(p[k]));
    }
  // A smaller relative area is a rounding error of an area that cancels.
  constexpr double kCancelled = 1e-6;
  if (!(normal.length() > kCancelled * (high - low).length2())) {
    const V3d widest = widest_normal(outline);
    normal = widest.dot(normal) < 0 ? -widest : widest;
  }
  const V3d size(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  axis_x_ = (axis + 1) % 3;
  axis_y_ = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(axis_x_, axis_y_);
  return size[axis] > 0;
}

bool PolygonTriangulator::cut_quad(std::span<const Vec3> corners,
                                   std::vector<Triangle>& out) const {
  const auto turn_at = [&](int i, int j, int k) {
    return turn2(corners[i], corners[j], corners[k], axis_x_, axis_y_);
  };
  const double t012 = turn_at(0, 1, 2), t023 = turn_at(0, 2, 3);
  const double t123 = turn_at(1, 2, 3), t130 = turn_at(1, 3, 0);
  const bool cut02 = t012 > 0 && t023 > 0, cut13 = t123 > 0 && t130 > 0;
  if (cut02 || cut13) {
    const bool shorter02 =
        (corners[2] - corners[0]).length2() <= (corners[3] - corners[1]).length2();
    if (cut02 && (!cut13 || shorter02))
      out.insert(out.end(), {{0, 1, 2}, {0, 2, 3}});
    else
      out.insert(out.end(), {{0, 1, 3}, {1, 2, 3}});
    return true;
  }
  // Sides cross: keep two opposite sides, with the orientation of the first.
  const auto cover = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    out.insert(out.end(), {{a, b, c}, {a, c, d}});
    return true;
  };
  if (t012 * t123 < 0 && t130 * t023 < 0) return cover(0, 1, 3, 2);  // 1-2 crosses 3-0
  if (t012 * t130 < 0 && t023 * t123 < 0) return cover(1, 2, 0, 3);  // 0-1 crosses 2-3
  return false;
}

bool PolygonTriangulator::is_convex(std::span<const Vec3> outline) const {
  const std::size_t n = outline.size();
  int reversals = 0;
  float last_step = outline[0][axis_x_] - outline[n - 1][axis_x_];
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& p = outline[i];
    const Vec3& q = outline[(i + 1) % n];
    if (!(turn2(p, q, outline[(i + 2) % n], axis_x_, axis_y_) > 0)) return false;
    const float step = q[axis_x_] - p[axis_x_];
    if (step == 0) continue;
    if ((step > 0) != (last_step > 0)) ++reversals;
    last_step = step;
  }
  return reversals <= 3;  // two, or three if the first step was null; a star has four
}

bool PolygonTriangulator::triangulate(std::span<const Vec3> corners,
                                      std::span<const std::uint32_t> holes,
                                      std::vector<Triangle>& out) {
  const auto count = static_cast<std::uint32_t>(corners.size());
  const std::uint32_t outline_size = holes.empty() ? count : holes[0];
  if (outline_size < 3) return false;
  const std::span<const Vec3> outline = corners.first(outline_size);
  if (!choose_plane(outline)) return false;
  if (holes.empty()) {
    if (count == 3) {
      out.push_back({0, 1, 2});
      return true;
    }
    if (count == 4 && cut_quad(corners, out)) return true;
    if (count > 4 && is_convex(outline)) {
      cut_convex(0, count - 1, out);
      return true;
    }
  }

  // Ear clipping over the outline with bridged holes.
  const std::size_t before = out.size();
  nodes_.clear();
  const std::uint32_t start = add_loop(corners, 0, outline_size, true);
  if (start == kNone) return false;
  rightmost_.clear();
  for (std::size_t h = 0; h < holes.size(); ++h) {
    const std::uint32_t end = h + 1 < holes.size() ? holes[h + 1] : count;
    const std::uint32_t hole = add_loop(corners, holes[h], end, false);
    if (hole == kNone) continue;
    std::uint32_t right = hole;
    for (std::uint32_t v = nodes_[hole].next; v != hole; v = nodes_[v].next)
      if (nodes_[v].x > nodes_[right].x) right = v;
    rightmost_.push_back(right);
  }
  bridge_holes(start, rightmost_);
  clip_ears(start, out);
  return out.size() > before;
}

}  // namespace oriel::geom
