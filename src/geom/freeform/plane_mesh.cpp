// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/plane_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geom/freeform/planar_delaunay.h"

namespace oriel::geom::freeform {
namespace {

using LoopKind = scene::SurfaceLoop::Kind;
using Technique = scene::Approximation::Technique;
constexpr std::uint8_t kInside = 1;

/// Grid lines of a parametric or regular approximation.
std::vector<double> lines_of(const OutlineInput& input, bool along_u, Budget& budget) {
  const scene::Approximation& a = input.of_surface;
  const Criteria criteria(a, input.view);
  const Direction& d = along_u ? input.net.u() : input.net.v();
  return sample_curve([](double) { return V3d(0); }, d.breaks(), d.degree(),
                      along_u ? input.range.u0 : input.range.v0,
                      along_u ? input.range.u1 : input.range.v1, a, along_u ? a.u : a.v, criteria,
                      budget);
}

/// Reduces the number of lines until their grid fits the budget.
void thin_out(std::vector<double>& us, std::vector<double>& vs, Budget& budget) {
  while (us.size() * vs.size() > budget.points && us.size() + vs.size() > 4) {
    std::vector<double>& more = us.size() > vs.size() ? us : vs;
    std::vector<double> half;
    for (std::size_t i = 0; i + 1 < more.size(); i += 2) half.push_back(more[i]);
    half.push_back(more.back());
    more = std::move(half);
    budget.spent = true;
  }
}

/// Maps the parameter plane to the grid of the triangulation, scaled by the average size of the
/// surface.
class Plane {
 public:
  explicit Plane(const OutlineInput& input) : range_(input.range) {
    constexpr int kSteps = 8;
    double length[2] = {};
    const auto at = [&](int i, int j) {
      return input.net.point(range_.u0 + (range_.u1 - range_.u0) * i / kSteps,
                             range_.v0 + (range_.v1 - range_.v0) * j / kSteps);
    };
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j <= kSteps; ++j) {
        length[0] += (at(i + 1, j) - at(i, j)).length();
        length[1] += (at(j, i + 1) - at(j, i)).length();
      }
    const double longest = std::max(length[0], length[1]);
    // No side may be so short that its points coincide on the grid.
    const auto cells = [longest](double l) {
      return double{PlanarDelaunay::kSize} * (longest > 0 ? std::max(l / longest, 1.0 / 256) : 1);
    };
    scale_u_ = cells(length[0]) / (range_.u1 - range_.u0);
    scale_v_ = cells(length[1]) / (range_.v1 - range_.v0);
  }
  GridPoint place(double u, double v) const {
    return {std::llround((u - range_.u0) * scale_u_), std::llround((v - range_.v0) * scale_v_)};
  }
  double smaller(double du, double dv) const { return std::min(du * scale_u_, dv * scale_v_); }

 private:
  Range range_;
  double scale_u_, scale_v_;
};

/// Whether a ray from the point in +x crosses the loop an odd number of times.
bool surrounds(const std::vector<GridPoint>& loop, double x, double y) {
  bool odd = false;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    const double xi = static_cast<double>(loop[i].x), yi = static_cast<double>(loop[i].y);
    const double xj = static_cast<double>(loop[j].x), yj = static_cast<double>(loop[j].y);
    if ((yi > y) != (yj > y) && x < (xj - xi) * (y - yi) / (yj - yi) + xi) odd = !odd;
  }
  return odd;
}

class Trimmer {
 public:
  Trimmer(const OutlineInput& input, Budget& budget)
      : input_(input), budget_(budget), plane_(input) {}

  void add_line(const Polyline& line) {
    std::vector<std::uint32_t> ids;
    for (const EdgePoint& p : line.points) ids.push_back(add(p));
    const bool closed = line.kind != LoopKind::Special;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < ids.size(); ++i) {
      const std::uint32_t to = ids[i + 1 < ids.size() ? i + 1 : 0];
      if (!delaunay_.fix_edge(ids[i], to)) ++crossing;
    }
    if (!closed) return;
    Loop& loop = loops_.emplace_back();
    loop.hole = line.kind == LoopKind::Hole;
    for (const std::uint32_t id : ids) loop.points.push_back(delaunay_.points()[id]);
    edge_.insert(edge_.end(), ids.begin(), ids.end());
  }

  /// Marks the faces that are inside; lines added later do not change that.
  void classify() {
    auto& faces = delaunay_.faces();
    // Faces that are not separated by a fixed edge get a common result. If edges are missing, each
    // face is tested individually, up to a work limit.
    constexpr std::size_t kMaxTests = 1'000'000'000;
    std::size_t corners = 1;
    for (const Loop& loop : loops_) corners += loop.points.size();
    const bool together = crossing == 0 || faces.size() > kMaxTests / corners;
    std::vector<bool> seen(faces.size());
    std::vector<std::uint32_t> part;
    for (std::uint32_t first = 0; first < faces.size(); ++first) {
      if (seen[first]) continue;
      part.assign(1, first);
      seen[first] = true;
      for (std::size_t i = 0; together && i < part.size(); ++i)
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t other = faces[part[i]].across[k];
          if (other == PlanarDelaunay::kNothing || faces[part[i]].fixed[k] || seen[other]) continue;
          seen[other] = true;
          part.push_back(other);
        }
      if (is_inside(part))
        for (const std::uint32_t face : part) faces[face].region = kInside;
    }
  }

  void add_point(const EdgePoint& p) { add(p); }
  void add_cells() {
    // Insert all corners first, then the sides: each triangle then lies within one cell, as its
    // error was measured.
    std::vector<std::array<std::uint32_t, 4>> cells;
    const auto add_cell = [&](const Range& c) {
      cells.push_back({add_corner(c, c.u0, c.v0), add_corner(c, c.u1, c.v0),
                       add_corner(c, c.u1, c.v1), add_corner(c, c.u0, c.v1)});
    };
    if (input_.of_surface.technique == Technique::Criteria) {
      const Criteria criteria(input_.of_surface, input_.view);
      sample_surface(input_.net, input_.range, input_.of_surface, criteria, budget_, add_cell);
    } else {
      std::vector<double> us = lines_of(input_, true, budget_);
      std::vector<double> vs = lines_of(input_, false, budget_);
      thin_out(us, vs, budget_);
      for (std::size_t j = 1; j < vs.size(); ++j)
        for (std::size_t i = 1; i < us.size(); ++i) add_cell({us[i - 1], us[i], vs[j - 1], vs[j]});
    }
    // The side of a cell that a trim crosses is not fixed.
    for (const auto& cell : cells)
      for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t a = cell[i], b = cell[(i + 1) % 4];
        if (a != PlanarDelaunay::kNothing && b != PlanarDelaunay::kNothing)
          delaunay_.fix_edge(a, b);
      }
  }

  PlaneMesh result() {
    PlaneMesh mesh;
    std::vector<std::uint32_t> number(vertices_.size(), kNone);
    for (const PlanarDelaunay::Face& f : delaunay_.faces()) {
      if (f.region != kInside) continue;
      std::uint32_t corner[3];
      for (int i = 0; i < 3; ++i) {
        std::uint32_t& n = number[f.vertex[i]];
        if (n == kNone) {
          n = static_cast<std::uint32_t>(mesh.vertices.size());
          mesh.vertices.push_back(vertices_[f.vertex[i]]);
        }
        corner[i] = n;
      }
      mesh.triangles.push_back({corner[0], corner[1], corner[2]});
    }
    for (const std::uint32_t id : edge_)
      if (number[id] != kNone) mesh.edge.push_back(number[id]);
    return mesh;
  }

  std::size_t crossing = 0;

 private:
  struct Loop {
    bool hole = false;
    std::vector<GridPoint> points;
  };

  /// At least a third of a cell from any edge, to avoid thin triangles.
  std::uint32_t add_corner(const Range& cell, double u, double v) {
    const double least = .3 * plane_.smaller(cell.u1 - cell.u0, cell.v1 - cell.v0);
    const std::uint32_t id = delaunay_.insert_clear(plane_.place(u, v), least, kInside);
    if (id == vertices_.size()) vertices_.push_back({u, v, {}});
    return id;
  }

  std::uint32_t add(const EdgePoint& p) {
    const std::uint32_t id = delaunay_.insert(plane_.place(p.u, p.v));
    if (id == vertices_.size())
      vertices_.push_back(p);
    else if (p.place)
      vertices_[id].place = p.place;
    return id;
  }

  bool is_inside(const std::vector<std::uint32_t>& part) {
    const auto& points = delaunay_.points();
    // The centre of the largest face is the most reliable point for the inside test.
    double largest = -1, x = 0, y = 0;
    for (const std::uint32_t face : part) {
      const auto& v = delaunay_.faces()[face].vertex;
      if (*std::min_element(v.begin(), v.end()) < PlanarDelaunay::kCorners) return false;
      const GridPoint a = points[v[0]], b = points[v[1]], c = points[v[2]];
      const auto area = static_cast<double>((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
      if (area <= largest) continue;
      largest = area;
      x = static_cast<double>(a.x + b.x + c.x) / 3;
      y = static_cast<double>(a.y + b.y + c.y) / 3;
    }
    bool inside = false;
    for (const Loop& loop : loops_) {
      const bool around = surrounds(loop.points, x, y);
      if (loop.hole && around) return false;
      if (!loop.hole && around) inside = !inside;
    }
    return inside;
  }

  const OutlineInput& input_;
  Budget& budget_;
  Plane plane_;
  PlanarDelaunay delaunay_;
  // The first entries belong to the corners of the enclosing triangle and are unused.
  std::vector<EdgePoint> vertices_ = std::vector<EdgePoint>(PlanarDelaunay::kCorners);
  std::vector<std::uint32_t> edge_;
  std::vector<Loop> loops_;
};

}  // namespace

PlaneMesh grid_mesh(const OutlineInput& input, Budget& budget) {
  std::vector<double> us = lines_of(input, true, budget), vs = lines_of(input, false, budget);
  thin_out(us, vs, budget);
  PlaneMesh mesh;
  const auto columns = static_cast<std::uint32_t>(us.size());
  const auto rows = static_cast<std::uint32_t>(vs.size());
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      if (i == 0 || j == 0 || i + 1 == columns || j + 1 == rows)
        mesh.edge.push_back(j * columns + i);
      mesh.vertices.push_back({us[i], vs[j], {}});
    }
  for (std::uint32_t j = 0; j + 1 < rows; ++j)
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const std::uint32_t a = j * columns + i, b = a + 1, c = b + columns, d = a + columns;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

PlaneMesh trimmed_mesh(const OutlineInput& input, const std::vector<Polyline>& lines,
                       const std::vector<EdgePoint>& points, Budget& budget,
                       std::size_t& crossing) {
  Trimmer trimmer(input, budget);
  const auto is_trim = [](const Polyline& line) { return line.kind == LoopKind::Trim; };
  if (std::none_of(lines.begin(), lines.end(), is_trim)) trimmer.add_line(border(input, budget));
  for (const Polyline& line : lines)
    if (line.kind != LoopKind::Special) trimmer.add_line(line);
  trimmer.classify();
  for (const Polyline& line : lines)
    if (line.kind == LoopKind::Special) trimmer.add_line(line);
  for (const EdgePoint& p : points) trimmer.add_point(p);
  trimmer.add_cells();
  crossing = trimmer.crossing;
  return trimmer.result();
}

}  // namespace oriel::geom::freeform
