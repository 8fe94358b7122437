// SPDX-License-Identifier: Apache-2.0
#include "lights/light_tree.h"

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/math.h"
#include "lights/portal_table.h"

namespace oriel {
namespace {

using Lanes = float __attribute__((vector_size(32)));

constexpr float kMax = std::numeric_limits<float>::infinity();
/// Places at which a split is tried. Source: as LightTree; a round number.
constexpr int kBuckets = 12;
/// Cosine between the normals of triangles of one plane: their rounding.
constexpr float kSamePlane = 1 - 1e-6f;
/// Share of the largest possible cosine that the estimate of its mean has, at least.
constexpr float kLeastCosine = 1e-3f;
/// Below it ranges are halved by number: the build calls itself.
constexpr int kDeepestSplit = 32;

float safe_sqrt(float x) { return std::sqrt(std::max(0.0f, x)); }

float area_of(const LightBounds& b) {
  const Vec3 d = b.box.size();
  return 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
}

/// Nothing where they lie in different planes or show different things.
Opening joined(const Opening& a, const Opening& b) {
  const float size = std::max(a.x1 - a.x0, a.y1 - a.y0);
  if (a.table != b.table || std::abs(a.z - b.z) > 1e-3f * size || a.scale != b.scale) return {};
  Opening r = a;
  r.x0 = std::min(a.x0, b.x0), r.x1 = std::max(a.x1, b.x1);
  r.y0 = std::min(a.y0, b.y0), r.y1 = std::max(a.y1, b.y1);
  return r;
}

/// Luminance times solid angle that a point sees of it.
float seen_through(const Opening& o, const Vec3& from) {
  const float depth = o.z - dot(from, o.table->z());
  if (!(depth > 0)) return 0;
  const float x = dot(from, o.table->x()), y = dot(from, o.table->y()), inverse = 1 / depth;
  // Never quite 0: the angles are rough.
  return o.scale * (1e-12f + o.table->rough_integral((o.x0 - x) * inverse, (o.x1 - x) * inverse,
                                                     (o.y0 - y) * inverse, (o.y1 - y) * inverse));
}

/// Solid angle that the cone shines to, weighed by the cosine beyond its normals.
float orientation_of(const LightBounds& b) {
  const float spread = math::acos(clamp(b.normals.cosine, -1, 1));
  const float sine = safe_sqrt(1 - sqr(b.normals.cosine));
  const float end = std::min(spread + math::acos(clamp(b.cos_reach, -1, 1)), kPi);
  return kTwoPi * (1 - b.normals.cosine) +
         kPi / 2 *
             (2 * end * sine - math::cos(spread - 2 * end) - 2 * spread * sine + b.normals.cosine);
}

}  // namespace

DirectionCone joined(const DirectionCone& a, const DirectionCone& b) {
  if (a.all() || b.all()) return {};
  const float cosine = clamp(dot(a.axis, b.axis), -1, 1);
  // One holds the other, as mostly where many are joined: the angle between the axes is at most the
  // difference of their half-angles.
  const float difference =
      a.cosine * b.cosine + safe_sqrt(1 - sqr(a.cosine)) * safe_sqrt(1 - sqr(b.cosine));
  if (cosine >= difference) return a.cosine <= b.cosine ? a : b;
  const float angle_a = math::acos(clamp(a.cosine, -1, 1)),
              angle_b = math::acos(clamp(b.cosine, -1, 1));
  const float angle = (angle_a + math::acos(cosine) + angle_b) / 2;
  const Vec3 across = b.axis - a.axis * cosine;
  if (angle >= kPi || !(dot(across, across) > 0)) return {};
  const float turn = angle - angle_a;
  const Vec3 axis = a.axis * math::cos(turn) + normalize(across) * math::sin(turn);
  return {normalize(axis), math::cos(angle)};
}

LightBounds joined(const LightBounds& a, const LightBounds& b) {
  LightBounds r;
  r.box = a.box;
  r.box.extendBy(b.box);
  r.normals = joined(a.normals, b.normals);
  r.cos_reach = std::min(a.cos_reach, b.cos_reach);
  r.behind = std::max(a.behind, b.behind);
  if (a.thickness < kMax && b.thickness < kMax &&
      dot(a.normals.axis, b.normals.axis) > kSamePlane) {
    const auto away = [&](const LightBounds& part) {
      return std::abs(dot(part.box.center() - r.box.center(), a.normals.axis)) + part.thickness;
    };
    r.normals = a.normals;
    r.thickness = std::max(away(a), away(b));
  }
  r.even = a.even + b.even;
  r.falling = a.falling + b.falling;
  r.opening = joined(a.opening, b.opening);
  return r;
}

/// Builds a binary tree and joins its levels.
struct LightTree::Build {
  /// A node of the binary tree; the first child follows it.
  struct Half : LightBounds {
    std::size_t second = 0;  ///< index of the second child
    int light = -1;          ///< of a leaf
    float cost() const {
      return (even * box.size().length2() + falling) * (area_of(*this) + 1e-30f);
    }
  };

  LightTree& tree;
  std::span<const LightBounds> bounds;
  std::span<const int> names;
  std::vector<int> order;
  std::vector<Half> halves;

  /// Middle of the range after it was split along its best axis.
  std::size_t split(std::size_t begin, std::size_t end, const LightBounds& whole, int depth) {
    const std::size_t middle = (begin + end) / 2;
    geom::Box3 centres;
    for (std::size_t i = begin; i < end; ++i) centres.extendBy(at(i).box.center());
    const Vec3 low = centres.min, extent = centres.size(), size = whole.box.size();
    const float longest = std::max({size.x, size.y, size.z});
    float best = kMax;
    int best_axis = -1, best_bucket = 0;
    const auto bucket_of = [&](int light, int axis) {
      const float c = bounds[static_cast<std::size_t>(light)].box.center()[axis];
      return std::min(static_cast<int>((c - low[axis]) / extent[axis] * kBuckets), kBuckets - 1);
    };
    for (int axis = 0; axis < 3 && depth < kDeepestSplit; ++axis) {
      if (!(extent[axis] > 0)) continue;
      std::array<std::optional<LightBounds>, kBuckets> buckets;
      for (std::size_t i = begin; i < end; ++i) {
        auto& b = buckets[static_cast<std::size_t>(bucket_of(order[i], axis))];
        b = b ? joined(*b, at(i)) : at(i);
      }
      for (int k = 1; k < kBuckets; ++k) {
        const auto cost_of = [&](int from, int to) {
          std::optional<LightBounds> all;
          for (int j = from; j < to; ++j)
            if (const auto& b = buckets[static_cast<std::size_t>(j)])
              all = all ? joined(*all, *b) : *b;
          if (!all) return kMax;
          return (all->even * sqr(longest) + all->falling) * orientation_of(*all) *
                 (area_of(*all) + 1e-6f * sqr(longest));
        };
        const float cost = (cost_of(0, k) + cost_of(k, kBuckets)) * longest /
                           std::max(size[axis], 1e-6f * longest);
        if (cost < best) best = cost, best_axis = axis, best_bucket = k;
      }
    }
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(begin),
               last = order.begin() + static_cast<std::ptrdiff_t>(end);
    if (best_axis < 0) return middle;
    const auto cut = std::stable_partition(
        first, last, [&](int light) { return bucket_of(light, best_axis) < best_bucket; });
    return static_cast<std::size_t>(cut - order.begin());
  }

  const LightBounds& at(std::size_t i) const { return bounds[static_cast<std::size_t>(order[i])]; }

  void halve(std::size_t begin, std::size_t end, int depth) {
    LightBounds whole = at(begin);
    for (std::size_t i = begin + 1; i < end; ++i) whole = joined(whole, at(i));
    const std::size_t index = halves.size();
    halves.push_back({whole, 0, -1});
    if (end - begin == 1) {
      halves[index].light = names[static_cast<std::size_t>(order[begin])];
      return;
    }
    const std::size_t middle = split(begin, end, whole, depth);
    halve(begin, middle, depth + 1);
    halves[index].second = halves.size();
    halve(middle, end, depth + 1);
  }

  /// A node for what a half holds; returns its index.
  std::int32_t node(std::size_t half, Place parent) {
    std::vector<std::size_t> children = {half};
    // The child that most samples go into is replaced by its halves.
    while (children.size() < kWidth) {
      auto most = children.end();
      for (auto c = children.begin(); c != children.end(); ++c)
        if (halves[*c].light < 0 &&
            (most == children.end() || halves[*c].cost() > halves[*most].cost()))
          most = c;
      if (most == children.end()) break;
      const std::size_t second = halves[*most].second;
      ++*most;
      children.push_back(second);
    }
    const std::size_t index = tree.nodes_.size();
    tree.nodes_.push_back(node_of(children));
    tree.nodes_[index].parent = parent;
    for (std::size_t k = 0; k < children.size(); ++k) {
      const Place place{static_cast<std::int32_t>(index), static_cast<std::int32_t>(k)};
      const int light = halves[children[k]].light;
      if (light >= 0) tree.places_[static_cast<std::size_t>(light)] = place;
      const std::int32_t child = light >= 0 ? ~light : node(children[k], place);
      tree.nodes_[index].child[k] = child;
    }
    return static_cast<std::int32_t>(index);
  }

  Node node_of(std::span<const std::size_t> children) {
    Node r{};
    r.count = static_cast<int>(children.size());
    for (std::size_t k = 0; k < children.size(); ++k) {
      const Half& b = halves[children[k]];
      const Vec3 centre = b.box.center();
      r.x[k] = centre.x, r.y[k] = centre.y, r.z[k] = centre.z;
      r.radius2[k] = b.box.size().length2() / 4;
      r.axis_x[k] = b.normals.axis.x, r.axis_y[k] = b.normals.axis.y,
      r.axis_z[k] = b.normals.axis.z;
      r.cosine[k] = b.normals.cosine;
      r.sine[k] = safe_sqrt(1 - sqr(b.normals.cosine));
      r.cos_reach[k] = b.cos_reach;
      r.behind[k] = b.behind;
      r.thickness[k] = b.thickness;
      r.even[k] = b.even;
      r.falling[k] = b.falling;
      r.boxes[k] = b.box;
      r.any_behind |= b.behind > 0;
      if (b.opening.table && r.openings < 0) {
        r.openings = static_cast<int>(tree.openings_.size());
        tree.openings_.resize(tree.openings_.size() + kWidth);
      }
      if (b.opening.table) tree.openings_[static_cast<std::size_t>(r.openings) + k] = b.opening;
    }
    return r;
  }
};

LightTree::LightTree(std::span<const LightBounds> bounds, std::span<const int> names) {
  if (bounds.empty()) return;
  places_.resize(static_cast<std::size_t>(*std::max_element(names.begin(), names.end())) + 1);
  Build build{*this, bounds, names, std::vector<int>(bounds.size()), {}};
  std::iota(build.order.begin(), build.order.end(), 0);
  build.halves.reserve(2 * bounds.size());
  build.halve(0, bounds.size(), 0);
  build.node(0, {});
}

namespace {

/// Angles of eight children.
struct Angles {
  Lanes cosine, sine;
};
Lanes root(Lanes x) { return Lanes(_mm256_sqrt_ps(__m256(x))); }
Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }
Lanes smaller(Lanes a, Lanes b) { return a < b ? a : b; }
Angles angles_of(Lanes cosine) {
  const Lanes c = smaller(larger(cosine, Lanes{} - 1), Lanes{} + 1);
  return {c, root(1 - c * c)};
}
/// max(0, a - b) and min(pi, a + b) of angles in [0, pi].
Angles less(const Angles& a, const Angles& b) {
  const auto within = a.cosine > b.cosine;
  return {within ? Lanes{} + 1 : a.cosine * b.cosine + a.sine * b.sine,
          within ? Lanes{} : a.sine * b.cosine - a.cosine * b.sine};
}
Angles more(const Angles& a, const Angles& b) {
  const auto beyond = a.cosine < -b.cosine;
  return {beyond ? Lanes{} - 1 : a.cosine * b.cosine - a.sine * b.sine,
          beyond ? Lanes{} : a.sine * b.cosine + a.cosine * b.sine};
}

/// In a fixed order.
float sum_of(Lanes x) { return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7])); }

/// Mean of max(0, cosine) over directions within `spread` of an axis that is `off` from the
/// direction of the cosine. Exact for a single direction, and for those of half and all of a
/// sphere.
Lanes mean_cosine(const Angles& off, const Angles& spread) {
  const Lanes mean = 0.5f * (1 + spread.cosine) * off.cosine;
  const auto wide = spread.cosine < Lanes{};
  const Lanes along = wide ? spread.cosine * off.cosine : Lanes{};
  const Lanes across = wide ? off.sine : spread.sine * off.sine;
  return 0.5f * (mean + root(mean * mean + 0.25f * (along * along + across * across)));
}

}  // namespace

LightTree::Lanes LightTree::importances(const Node& node, const LitPoint& lit) const {
  const Lanes zero = {}, one = zero + 1;
  const Lanes x = node.x - lit.position.x, y = node.y - lit.position.y, z = node.z - lit.position.z;
  const Lanes d2 = x * x + y * y + z * z;
  const Lanes strength = node.even + node.falling / larger(d2, node.radius2 + 1e-12f);
  const Lanes inverse = one / root(d2);
  // Half the angle under which the box's sphere is seen.
  const Lanes seen2 = smaller(node.radius2 * inverse * inverse, one);
  const Angles seen{root(one - seen2), root(seen2)};
  /// The estimate, or nothing where even the least angle is not below a right one.
  const auto facing = [&](const Angles& off, const Angles& spread) {
    const Lanes most = less(off, spread).cosine;
    return most > zero ? larger(mean_cosine(off, spread), kLeastCosine * most) : zero;
  };
  const Lanes depth = x * node.axis_x + y * node.axis_y + z * node.axis_z;
  const Angles off = angles_of(-depth * inverse), normals{node.cosine, node.sine};
  const Angles spread = more(normals, seen);
  const Lanes least = less(less(off, normals), seen).cosine;
  // Beyond a right angle only lights that emit to all sides remain.
  const auto within = d2 <= node.radius2 * 1.0001f;
  Lanes front = node.cos_reach >= zero ? facing(off, spread) : one;
  front = within ? one : least > node.cos_reach ? front : zero;
  Lanes cosine = depth < node.thickness ? front : zero;
  if (node.any_behind) {
    const Lanes back = within ? one : facing({-off.cosine, off.sine}, spread);
    cosine += depth > -node.thickness ? node.behind * back : zero;
  }
  Lanes found = strength * (node.cosine <= zero - 1 ? one : cosine);
  if (lit.normal != Vec3(0)) {
    const Lanes at_normal = x * lit.normal.x + y * lit.normal.y + z * lit.normal.z;
    found = found * (within ? one : facing(angles_of(at_normal * inverse), seen));
  }
  if (node.openings >= 0)
    for (std::size_t k = 0; k < static_cast<std::size_t>(node.count); ++k)
      if (const Opening& o = openings_[static_cast<std::size_t>(node.openings) + k]; o.table)
        found[k] = seen_through(o, lit.position);
  return found;
}

std::optional<LightTree::Choice> LightTree::choose(const LitPoint& lit, float& u, Part part) const {
  if (nodes_.empty()) return std::nullopt;
  float probability = 1;
  while (part >= 0) {
    const Node& node = nodes_[static_cast<std::size_t>(part)];
    const Lanes share = importances(node, lit);
    const float sum = sum_of(share);
    if (!(sum > 0)) return std::nullopt;
    float left = u * sum;
    int chosen = -1;
    for (int k = 0; k < node.count; ++k) {
      if (!(share[k] > 0)) continue;
      if (chosen >= 0) left = std::max(0.0f, left - share[chosen]);
      chosen = k;
      if (left < share[k]) break;
    }
    u = std::min(left / share[chosen], 0x1.fffffep-1f);
    probability *= share[chosen] / sum;
    part = node.child[static_cast<std::size_t>(chosen)];
  }
  return Choice{~part, probability};
}

LightTree::Place LightTree::place_of(Part part) const {
  if (part >= 0) return nodes_[static_cast<std::size_t>(part)].parent;
  const int light = ~part;
  const auto name = static_cast<std::size_t>(light);
  return name < places_.size() ? places_[name] : Place();
}

float LightTree::probability_of(const LitPoint& lit, Part part, Part of) const {
  float probability = 1;
  while (part != of) {
    const Place at = place_of(part);
    if (at.node < 0) return 0;
    const Lanes share = importances(nodes_[static_cast<std::size_t>(at.node)], lit);
    if (!(share[at.lane] > 0)) return 0;
    probability *= share[at.lane] / sum_of(share);
    part = at.node;
  }
  return probability;
}

std::vector<LightTree::Part> LightTree::parts(std::size_t most) const {
  struct Found {
    Part part;
    float cost;
  };
  std::vector<Found> found;
  if (!nodes_.empty()) found.push_back({kWhole, kMax});
  while (true) {
    const auto next = std::max_element(
        found.begin(), found.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
    if (next == found.end() || next->part < 0) break;
    const Node& node = nodes_[static_cast<std::size_t>(next->part)];
    if (found.size() + static_cast<std::size_t>(node.count) - 1 > most) break;
    found.erase(next);
    for (int k = 0; k < node.count; ++k) {
      const Part child = node.child[static_cast<std::size_t>(k)];
      const float wide = node.radius2[k];
      // Lights cannot be divided.
      found.push_back({child, child < 0 ? -1 : (node.even[k] * wide + node.falling[k]) * wide});
    }
  }
  std::vector<Part> parts(found.size());
  std::transform(found.begin(), found.end(), parts.begin(), [](const Found& f) { return f.part; });
  return parts;
}

bool LightTree::crosses(const geom::Box3& box, const Vec3& from, const Vec3& inverse,
                        float t_most) {
  float t0 = 0, t1 = t_most;
  for (int k = 0; k < 3; ++k) {
    const float a = (box.min[k] - from[k]) * inverse[k], b = (box.max[k] - from[k]) * inverse[k];
    // Written so that 0 * infinity leaves the interval as it is.
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  // Flat boxes: both ends may differ by rounding.
  return t0 <= t1 * 1.00001f;
}

}  // namespace oriel
