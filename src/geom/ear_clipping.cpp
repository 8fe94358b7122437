// SPDX-License-Identifier: Apache-2.0
// Ear clipping of PolygonTriangulator: loops of nodes, bridges to holes, ears, and the grid that
// avoids quadratic time for large outlines.
// Source:  D. Eberly, "Triangulation by Ear Clipping" (2002), for bridges. The grid, the relaxed
//          rules for invalid outlines and the work limit are original.
#include <algorithm>
#include <cmath>

#include "geom/polygon.h"

namespace oriel::geom {

double PolygonTriangulator::turn(const Node& p, const Node& q, const Node& r) const {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

// Whether q lies in the interior angle at p.
bool PolygonTriangulator::locally_inside(const Node& p, const Node& q) const {
  const Node& before = nodes_[p.prev];
  const Node& after = nodes_[p.next];
  const bool left_of_in = turn(before, p, q) >= 0, left_of_out = turn(p, after, q) >= 0;
  return turn(before, p, after) > 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
}

// Appends corners [begin, end) as a ring without consecutive duplicates; kNone if fewer than three
// are left. The ring gets the requested orientation, whatever the orientation of the corners.
std::uint32_t PolygonTriangulator::add_loop(std::span<const Vec3> corners, std::uint32_t begin,
                                            std::uint32_t end, bool counter_clockwise) {
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  for (std::uint32_t i = begin; i < end; ++i) {
    const double x = corners[i][axis_x_], y = corners[i][axis_y_];
    if (nodes_.size() > first && nodes_.back().x == x && nodes_.back().y == y) continue;
    nodes_.push_back({x, y, i});
  }
  while (nodes_.size() > first + 1 && nodes_.back().x == nodes_[first].x &&
         nodes_.back().y == nodes_[first].y)
    nodes_.pop_back();
  const auto count = static_cast<std::uint32_t>(nodes_.size()) - first;
  if (count < 3) {
    nodes_.resize(first);
    return kNone;
  }
  double area = 0;
  for (std::uint32_t i = 1; i + 1 < count; ++i)
    area += turn(nodes_[first], nodes_[first + i], nodes_[first + i + 1]);
  // The plane was chosen so that the outline is counter-clockwise; only holes may be reversed.
  const bool reverse = !counter_clockwise && area > 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t after = first + (i + 1) % count, before = first + (i + count - 1) % count;
    nodes_[first + i].next = reverse ? before : after;
    nodes_[first + i].prev = reverse ? after : before;
  }
  return first;
}

std::uint32_t PolygonTriangulator::copy_node(std::uint32_t node) {
  nodes_.push_back(Node(nodes_[node]));
  return static_cast<std::uint32_t>(nodes_.size()) - 1;
}

// How m, the rightmost node of a hole, is connected to the outline.
PolygonTriangulator::Bridge PolygonTriangulator::find_bridge(std::uint32_t outline,
                                                             const Node& m) const {
  // The nearest edge that a ray from m to the right crosses outwards.
  double nearest = INFINITY;
  std::uint32_t end = kNone, side_begin = kNone, v = outline;
  do {
    const Node& a = nodes_[v];
    const Node& b = nodes_[a.next];
    if (a.x == m.x && a.y == m.y && locally_inside(a, nodes_[m.next])) return {Join::AtNode, v};
    if (a.y <= m.y && m.y <= b.y && a.y < b.y) {
      const double x = a.x + (m.y - a.y) / (b.y - a.y) * (b.x - a.x);
      if (x >= m.x && x < nearest) {
        nearest = x;
        side_begin = v;
        end = a.x > b.x ? v : a.next;
      }
    }
    v = a.next;
  } while (v != outline);
  if (end == kNone) return {Join::Outside, kNone};
  if (nearest == m.x) return {Join::OnSide, side_begin};

  // Nodes in the triangle of m, that point and the end of the edge occlude the end. Select the
  // occluder with the smallest slope from m, then the nearest one, and among copies of a node the
  // one whose interior angle contains m.
  Node hit = m;
  hit.x = nearest;
  const Node& corner = nodes_[end];
  const double side = corner.y >= m.y ? 1 : -1;
  std::uint32_t best = kNone;
  double best_dx = 0, best_dy = 0;
  v = outline;
  do {
    const Node& q = nodes_[v];
    const double dx = q.x - m.x, dy = std::abs(q.y - m.y);
    const bool inside = (q.x == corner.x && q.y == corner.y) ||
                        (dx > 0 && side * turn(m, hit, q) >= 0 &&
                         side * turn(hit, corner, q) >= 0 && side * turn(corner, m, q) >= 0);
    if (inside && locally_inside(q, m)) {
      const double steeper = dy * best_dx - best_dy * dx;
      if (best == kNone || steeper < 0 || (steeper == 0 && dx < best_dx)) {
        best = v;
        best_dx = dx;
        best_dy = dy;
      }
    }
    v = q.next;
  } while (v != outline);
  return {Join::Across, best == kNone ? end : best};
}

void PolygonTriangulator::link(std::uint32_t from, std::uint32_t to) {
  nodes_[from].next = to;
  nodes_[to].prev = from;
}

void PolygonTriangulator::bridge_holes(std::uint32_t outline,
                                       std::vector<std::uint32_t>& rightmost) {
  // From right to left, so that everything between a hole and its bridge is already part of the
  // outline.
  std::sort(rightmost.begin(), rightmost.end(), [this](std::uint32_t a, std::uint32_t b) {
    return nodes_[a].x != nodes_[b].x ? nodes_[a].x > nodes_[b].x : a < b;
  });
  for (const std::uint32_t m : rightmost) {
    const auto [join, p] = find_bridge(outline, nodes_[m]);
    if (join == Join::Outside) continue;  // the hole is outside of the outline
    const std::uint32_t after = nodes_[p].next, first = nodes_[m].next, last = nodes_[m].prev;
    if (join == Join::AtNode) {  // p -> first ... last -> p2 -> after
      const std::uint32_t p2 = copy_node(p);
      link(p, first);
      link(last, p2);
      link(p2, after);
      continue;
    }
    // p -> m ... last -> m2 -> (p2 ->) after
    const std::uint32_t m2 = copy_node(m);
    const std::uint32_t p2 = join == Join::Across ? copy_node(p) : m2;
    link(p, m);
    link(last, m2);
    if (p2 != m2) link(m2, p2);
    link(p2, after);
  }
}

void PolygonTriangulator::update(std::uint32_t v) {
  Node& node = nodes_[v];
  const bool was_reflex = node.reflex;
  node.reflex = !(turn(nodes_[node.prev], node, nodes_[node.next]) > 0);
  if (was_reflex && !node.reflex) wake(v);
}

void PolygonTriangulator::unlink(std::uint32_t v) {
  const auto same = [this](std::uint32_t p, std::uint32_t q) {
    return nodes_[p].x == nodes_[q].x && nodes_[p].y == nodes_[q].y;
  };
  for (;;) {
    const std::uint32_t before = nodes_[v].prev, after = nodes_[v].next;
    nodes_[v].removed = true;
    --alive_;
    link(before, after);
    update(before);
    update(after);
    wake(v);
    // An edge followed by its reverse, as bridges produce, has to be removed at once: no ear can
    // contain it.
    if (nodes_[before].prev == after) return;
    if (same(nodes_[before].prev, after) || same(before, after))
      v = before;
    else if (same(before, nodes_[after].next))
      v = after;
    else
      return;
  }
}

int PolygonTriangulator::row_of(double y) const {
  return static_cast<int>(std::clamp((y - grid_y_) / cell_height_, 0.0, rows_ - 1.0));
}

int PolygonTriangulator::column_of(double x) const {
  return static_cast<int>(std::clamp((x - grid_x_) / cell_width_, 0.0, columns_ - 1.0));
}

void PolygonTriangulator::build_grid(std::uint32_t start) {
  double low_x = nodes_[start].x, high_x = low_x, low_y = nodes_[start].y, high_y = low_y;
  std::size_t count = 0;
  std::uint32_t v = start;
  do {
    const Node& node = nodes_[v];
    low_x = std::min(low_x, node.x);
    high_x = std::max(high_x, node.x);
    low_y = std::min(low_y, node.y);
    high_y = std::max(high_y, node.y);
    ++count;
    v = node.next;
  } while (v != start);
  alive_ = in_grid_ = count;
  const double width = high_x - low_x, height = high_y - low_y;
  grid_x_ = low_x;
  grid_y_ = low_y;
  // About one node per cell; small outlines need no grid.
  constexpr std::size_t kSmall = 32;
  constexpr double kMaxCells = 2048;
  columns_ = rows_ = 1;
  if (count > kSmall && width > 0 && height > 0) {
    const double cell = std::sqrt(width * height / static_cast<double>(count));
    columns_ = static_cast<int>(std::clamp(width / cell, 1.0, kMaxCells));
    rows_ = static_cast<int>(std::clamp(height / cell, 1.0, kMaxCells));
  }
  cell_width_ = width > 0 ? width / columns_ : 1;
  cell_height_ = height > 0 ? height / rows_ : 1;
  cells_.assign(static_cast<std::size_t>(columns_) * rows_, kNone);
  v = start;
  do {
    Node& node = nodes_[v];
    update(v);
    std::uint32_t& head =
        cells_[static_cast<std::size_t>(row_of(node.y)) * columns_ + column_of(node.x)];
    node.next_in_cell = head;
    head = v;
    v = node.next;
  } while (v != start);
}

// A reflex node inside the triangle a, b, c that is not at one of its corners; kNone if there is
// none.
std::uint32_t PolygonTriangulator::find_blocker(const Node& a, const Node& b, const Node& c,
                                                bool touching_blocks) {
  const auto same = [](const Node& p, const Node& q) { return p.x == q.x && p.y == q.y; };
  const auto between = [this](const Node& p, const Node& tip, const Node& q, const Node& r) {
    return turn(p, tip, r) > 0 && turn(tip, q, r) > 0;
  };
  // Slightly larger than the triangle, because the cell of a node on a border depends on rounding.
  const double margin_x = 1e-6 * cell_width_, margin_y = 1e-6 * cell_height_;
  const int row0 = row_of(std::min({a.y, b.y, c.y}) - margin_y);
  const int row1 = row_of(std::max({a.y, b.y, c.y}) + margin_y);
  const Node* corners[] = {&a, &b, &c, &a};
  for (int row = row0; row <= row1; ++row) {
    // Where the triangle lies within this row.
    const double low = grid_y_ + row * cell_height_ - margin_y;
    const double high = grid_y_ + (row + 1) * cell_height_ + margin_y;
    double left = INFINITY, right = -INFINITY;
    for (int side = 0; side < 3; ++side) {
      const Node* p = corners[side];
      const Node* q = corners[side + 1];
      if (p->y > q->y) std::swap(p, q);
      if (q->y < low || p->y > high) continue;
      const double slope = q->y > p->y ? (q->x - p->x) / (q->y - p->y) : 0;
      const double x0 = p->y < low ? p->x + (low - p->y) * slope : p->x;
      const double x1 = q->y > high ? p->x + (high - p->y) * slope : q->x;
      left = std::min({left, x0, x1});
      right = std::max({right, x0, x1});
    }
    if (!(left <= right)) continue;
    const int column0 = column_of(left - margin_x), column1 = column_of(right + margin_x);
    work_left_ -= (column1 - column0) / 8;  // an empty cell costs less than a node
    for (int column = column0; column <= column1; ++column) {
      std::uint32_t* link = &cells_[static_cast<std::size_t>(row) * columns_ + column];
      while (*link != kNone) {
        const std::uint32_t found = *link;
        Node& q = nodes_[found];
        if (q.removed) {
          *link = q.next_in_cell;
          continue;
        }
        link = &q.next_in_cell;
        --work_left_;
        // An outline that touches itself at the tip may pass between its sides there.
        if (same(q, b) && &q != &b &&
            (between(a, b, c, nodes_[q.next]) || between(a, b, c, nodes_[q.prev])))
          return found;
        if (!q.reflex || same(q, a) || same(q, b) || same(q, c)) continue;
        const double ab = turn(a, b, q), bc = turn(b, c, q), ca = turn(c, a, q);
        if (touching_blocks ? ab >= 0 && bc >= 0 && ca >= 0 : ab > 0 && bc > 0 && ca > 0)
          return found;
      }
    }
  }
  return kNone;
}

// Removes node v, with its triangle, when the rule lets it.
bool PolygonTriangulator::try_clip(std::uint32_t v, Rule rule, std::vector<Triangle>& out) {
  const Node& node = nodes_[v];
  const Node& before = nodes_[node.prev];
  const Node& after = nodes_[node.next];
  const double area = turn(before, node, after);
  switch (rule) {
    case Rule::Strict:
    case Rule::Touching:
      if (!(area > 0)) return false;
      if (const std::uint32_t blocker = find_blocker(before, node, after, rule == Rule::Strict);
          blocker != kNone) {
        waiting_.push_back({v, nodes_[blocker].first_waiting});
        nodes_[blocker].first_waiting = static_cast<std::uint32_t>(waiting_.size()) - 1;
        return false;
      }
      break;
    case Rule::DropFlat:
      if (area != 0) return false;
      break;
    case Rule::AnyConvex:
      if (!(area > 0)) return false;
      break;
    case Rule::AnyConcave:
      if (!(area < 0)) return false;
      break;
    case Rule::Discard:
      break;
  }
  if (area > 0) out.push_back({before.corner, node.corner, after.corner});
  if (area < 0) out.push_back({before.corner, after.corner, node.corner});
  unlink(v);
  return true;
}

void PolygonTriangulator::enqueue(std::uint32_t v) {
  ++nodes_[v].stamp;  // invalidates older queue entries
  queue_.push_back({v, nodes_[v].stamp});
}

void PolygonTriangulator::wake(std::uint32_t blocker) {
  for (std::uint32_t w = nodes_[blocker].first_waiting; w != kNone; w = waiting_[w].next)
    if (!nodes_[waiting_[w].node].removed) enqueue(waiting_[w].node);
  nodes_[blocker].first_waiting = kNone;
}

void PolygonTriangulator::clip_ears(std::uint32_t start, std::vector<Triangle>& out) {
  build_grid(start);
  queue_.clear();
  waiting_.clear();
  // In self-intersecting outlines every search can be long. Beyond this limit the rest is cut
  // without testing whether ears overlap. Stars and spirals with a million corners stay below it.
  work_left_ = 5'000'000 + 400 * static_cast<std::int64_t>(nodes_.size());
  Rule rule = Rule::Strict;
  const auto enqueue_all = [&] {
    std::uint32_t v = start;
    do {
      enqueue(v);
      --work_left_;
      v = nodes_[v].next;
    } while (v != start);
  };
  enqueue_all();
  // A node that fails waits until the blocking node is removed. Under the strict rule, an empty
  // queue therefore means that there is no ear. Only then is a relaxed rule tried, for one ear.
  for (std::size_t head = 0; work_left_ >= 0 && nodes_[start].prev != nodes_[start].next; ++head) {
    if (head == queue_.size()) {
      queue_.clear();
      head = 0;
      rule = static_cast<Rule>(static_cast<int>(rule) + 1);
      enqueue_all();
    }
    const auto [v, stamp] = queue_[head];
    if (nodes_[v].removed || nodes_[v].stamp != stamp) continue;
    --work_left_;
    if (!try_clip(v, rule, out)) continue;
    start = v;
    while (nodes_[start].removed) start = nodes_[start].next;
    // Cells grow with the ears.
    if (2 * alive_ < in_grid_) build_grid(start);
    // Appending the neighbours to the queue spreads the ears, which avoids needle triangles.
    enqueue(nodes_[start].prev);
    enqueue(start);
    if (rule != Rule::Strict) enqueue_all();
    rule = Rule::Strict;
  }
  while (nodes_[start].prev != nodes_[start].next) {
    try_clip(start, Rule::Discard, out);
    while (nodes_[start].removed) start = nodes_[start].next;
  }
}

}  // namespace oriel::geom
