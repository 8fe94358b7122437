// SPDX-License-Identifier: Apache-2.0
// Insertion into the cache's octree, and the adjustment of radii by neighbours.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/math.h"
#include "base/parallel.h"
#include "transport/gather/gather_cache.h"

namespace oriel {
namespace {

/// Entries of a leaf before it splits. Measured: 4 to 16 differ only by noise.
constexpr std::size_t kLeaf = 8;
/// Squares of positions up to this bound stay well within the range of float.
constexpr float kFarthestPosition = 1e15f;

/// Index of the octant that contains a position.
std::uint32_t octant(const Vec3& p, const Vec3& centre) {
  return (p.x >= centre.x ? 1u : 0u) | (p.y >= centre.y ? 2u : 0u) | (p.z >= centre.z ? 4u : 0u);
}
Vec3 child_centre(const Vec3& centre, float half, std::uint32_t i) {
  const float q = 0.5f * half;
  return centre + Vec3(i & 1 ? q : -q, i & 2 ? q : -q, i & 4 ? q : -q);
}
bool within(const Vec3& v, float bound) {
  // False for NaN.
  return std::abs(v.x) <= bound && std::abs(v.y) <= bound && std::abs(v.z) <= bound;
}

/// Parts of each face of a cube along an edge: the sphere has 54 parts. An axis is the middle of
/// one, because most normals of buildings are axes.
constexpr int kPartsOfEdge = 3;
/// Cosine and sine of the largest angle between the middle of a part and its corners: at a corner
/// of the middle part of a face, (1, 1/3, 1/3), it is 25.3 degrees. At the corners of the cube the
/// parts are smaller. Rounded up.
constexpr float kPartCosine = 0.9f, kPartSine = 0.436f;

/// Part of a face: coordinates u and v in -1...1 of the face's square.
int part_of_edge(float u) {
  return std::clamp(static_cast<int>((u + 1) * (0.5f * kPartsOfEdge)), 0, kPartsOfEdge - 1);
}

std::array<Vec3, 6 * kPartsOfEdge * kPartsOfEdge> middles_of_parts() {
  std::array<Vec3, 6 * kPartsOfEdge * kPartsOfEdge> middles;
  std::size_t next = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {1.0f, -1.0f})
      for (int i = 0; i < kPartsOfEdge; ++i)
        for (int j = 0; j < kPartsOfEdge; ++j) {
          Vec3 m(0);
          m[axis] = side;
          m[(axis + 1) % 3] = static_cast<float>(2 * i + 1) / kPartsOfEdge - 1;
          m[(axis + 2) % 3] = static_cast<float>(2 * j + 1) / kPartsOfEdge - 1;
          middles[next++] = m.normalized();
        }
  return middles;
}

}  // namespace

std::uint64_t GatherCache::normal_bit(const Vec3& n) {
  const float x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const float scale = 1 / std::abs(n[axis]);
  const int face = 2 * axis + (n[axis] < 0 ? 1 : 0);
  const int part = (face * kPartsOfEdge + part_of_edge(n[(axis + 1) % 3] * scale)) * kPartsOfEdge +
                   part_of_edge(n[(axis + 2) % 3] * scale);
  return std::uint64_t{1} << part;
}

std::uint64_t GatherCache::normal_bits(const Vec3& n, float min_cosine) {
  static const auto kMiddles = middles_of_parts();
  // Cosine of the sum of the cone's angle and that of a part; beyond half a turn all parts count.
  const float cosine = clamp(min_cosine, -1, 1), sine = std::sqrt(1 - sqr(cosine));
  if (cosine <= -kPartCosine) return ~std::uint64_t{0};
  const float least = cosine * kPartCosine - sine * kPartSine;
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < kMiddles.size(); ++i)
    bits |= std::uint64_t{dot(kMiddles[i], n) >= least ? 1u : 0u} << i;
  return bits;
}

bool GatherCache::usable(const GatherRecord& r) {
  constexpr float kMax = 1e30f;
  bool good = within(r.position, kFarthestPosition) && std::abs(r.normal.length2() - 1) < 1e-3f &&
              within(r.irradiance, kMax) && r.irradiance.x >= 0 && r.irradiance.y >= 0 &&
              r.irradiance.z >= 0 && r.radius > 0 && r.radius <= kGatherFarthest &&
              r.mean_distance >= 0 && r.mean_distance <= kGatherFarthest && r.min_distance >= 0 &&
              r.min_distance <= kGatherFarthest && within(r.incoming.mean, kMax);
  for (std::size_t c = 0; c < 3; ++c)
    good = good && within(r.by_position[c], kMax) && within(r.by_normal[c], kMax) &&
           within(r.incoming.linear[c], kMax);
  for (const float f : r.free) good = good && f >= 0 && f <= kGatherFarthest;
  for (const Rgb& q : r.incoming.quadratic) good = good && within(q, kMax);
  return good;
}

void GatherCache::Node::include(const Entry& e, float own_radius) {
  low = Vec3(std::min(low.x, e.position.x), std::min(low.y, e.position.y),
             std::min(low.z, e.position.z));
  high = Vec3(std::max(high.x, e.position.x), std::max(high.y, e.position.y),
              std::max(high.z, e.position.z));
  reach = std::max(reach, e.radius);
  least = std::min(least, own_radius);
  normals |= normal_bit(e.normal);
}

std::size_t GatherCache::insert(std::span<const GatherRecord> records) {
  std::size_t added = 0;
  for (const GatherRecord& r : records) {
    if (!usable(r) || records_.size() == std::numeric_limits<std::uint32_t>::max()) continue;
    const auto index = static_cast<std::uint32_t>(records_.size());
    records_.push_back(r);
    radii_.push_back(r.radius);
    place({r.position, r.radius, r.normal, index});
    ++added;
  }
  if (added > 0) flatten();
  return added;
}

void GatherCache::SearchNode::set(int child, const Node& node) {
  const auto i = static_cast<std::size_t>(child);
  low_x[i] = node.low.x, low_y[i] = node.low.y, low_z[i] = node.low.z;
  high_x[i] = node.high.x, high_y[i] = node.high.y, high_z[i] = node.high.z;
  reach[i] = node.reach;
  normals[i] = node.normals;
  first[i] = entries[i] = 0;
}

/// Copies the tree into the arrays of look-ups.
void GatherCache::flatten() {
  search_nodes_.resize(1);
  search_entries_.clear();
  const Node none;
  for (int i = 1; i < SearchNode::kChildren; ++i) search_nodes_[0].set(i, none);
  search_nodes_[0].set(0, nodes_[0]);
  flatten_child(0, 0, 0);
}

void GatherCache::flatten_child(std::uint32_t node, std::uint32_t parent, std::size_t i) {
  const std::vector<Entry>& entries = nodes_[node].entries;
  if (nodes_[node].child == 0) {
    search_nodes_[parent].first[i] = static_cast<std::uint32_t>(search_entries_.size());
    search_nodes_[parent].entries[i] = static_cast<std::uint32_t>(entries.size());
    search_entries_.insert(search_entries_.end(), entries.begin(), entries.end());
    return;
  }
  const auto own = static_cast<std::uint32_t>(search_nodes_.size());
  search_nodes_[parent].first[i] = own;
  SearchNode& children = search_nodes_.emplace_back();
  for (std::uint32_t k = 0; k < 8; ++k)
    children.set(static_cast<int>(k), nodes_[nodes_[node].child + k]);
  for (std::uint32_t k = 0; k < 8; ++k) flatten_child(nodes_[node].child + k, own, k);
}

void GatherCache::grow_to(const Vec3& p) {
  while (!within(p - centre_, half_)) {
    // The old root becomes the child on the side away from the new point.
    const Vec3 to(p.x >= centre_.x ? half_ : -half_, p.y >= centre_.y ? half_ : -half_,
                  p.z >= centre_.z ? half_ : -half_);
    const Vec3 wider = centre_ + to;
    const auto first = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 8);
    Node& old = nodes_[first + octant(centre_, wider)];
    old = std::move(nodes_[0]);
    nodes_[0] = {old.low, old.high, old.reach, old.least, old.normals, first, {}};
    centre_ = wider;
    half_ *= 2;
  }
}

void GatherCache::split(std::uint32_t index, const Vec3& centre) {
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 8);
  for (const Entry& e : nodes_[index].entries) {
    Node& child = nodes_[first + octant(e.position, centre)];
    child.include(e, records_[e.record].radius);
    child.entries.push_back(e);
  }
  nodes_[index].child = first;
  nodes_[index].entries = {};
}

void GatherCache::place(const Entry& e) {
  if (nodes_.empty()) {
    nodes_.resize(1);
    centre_ = e.position;
  }
  grow_to(e.position);
  std::uint32_t index = 0;
  Vec3 centre = centre_;
  float half = half_;
  while (true) {
    nodes_[index].include(e, records_[e.record].radius);
    if (nodes_[index].child == 0) {
      // Cells whose size is below the rounding error of their centre cannot separate points.
      const float coordinate =
          std::max(std::abs(centre.x), std::max(std::abs(centre.y), std::abs(centre.z)));
      if (nodes_[index].entries.size() < kLeaf || half <= 1e-6f * coordinate || half < 1e-15f) {
        nodes_[index].entries.push_back(e);
        return;
      }
      split(index, centre);
    }
    const std::uint32_t i = octant(e.position, centre);
    index = nodes_[index].child + i;
    centre = child_centre(centre, half, i);
    half *= 0.5f;
  }
}

float GatherCache::clamped(std::uint32_t index, const Vec3& p, float best) const {
  const Node& node = nodes_[index];
  if (std::sqrt(node.distance2(p)) + node.least >= best) return best;
  if (node.child != 0) {
    for (std::uint32_t i = 0; i < 8; ++i) best = clamped(node.child + i, p, best);
    return best;
  }
  for (const Entry& e : node.entries)
    best = std::min(best, records_[e.record].radius + length(e.position - p));
  return best;
}

float GatherCache::refit(std::uint32_t index) {
  Node& node = nodes_[index];
  node.reach = 0;
  if (node.child != 0)
    for (std::uint32_t i = 0; i < 8; ++i) node.reach = std::max(node.reach, refit(node.child + i));
  for (Entry& e : node.entries) {
    e.radius = radii_[e.record];
    node.reach = std::max(node.reach, e.radius);
  }
  return node.reach;
}

float GatherCache::straight(std::uint32_t index, const GatherRecord& r, float radius,
                            float tolerance) const {
  /// Differences of fewer standard errors than this count as noise.
  constexpr float kNoise = 0.5f;
  /// Neighbours whose normals have a smaller cosine belong to another surface.
  constexpr float kSameWay = 0.9f;
  const Node& node = nodes_[index];
  if (node.distance2(r.position) > sqr(radius)) return radius;
  if (node.child != 0) {
    for (std::uint32_t i = 0; i < 8; ++i) radius = straight(node.child + i, r, radius, tolerance);
    return radius;
  }
  for (const Entry& e : node.entries) {
    const float distance2 = (e.position - r.position).length2();
    if (!(distance2 > 0) || distance2 > sqr(radius) || dot(e.normal, r.normal) < kSameWay) continue;
    const GatherRecord& other = records_[e.record];
    const float foretold = gather_brightness(extrapolate(r, other.position, other.normal));
    const float found = gather_brightness(other.irradiance), own = gather_brightness(r.irradiance);
    const float scale = std::max(found, own);
    if (!(scale > 0)) continue;
    const float noise = math::hypot(r.noise * own, other.noise * found) / scale;
    const float wrong = std::abs(foretold - found) / scale - kNoise * noise;
    if (wrong > tolerance) radius = std::min(radius, std::sqrt(distance2 * tolerance / wrong));
  }
  return radius;
}

void GatherCache::shorten_by_curvature(float tolerance) {
  if (nodes_.empty()) return;
  std::vector<float> shorter(radii_.size());
  parallel_for(records_.size(),
               [&](std::size_t i) { shorter[i] = straight(0, records_[i], radii_[i], tolerance); });
  radii_ = std::move(shorter);
  refit(0);
  flatten();
}

void GatherCache::settle_radii() {
  clamp_to_neighbours();
  shorten_by_curvature(kErrorAtRadius);
}

void GatherCache::clamp_to_neighbours() {
  if (nodes_.empty()) return;
  // Uses the original radii: the minimum over all others of radius + distance satisfies the
  // triangle inequality, so one pass reaches the fixed point and the order does not matter.
  parallel_for(records_.size(), [this](std::size_t i) {
    radii_[i] = clamped(0, records_[i].position, records_[i].radius);
  });
  refit(0);
  flatten();
}

}  // namespace oriel
