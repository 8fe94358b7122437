// SPDX-License-Identifier: Apache-2.0
#include "lights/light_tree.h"

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

constexpr float kMax = std::numeric_limits<float>::infinity();
/// Places at which a split is tried. Source: as LightTree; a round number.
constexpr int kBuckets = 12;

float safe_sqrt(float x) { return std::sqrt(std::max(0.0f, x)); }

/// cos(max(0, a - b)) and its sine, of angles in [0, pi].
struct Angle {
  float cosine, sine;
};
Angle less(const Angle& a, const Angle& b) {
  if (a.cosine > b.cosine) return {1, 0};
  return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}
Angle angle_of(float cosine) { return {cosine, safe_sqrt(1 - sqr(cosine))}; }

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
  const float angle_a = math::acos(clamp(a.cosine, -1, 1)),
              angle_b = math::acos(clamp(b.cosine, -1, 1));
  const float between = math::acos(clamp(dot(a.axis, b.axis), -1, 1));
  if (std::min(between + angle_b, kPi) <= angle_a) return a;
  if (std::min(between + angle_a, kPi) <= angle_b) return b;
  const float angle = (angle_a + between + angle_b) / 2;
  const Vec3 across = b.axis - a.axis * dot(a.axis, b.axis);
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
  r.even = a.even + b.even;
  r.falling = a.falling + b.falling;
  r.opening = joined(a.opening, b.opening);
  return r;
}

float importance(const LightBounds& bounds, const LitPoint& lit) {
  if (bounds.opening.table) return seen_through(bounds.opening, lit.position);
  const Vec3 to = bounds.box.center() - lit.position;
  const float radius2 = bounds.box.size().length2() / 4;
  const float d2 = to.length2();
  const float strength = bounds.even + bounds.falling / std::max(d2, radius2 + 1e-12f);
  if (d2 <= radius2 * 1.0001f || !(d2 > 0)) return strength;
  const Vec3 wi = to / std::sqrt(d2);
  // Half the angle under which the box's sphere is seen.
  const Angle seen{safe_sqrt(1 - radius2 / d2), safe_sqrt(radius2 / d2)};
  float cosine = 1;
  if (!bounds.normals.all()) {
    const Angle off = angle_of(clamp(-dot(wi, bounds.normals.axis), -1, 1));
    const Angle least = less(less(off, angle_of(bounds.normals.cosine)), seen);
    if (least.cosine <= bounds.cos_reach) return 0;
    // Beyond a right angle only lights that emit to all sides remain.
    cosine = bounds.cos_reach >= 0 ? least.cosine : 1;
  }
  if (lit.normal != Vec3(0)) {
    const Angle off = angle_of(clamp(dot(wi, lit.normal), -1, 1));
    const float facing = less(off, seen).cosine;
    if (facing <= 0) return 0;
    cosine *= facing;
  }
  return strength * cosine;
}

/// Builds the nodes below a range of lights.
struct LightTree::Build {
  LightTree& tree;
  std::span<const LightBounds> bounds;
  std::span<const int> names;
  std::vector<int> order;

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
    for (int axis = 0; axis < 3 && depth < kDeepest / 2; ++axis) {
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

  void node(std::size_t begin, std::size_t end, std::uint64_t way, int depth) {
    LightBounds whole = at(begin);
    for (std::size_t i = begin + 1; i < end; ++i) whole = joined(whole, at(i));
    const std::size_t index = tree.nodes_.size();
    tree.nodes_.push_back({whole, 0, -1});
    if (end - begin == 1) {
      const int name = names[static_cast<std::size_t>(order[begin])];
      tree.nodes_[index].light = name;
      tree.ways_[static_cast<std::size_t>(name)] = way;
      tree.known_[static_cast<std::size_t>(name)] = 1;
      return;
    }
    const std::size_t middle = split(begin, end, whole, depth);
    node(begin, middle, way, depth + 1);
    tree.nodes_[index].second = static_cast<int>(tree.nodes_.size());
    node(middle, end, way | std::uint64_t{1} << depth, depth + 1);
  }
};

LightTree::LightTree(std::span<const LightBounds> bounds, std::span<const int> names) {
  if (bounds.empty()) return;
  const auto most = static_cast<std::size_t>(*std::max_element(names.begin(), names.end()));
  ways_.resize(most + 1);
  known_.resize(most + 1);
  nodes_.reserve(2 * bounds.size());
  Build build{*this, bounds, names, std::vector<int>(bounds.size())};
  std::iota(build.order.begin(), build.order.end(), 0);
  build.node(0, bounds.size(), 0, 0);
}

std::optional<LightTree::Choice> LightTree::choose(const LitPoint& lit, float& u) const {
  if (nodes_.empty()) return std::nullopt;
  float probability = 1;
  std::size_t at = 0;
  if (nodes_[0].light >= 0 && importance(nodes_[0], lit) <= 0) return std::nullopt;
  while (nodes_[at].light < 0) {
    const auto second = static_cast<std::size_t>(nodes_[at].second);
    const float a = importance(nodes_[at + 1], lit), b = importance(nodes_[second], lit);
    if (!(a + b > 0)) return std::nullopt;
    const float share = a / (a + b);
    if (u < share) {
      u = std::min(u / share, 0x1.fffffep-1f);
      probability *= share;
      ++at;
    } else {
      u = std::min((u - share) / (1 - share), 0x1.fffffep-1f);
      probability *= 1 - share;
      at = second;
    }
  }
  return Choice{nodes_[at].light, probability};
}

float LightTree::probability(const LitPoint& lit, int light) const {
  const auto name = static_cast<std::size_t>(light);
  if (name >= known_.size() || !known_[name]) return 0;
  if (nodes_[0].light >= 0) return importance(nodes_[0], lit) > 0 ? 1.0f : 0.0f;
  float probability = 1;
  std::size_t at = 0;
  for (int depth = 0; nodes_[at].light < 0; ++depth) {
    const auto second = static_cast<std::size_t>(nodes_[at].second);
    const float a = importance(nodes_[at + 1], lit), b = importance(nodes_[second], lit);
    if (!(a + b > 0)) return 0;
    const bool right = ways_[name] >> depth & 1;
    const float share = a / (a + b);
    probability *= right ? 1 - share : share;
    at = right ? second : at + 1;
  }
  return probability;
}

bool LightTree::crosses(const Node& node, const Vec3& from, const Vec3& inverse, float t_most) {
  float t0 = 0, t1 = t_most;
  for (int k = 0; k < 3; ++k) {
    const float a = (node.box.min[k] - from[k]) * inverse[k],
                b = (node.box.max[k] - from[k]) * inverse[k];
    // Written so that 0 * infinity leaves the interval as it is.
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  // Flat boxes: both ends may differ by rounding.
  return t0 <= t1 * 1.00001f;
}

}  // namespace oriel
