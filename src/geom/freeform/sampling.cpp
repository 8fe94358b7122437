// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "base/math.h"

namespace oriel::geom::freeform {
namespace {

using Technique = scene::Approximation::Technique;

constexpr int kMaxPieces = 1 << scene::kMaxSubdivisions;

double angle_between(const V3d& a, const V3d& b) {
  return math::atan2(a.cross(b).length(), a.dot(b));
}

int ceiled(double pieces) {
  return static_cast<int>(std::clamp(std::ceil(pieces - 1e-4), 1.0, double{kMaxPieces}));
}

/// Bisects a piece of a curve until the criteria are met; appends all samples except the first.
class CurveSplitter {
 public:
  CurveSplitter(const std::function<V3d(double)>& at, const scene::Approximation& approximation,
                const Criteria& criteria, Budget& budget, std::vector<double>& out)
      : at_(at), a_(approximation), criteria_(criteria), budget_(budget), out_(out) {}

  // The recursion depth is limited by kMaxSubdivisions.
  void split(double t0, const V3d& p0, double t1, const V3d& p1, int depth) {
    const double t = (t0 + t1) / 2;
    const V3d p = at_(t);
    const bool deeper = depth < a_.min_subdivisions ||
                        (depth < a_.max_subdivisions && criteria_excess(t0, p0, p, t1, p1) > 1);
    if (!deeper || !budget_.take(1)) {
      out_.push_back(t1);
      return;
    }
    split(t0, p0, t, p, depth + 1);
    split(t, p, t1, p1, depth + 1);
  }

 private:
  double criteria_excess(double t0, const V3d& p0, const V3d& p, double t1, const V3d& p1) const {
    // Also test the quarter points: the middle of an S-shaped piece lies on the chord.
    double distance = 0;
    const V3d places[3] = {at_(t0 + (t1 - t0) / 4), p, at_(t1 - (t1 - t0) / 4)};
    const V3d chord = p1 - p0;
    for (const V3d& q : places) {
      const double along = chord.length2() > 0 ? (q - p0).dot(chord) / chord.length2() : 0;
      distance = std::max(distance, criteria_.length(p0 + chord * std::clamp(along, 0.0, 1.0), q));
    }
    // The angle between the chords of the halves is about half the tangent angle of the piece.
    return criteria_.excess(criteria_.length(p0, p1), distance, 2 * angle_between(p - p0, p1 - p));
  }

  const std::function<V3d(double)>& at_;
  const scene::Approximation& a_;
  const Criteria& criteria_;
  Budget& budget_;
  std::vector<double>& out_;
};

void add_pieces(double t0, double t1, int pieces, Budget& budget, std::vector<double>& out) {
  if (!budget.take(static_cast<std::size_t>(pieces))) pieces = 1;
  for (int i = 1; i < pieces; ++i) out.push_back(t0 + (t1 - t0) * i / pieces);
  out.push_back(t1);
}

/// A rectangle of parameters with the number of bisections per side and the largest relative error.
struct Cell {
  double u0, u1, v0, v1;
  int depth_u = 0, depth_v = 0;
  double excess = 0;  ///< to be bisected along u or v if above 1
  bool along_u = true;
  bool operator<(const Cell& other) const { return excess < other.excess; }
};

/// Error of a cell relative to the approximation, and the side to bisect.
struct Verdict {
  double excess = 0;
  bool split_u = true;
};

Verdict judge(const SurfaceNet& surface, const Criteria& criteria, const Cell& c) {
  V3d p[3][3], n[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double u = c.u0 + (c.u1 - c.u0) * i / 2, v = c.v0 + (c.v1 - c.v0) * j / 2;
      if (!criteria.wants_angle()) {
        p[i][j] = surface.point(u, v);
        continue;
      }
      const Jet jet = surface.jet(u, v);
      p[i][j] = jet.p;
      n[i][j] = surface.normal(jet, u, v);
    }
  double length[2] = {}, away[2] = {}, turn[2] = {};
  const auto row = [&](int side, const V3d& a, const V3d& m, const V3d& b, const V3d& na,
                       const V3d& nm, const V3d& nb) {
    length[side] = std::max(length[side], criteria.length(a, b));
    away[side] = std::max(away[side], criteria.length(m, (a + b) / 2));
    if (criteria.wants_angle())
      turn[side] = std::max(turn[side], angle_between(na, nm) + angle_between(nm, nb));
  };
  for (int k = 0; k < 3; ++k) {
    row(0, p[0][k], p[1][k], p[2][k], n[0][k], n[1][k], n[2][k]);
    row(1, p[k][0], p[k][1], p[k][2], n[k][0], n[k][1], n[k][2]);
  }
  // Bilinear interpolation deviates from the surface by at most the sum of both directions; the
  // triangles deviate from the bilinear patch by a quarter of the twist.
  const V3d twist = (p[0][0] - p[2][0] - p[0][2] + p[2][2]) / 4;
  const double distance = away[0] + away[1] + criteria.length(p[1][1], p[1][1] + twist);
  const double diagonal =
      std::max(criteria.length(p[0][0], p[2][2]), criteria.length(p[2][0], p[0][2]));
  Verdict verdict;
  verdict.excess = criteria.excess(diagonal, distance, std::max(turn[0], turn[1]));
  const double u = criteria.excess(length[0], 2 * away[0], turn[0]),
               v = criteria.excess(length[1], 2 * away[1], turn[1]);
  verdict.split_u = u != v ? u > v : length[0] >= length[1];
  return verdict;
}

/// Computes the error of a cell and the side to bisect.
void weigh(const SurfaceNet& surface, const scene::Approximation& a, const Criteria& criteria,
           Cell& c) {
  const bool room_u = c.depth_u < a.max_subdivisions, room_v = c.depth_v < a.max_subdivisions;
  c.excess = 0;
  if (c.depth_u < a.min_subdivisions || c.depth_v < a.min_subdivisions) {
    c.excess = std::numeric_limits<double>::infinity();
    c.along_u = c.depth_u < a.min_subdivisions;
  } else if (room_u || room_v) {
    const Verdict verdict = judge(surface, criteria, c);
    c.excess = verdict.excess;
    c.along_u = room_u && (verdict.split_u || !room_v);
  }
}

}  // namespace

double Criteria::length(const V3d& a, const V3d& b) const {
  return a_.view ? double{view_.pixels(Vec3(a), Vec3(b))} : (b - a).length();
}

double Criteria::excess(double length, double distance, double angle) const {
  const double measures[3] = {length, distance, angle},
               limits[3] = {a_.length, a_.distance, a_.angle};
  double worst = 0;
  bool asked = false;
  for (int i = 0; i < 3; ++i) {
    if (!(limits[i] > 0)) continue;
    const double quotient = measures[i] / limits[i];
    worst = !asked ? quotient : a_.any ? std::min(worst, quotient) : std::max(worst, quotient);
    asked = true;
  }
  return worst;
}

std::vector<double> breaks_between(const std::vector<double>& breaks, double t0, double t1) {
  std::vector<double> result = {t0};
  for (const double t : breaks)
    if (t > t0 && t < t1) result.push_back(t);
  result.push_back(t1);
  return result;
}

std::vector<double> sample_curve(const std::function<V3d(double)>& at,
                                 const std::vector<double>& breaks, int degree, double t0,
                                 double t1, const scene::Approximation& a, float factor,
                                 const Criteria& criteria, Budget& budget) {
  const std::vector<double> spans = breaks_between(breaks, t0, t1);
  std::vector<double> out = {t0};
  if (a.technique == Technique::Regular) {
    const double whole = static_cast<double>(spans.size() - 1) * degree;
    add_pieces(t0, t1, ceiled(a.percent ? factor / 100 * whole : factor), budget, out);
    return out;
  }
  CurveSplitter splitter(at, a, criteria, budget, out);
  for (std::size_t i = 0; i + 1 < spans.size(); ++i) {
    if (a.technique == Technique::Parametric)
      add_pieces(spans[i], spans[i + 1], ceiled(double{factor} * degree), budget, out);
    else
      splitter.split(spans[i], at(spans[i]), spans[i + 1], at(spans[i + 1]), 0);
  }
  return out;
}

void sample_surface(const SurfaceNet& surface, const Range& range, const scene::Approximation& a,
                    const Criteria& criteria, Budget& budget,
                    const std::function<void(const Range&)>& cell) {
  const std::vector<double> us = breaks_between(surface.u().breaks(), range.u0, range.u1),
                            vs = breaks_between(surface.v().breaks(), range.v0, range.v1);
  std::priority_queue<Cell> coarse;
  const auto add = [&](Cell c) {
    weigh(surface, a, criteria, c);
    if (c.excess > 1)
      coarse.push(c);
    else
      cell({c.u0, c.u1, c.v0, c.v1});
  };
  for (std::size_t j = 0; j + 1 < vs.size(); ++j)
    for (std::size_t i = 0; i + 1 < us.size(); ++i) add({us[i], us[i + 1], vs[j], vs[j + 1]});
  std::size_t cells = (us.size() - 1) * (vs.size() - 1);
  const std::size_t most = a.max_triangles > 0 ? static_cast<std::size_t>(a.max_triangles) / 2
                                               : std::numeric_limits<std::size_t>::max();
  for (; !coarse.empty() && cells < most && budget.take(1); ++cells) {
    Cell low = coarse.top(), high = low;
    coarse.pop();
    if (low.along_u) {
      low.u1 = high.u0 = (low.u0 + low.u1) / 2;
      ++low.depth_u, ++high.depth_u;
    } else {
      low.v1 = high.v0 = (low.v0 + low.v1) / 2;
      ++low.depth_v, ++high.depth_v;
    }
    add(low);
    add(high);
  }
  for (; !coarse.empty(); coarse.pop()) {
    const Cell& c = coarse.top();
    cell({c.u0, c.u1, c.v0, c.v1});
  }
}

}  // namespace oriel::geom::freeform
