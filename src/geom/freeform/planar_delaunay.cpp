// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/planar_delaunay.h"

#include <deque>
#include <utility>

#include "base/math.h"

namespace oriel::geom::freeform {
namespace {

__extension__ using Wide = __int128;

int next(int i) { return i == 2 ? 0 : i + 1; }
int prev(int i) { return i == 0 ? 2 : i - 1; }

/// Twice the signed area of a b c, positive if counter-clockwise. The magnitude is below 2^62.
std::int64_t turn(GridPoint a, GridPoint b, GridPoint c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether d lies inside the circumcircle of a b c (counter-clockwise). Differences are below 2^30,
/// so all terms are below 2^126.
bool in_circle(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  const auto lift = [d](GridPoint p) {
    return Wide{(p.x - d.x) * (p.x - d.x) + (p.y - d.y) * (p.y - d.y)};
  };
  return lift(a) * turn(d, b, c) + lift(b) * turn(d, c, a) + lift(c) * turn(d, a, b) > 0;
}

double distance(GridPoint a, GridPoint b) {
  return math::hypot(static_cast<double>(a.x - b.x), static_cast<double>(a.y - b.y));
}

}  // namespace

PlanarDelaunay::PlanarDelaunay() {
  constexpr std::int64_t kFar = 4 * kSize;
  points_ = {{-kFar, -kFar}, {3 * kFar, -kFar}, {-kFar, 3 * kFar}};
  face_of_ = {0, 0, 0};
  faces_.push_back({{0, 1, 2}, {kNothing, kNothing, kNothing}, {false, false, false}, 0});
}

PlanarDelaunay::Found PlanarDelaunay::locate(GridPoint p) const {
  std::uint32_t face = last_;
  for (std::uint32_t steps = 0;; ++steps) {
    const Face& f = faces_[face];
    std::int64_t side[3] = {};
    int leave = -1;
    // Start with a varying edge: with constraint edges a walk in fixed order could cycle.
    for (int k = 0, i = static_cast<int>((face * 7 + steps * 5) / 4 % 3); k < 3; ++k, i = next(i)) {
      side[i] = turn(points_[f.vertex[next(i)]], points_[f.vertex[prev(i)]], p);
      if (side[i] < 0) {
        leave = i;
        break;
      }
    }
    if (leave >= 0) {
      face = f.across[leave];
      continue;
    }
    last_ = face;
    Found found{face};
    for (int i = 0; i < 3; ++i) {
      if (side[i] != 0) continue;
      if (side[next(i)] == 0)
        found.vertex = prev(i);
      else if (side[prev(i)] == 0)
        found.vertex = next(i);
      else
        found.edge = i;
    }
    return found;
  }
}

std::uint32_t PlanarDelaunay::insert(GridPoint p) { return insert_at(locate(p), p); }

std::uint32_t PlanarDelaunay::insert_clear(GridPoint p, double least, std::uint8_t region) {
  const Found found = locate(p);
  const Face& f = faces_[found.face];
  if (f.region != region) return kNothing;
  if (found.vertex >= 0) return f.vertex[found.vertex];
  for (int i = 0; i < 3; ++i) {
    const GridPoint a = points_[f.vertex[next(i)]], b = points_[f.vertex[prev(i)]];
    if (distance(points_[f.vertex[i]], p) < least) return kNothing;
    if (f.fixed[i] && static_cast<double>(turn(a, b, p)) < least * distance(a, b)) return kNothing;
  }
  return insert_at(found, p);
}

std::uint32_t PlanarDelaunay::insert_at(const Found& found, GridPoint p) {
  if (found.vertex >= 0) return faces_[found.face].vertex[found.vertex];
  const auto vertex = static_cast<std::uint32_t>(points_.size());
  points_.push_back(p);
  face_of_.push_back(found.face);
  if (found.edge >= 0)
    split_edge(found.face, found.edge, vertex);
  else
    split_face(found.face, vertex);
  legalize();
  return vertex;
}

void PlanarDelaunay::set_face(std::uint32_t face, const Face& value) {
  faces_[face] = value;
  for (const std::uint32_t v : value.vertex) face_of_[v] = face;
}

/// Updates the neighbour of `face`: replaces `from` by `to`.
void PlanarDelaunay::relink(std::uint32_t face, std::uint32_t from, std::uint32_t to) {
  if (face == kNothing) return;
  for (std::uint32_t& across : faces_[face].across)
    if (across == from) {
      across = to;
      return;
    }
}

void PlanarDelaunay::split_face(std::uint32_t face, std::uint32_t p) {
  const Face f = faces_[face];
  const auto b = static_cast<std::uint32_t>(faces_.size()), c = b + 1;
  faces_.resize(faces_.size() + 2);
  const std::uint32_t part[3] = {face, b, c};
  for (int i = 0; i < 3; ++i) {
    // The edge opposite to vertex i.
    set_face(part[i], {{p, f.vertex[next(i)], f.vertex[prev(i)]},
                       {f.across[i], part[next(i)], part[prev(i)]},
                       {f.fixed[i], false, false},
                       f.region});
    relink(f.across[i], face, part[i]);
    suspects_.emplace_back(part[i], 0);
  }
}

void PlanarDelaunay::split_edge(std::uint32_t face, int edge, std::uint32_t p) {
  const std::uint32_t other = faces_[face].across[edge];
  const Face f = faces_[face], g = faces_[other];
  int back = 0;
  while (g.across[back] != face) ++back;
  const bool fixed = f.fixed[edge];
  const auto f2 = static_cast<std::uint32_t>(faces_.size()), g2 = f2 + 1;
  faces_.resize(faces_.size() + 2);
  // f = (top, left, right), g = (bottom, right, left), the edge runs from left to right.
  const int fl = next(edge), fr = prev(edge), gr = next(back), gl = prev(back);
  const std::uint32_t top = f.vertex[edge], left = f.vertex[fl], right = f.vertex[fr];
  const std::uint32_t bottom = g.vertex[back];
  set_face(face,
           {{p, top, left}, {f.across[fr], other, f2}, {f.fixed[fr], fixed, false}, f.region});
  set_face(f2, {{p, right, top}, {f.across[fl], face, g2}, {f.fixed[fl], false, fixed}, f.region});
  set_face(other,
           {{p, left, bottom}, {g.across[gr], g2, face}, {g.fixed[gr], false, fixed}, g.region});
  set_face(g2,
           {{p, bottom, right}, {g.across[gl], f2, other}, {g.fixed[gl], fixed, false}, g.region});
  relink(f.across[fl], face, f2);
  relink(g.across[gl], other, g2);
  for (const std::uint32_t part : {face, f2, other, g2}) suspects_.emplace_back(part, 0);
}

bool PlanarDelaunay::should_flip(std::uint32_t face, int edge) const {
  const Face& f = faces_[face];
  if (f.fixed[edge] || f.across[edge] == kNothing) return false;
  const Face& g = faces_[f.across[edge]];
  int back = 0;
  while (g.across[back] != face) ++back;
  return in_circle(points_[f.vertex[0]], points_[f.vertex[1]], points_[f.vertex[2]],
                   points_[g.vertex[back]]);
}

void PlanarDelaunay::legalize() {
  while (!suspects_.empty()) {
    const auto [face, edge] = suspects_.back();
    suspects_.pop_back();
    if (!should_flip(face, edge)) continue;
    const std::uint32_t other = faces_[face].across[edge];
    flip(face, edge);
    // After a flip, all outer edges of both faces have to be tested.
    for (const std::uint32_t part : {face, other})
      for (int i = 0; i < 3; ++i)
        if (faces_[part].across[i] != face && faces_[part].across[i] != other)
          suspects_.emplace_back(part, i);
  }
}

/// Replaces the edge by the other diagonal of its two faces.
void PlanarDelaunay::flip(std::uint32_t face, int edge) {
  const std::uint32_t other = faces_[face].across[edge];
  const Face f = faces_[face], g = faces_[other];
  int back = 0;
  while (g.across[back] != face) ++back;
  const int fl = next(edge), fr = prev(edge), gr = next(back), gl = prev(back);
  const std::uint32_t top = f.vertex[edge], left = f.vertex[fl], right = f.vertex[fr];
  const std::uint32_t bottom = g.vertex[back];
  set_face(face, {{top, left, bottom},
                  {g.across[gr], other, f.across[fr]},
                  {g.fixed[gr], false, f.fixed[fr]},
                  f.region});
  set_face(other, {{bottom, right, top},
                   {f.across[fl], face, g.across[gl]},
                   {f.fixed[fl], false, g.fixed[gl]},
                   f.region});
  relink(g.across[gr], other, face);
  relink(f.across[fl], face, other);
}

int PlanarDelaunay::index_of(std::uint32_t face, std::uint32_t vertex) const {
  const auto& v = faces_[face].vertex;
  return v[0] == vertex ? 0 : v[1] == vertex ? 1 : 2;
}

bool PlanarDelaunay::find_edge(std::uint32_t a, std::uint32_t b, std::uint32_t& face,
                               int& edge) const {
  const std::uint32_t start = face_of_[a];
  face = start;
  do {
    const int i = index_of(face, a);
    if (faces_[face].vertex[next(i)] == b) {
      edge = prev(i);
      return true;
    }
    face = faces_[face].across[next(i)];
  } while (face != start && face != kNothing);
  return false;
}

void PlanarDelaunay::fix(std::uint32_t face, int edge) {
  faces_[face].fixed[edge] = true;
  const std::uint32_t other = faces_[face].across[edge];
  if (other == kNothing) return;
  for (int i = 0; i < 3; ++i)
    if (faces_[other].across[i] == face) faces_[other].fixed[i] = true;
}

bool PlanarDelaunay::fix_edge(std::uint32_t a, std::uint32_t b) {
  while (a != b) {
    // Find the face at a that contains the start of the segment.
    const std::uint32_t start = face_of_[a];
    std::uint32_t face = start, reached = kNothing;
    do {
      const int i = index_of(face, a);
      const std::uint32_t p = faces_[face].vertex[next(i)], q = faces_[face].vertex[prev(i)];
      const std::int64_t side_p = turn(points_[a], points_[b], points_[p]);
      const GridPoint to_p{points_[p].x - points_[a].x, points_[p].y - points_[a].y};
      const GridPoint to_b{points_[b].x - points_[a].x, points_[b].y - points_[a].y};
      if (p == b || (side_p == 0 && to_p.x * to_b.x + to_p.y * to_b.y > 0)) {
        fix(face, prev(i));
        reached = p;
        break;
      }
      if (side_p < 0 && turn(points_[a], points_[b], points_[q]) > 0) {
        if (!clear_way(a, b, face, i, reached)) return false;
        break;
      }
      face = faces_[face].across[next(i)];
    } while (face != start);
    if (reached == kNothing) return false;
    a = reached;
  }
  return true;
}

/// Flips all edges that cross the segment from a to b, starting with the edge of `face` opposite to
/// a, until a vertex on the segment is reached (`reached`). Then marks the edge to that vertex as
/// fixed.
bool PlanarDelaunay::clear_way(std::uint32_t a, std::uint32_t b, std::uint32_t first_face,
                               int first_edge, std::uint32_t& reached) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::deque<Edge> crossing;
  const auto side = [&](std::uint32_t v) { return turn(points_[a], points_[b], points_[v]); };
  std::uint32_t face = first_face;
  int edge = first_edge;
  for (;;) {
    const Face& f = faces_[face];
    if (f.fixed[edge]) return false;
    const std::uint32_t right = f.vertex[next(edge)], left = f.vertex[prev(edge)];
    crossing.emplace_back(right, left);
    const std::uint32_t other = f.across[edge];
    int back = 0;
    while (faces_[other].across[back] != face) ++back;
    const std::uint32_t apex = faces_[other].vertex[back];
    const std::int64_t at = apex == b ? 0 : side(apex);
    if (at == 0) {
      reached = apex;
      break;
    }
    // The next crossed edge is either right-apex or apex-left.
    edge = at > 0 ? index_of(other, left) : index_of(other, right);
    face = other;
  }
  std::vector<Edge> made;
  while (!crossing.empty()) {
    const Edge e = crossing.front();
    crossing.pop_front();
    std::uint32_t at = 0;
    int i = 0;
    if (!find_edge(e.first, e.second, at, i) && !find_edge(e.second, e.first, at, i)) continue;
    const Face& f = faces_[at];
    const std::uint32_t other = f.across[i];
    int back = 0;
    while (faces_[other].across[back] != at) ++back;
    const std::uint32_t top = f.vertex[i], bottom = faces_[other].vertex[back];
    const std::uint32_t left = f.vertex[next(i)], right = f.vertex[prev(i)];
    const bool convex = turn(points_[bottom], points_[right], points_[top]) > 0 &&
                        turn(points_[top], points_[left], points_[bottom]) > 0;
    if (!convex) {
      crossing.push_back(e);
      continue;
    }
    flip(at, i);
    const bool ends_on_way = top == a || top == reached || bottom == a || bottom == reached;
    if (!ends_on_way && (side(top) > 0) != (side(bottom) > 0))
      crossing.emplace_back(top, bottom);
    else
      made.emplace_back(top, bottom);
  }
  if (!find_edge(a, reached, face, edge)) return false;
  fix(face, edge);
  for (const Edge& e : made)
    if (find_edge(e.first, e.second, face, edge) || find_edge(e.second, e.first, face, edge))
      suspects_.emplace_back(face, edge);
  legalize();
  return true;
}

}  // namespace oriel::geom::freeform
