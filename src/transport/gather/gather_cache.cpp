// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/gather_cache.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace oriel {

// Estimates, as fractions of a record's radius. A record in front of the point (above the plane
// between the normals) fades between these distances; curved and bumpy surfaces need some
// tolerance.
static constexpr float kFrontFades = 0.05f, kFrontGone = 0.1f;
// The same for a record below the point, e.g. on another floor.
static constexpr float kBelowFades = 0.5f, kBelowGone = 1;
// The same, as fractions of the unoccluded distance towards the point.
static constexpr float kWayFades = 0.8f, kWayGone = 1;
// Relative noise of a record at least, for its weight; keeps weights bounded.
static constexpr float kLeastNoise = 1e-3f;

namespace {

/// Smooth step from 1 at a to 0 at b.
float falling(float a, float b, float x) { return 1 - smoothstep(a, b, x); }

/// Factor for occlusion between the record and a point at the offset `moved`.
float way_is_free(const GatherRecord& r, const Vec3& moved, float distance) {
  if (distance < kWayFades * r.min_distance) return 1;
  const float sector = gather_sector(r.normal, moved);
  const int first = static_cast<int>(sector);
  const auto free = [&](int i) { return r.free[static_cast<std::size_t>(i & 7)]; };
  const float way = lerp(free(first), free(first + 1), sector - static_cast<float>(first));
  const Vec3 along = moved - r.normal * dot(moved, r.normal);
  return falling(kWayFades * way, kWayGone * way, length(along));
}

}  // namespace

struct GatherCache::Sum {
  Gathered result;
  float weight = 0;

  void add(const GatherRecord& record, const GatherQuery& q, float w) {
    const Rgb e = (q.gradients ? extrapolate(record, q.position, q.normal) : record.irradiance) * w;
    result.irradiance += e;
    if (q.by_light) part(record, q, e);
    if (q.directional) result.incoming.add(record.incoming, w);
    weight += w;
    ++result.records;
  }
  /// Splits the irradiance by light layers. All layers have the record's gradient.
  static void part(const GatherRecord& record, const GatherQuery& q, const Rgb& e) {
    if (record.shares.size() != q.layers) {
      q.by_light[q.layers - 1] += e;
      return;
    }
    for (std::size_t i = 0; i < q.layers; ++i) q.by_light[i] += e * record.shares[i];
  }
  std::optional<Gathered> finished(const GatherQuery& q) {
    if (!(weight > 0)) return std::nullopt;
    result.irradiance *= 1 / weight;
    if (q.by_light)
      for (std::size_t i = 0; i < q.layers; ++i) q.by_light[i] *= 1 / weight;
    if (q.directional) {
      IncomingLight mean;
      mean.add(result.incoming, 1 / weight);
      result.incoming = mean;
    }
    return result;
  }
};

struct GatherCache::Near {
  float error;  ///< or distance, divided by the compatibility
  std::uint32_t record;
  bool operator<(const Near& o) const {
    return error != o.error ? error < o.error : record < o.record;
  }
};

/// The best records so far: a heap with the worst on top.
struct GatherCache::Nearest {
  std::array<Near, kMaxPoints + 1> heap;
  std::size_t count = 0, most = 0;
  float bound = 0;                            ///< worse records are ignored
  std::uint64_t normals = ~std::uint64_t{0};  ///< records with other normals are ignored
  GatherRadii scale;  ///< bounds of the distance over which the error of a record reaches 1

  void offer(const Near& candidate) {
    if (count == most) {
      if (!(candidate < heap[0])) return;
      std::pop_heap(heap.begin(), heap.begin() + static_cast<std::ptrdiff_t>(count--));
    }
    heap[count++] = candidate;
    std::push_heap(heap.begin(), heap.begin() + static_cast<std::ptrdiff_t>(count));
    if (count == most) bound = std::min(bound, heap[0].error);
  }
};

float GatherCache::compatibility(const Entry& e, const GatherQuery& q) const {
  const float cosine = dot(e.normal, q.normal);
  if (!(cosine > q.min_cosine)) return 0;
  // Fades over the outer half of the permitted range.
  float f = smoothstep(q.min_cosine, 0.5f * (1 + q.min_cosine), cosine);
  if (q.through_walls) return f;
  const Vec3 moved = q.position - e.position;
  const float above = 0.5f * dot(moved, e.normal + q.normal);
  f *= above < 0 ? falling(kFrontFades * e.radius, kFrontGone * e.radius, -above)
                 : falling(kBelowFades * e.radius, kBelowGone * e.radius, above);
  return f > 0 ? f * way_is_free(records_[e.record], moved, length(moved)) : 0;
}

std::array<float, 8> GatherCache::SearchNode::distances2(const Vec3& p) const {
  std::array<float, 8> d2;
  for (std::size_t i = 0; i < d2.size(); ++i) {
    const float x = std::max(0.0f, std::max(low_x[i] - p.x, p.x - high_x[i]));
    const float y = std::max(0.0f, std::max(low_y[i] - p.y, p.y - high_y[i]));
    const float z = std::max(0.0f, std::max(low_z[i] - p.z, p.z - high_z[i]));
    d2[i] = x * x + y * y + z * z;
  }
  return d2;
}

void GatherCache::bounded(std::uint32_t index, const GatherQuery& q, std::uint64_t normals,
                          Sum& sum) const {
  const SearchNode& node = search_nodes_[index];
  const std::array<float, 8> distances2 = node.distances2(q.position);
  for (std::size_t i = 0; i < distances2.size(); ++i) {
    if ((node.normals[i] & normals) == 0) continue;
    if (distances2[i] > sqr(q.accuracy * q.radii.clamped(node.reach[i]))) continue;
    if (node.entries[i] == 0) {
      bounded(node.first[i], q, normals, sum);
      continue;
    }
    for (const Entry& e : std::span(search_entries_).subspan(node.first[i], node.entries[i])) {
      const float distance2 = (q.position - e.position).length2();
      const float radius = q.radii.clamped(e.radius);
      if (distance2 >= sqr(q.accuracy * radius)) continue;
      const float turned = std::sqrt(std::max(0.0f, 1 - dot(e.normal, q.normal)));
      const float error = std::sqrt(distance2) / radius + turned;
      if (!(error < q.accuracy)) continue;
      const float fit = compatibility(e, q);
      // At the record itself the weight would be infinite; the distance is at least a millionth of
      // the radius.
      if (fit > 0)
        sum.add(records_[e.record], q, fit * (1 / std::max(error, 1e-6f) - 1 / q.accuracy));
    }
  }
}

void GatherCache::nearest_of_leaf(std::span<const Entry> entries, const GatherQuery& q,
                                  Nearest& found) const {
  for (const Entry& e : entries) {
    const float distance2 = (q.position - e.position).length2();
    const float cosine = dot(e.normal, q.normal), radius = found.scale.clamped(e.radius);
    if (distance2 > sqr(found.bound * radius) || !(cosine > q.min_cosine)) continue;
    float error = std::sqrt(distance2) / radius;
    if (q.by_error) error += std::sqrt(std::max(0.0f, 1 - cosine));
    if (error > found.bound) continue;
    const float fit = compatibility(e, q);
    if (fit > 0 && error <= found.bound * fit) found.offer({error / fit, e.record});
  }
}

void GatherCache::nearest(std::uint32_t index, const GatherQuery& q, Nearest& found) const {
  const SearchNode& node = search_nodes_[index];
  // Least errors of the children's records, without that of their normals.
  std::array<float, 8> errors2 = node.distances2(q.position);
  for (std::size_t i = 0; i < errors2.size(); ++i)
    errors2[i] /= sqr(found.scale.clamped(node.reach[i]));
  std::array<std::uint8_t, 8> order;
  std::size_t count = 0;
  for (std::size_t i = 0; i < errors2.size(); ++i) {
    if ((node.normals[i] & found.normals) == 0 || errors2[i] > sqr(found.bound)) continue;
    std::size_t at = count++;
    for (; at > 0 && errors2[order[at - 1]] > errors2[i]; --at) order[at] = order[at - 1];
    order[at] = static_cast<std::uint8_t>(i);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = order[k];
    if (errors2[i] > sqr(found.bound)) break;
    if (node.entries[i] > 0)
      nearest_of_leaf(std::span(search_entries_).subspan(node.first[i], node.entries[i]), q, found);
    else
      nearest(node.first[i], q, found);
  }
}

Rgb GatherCache::irradiance(const GatherStencil& from, const Vec3& position, const Vec3& normal,
                            Rgb* by_light, std::size_t layers) const {
  GatherQuery q;
  q.position = position;
  q.normal = normal;
  q.by_light = by_light;
  q.layers = layers;
  Sum sum;
  for (int i = 0; i < from.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    sum.add(records_[from.record[k]], q, from.weight[k]);
  }
  return sum.result.irradiance;
}

/// Divides the weights by the expected squared relative errors: that of interpolation, which grows
/// with the square of the error measure, and that of the rays. The latter is the mean of all
/// records: if each had its own, records that missed bright light would get more weight.
void GatherCache::prefer_exact(const Nearest& found, std::span<float> weights) const {
  float noise2 = 0, sum = 0;
  for (std::size_t i = 0; i < found.count; ++i) {
    noise2 += weights[i] * sqr(records_[found.heap[i].record].noise);
    sum += weights[i];
  }
  if (!(sum > 0)) return;
  noise2 = std::max(noise2 / sum, sqr(kLeastNoise));
  for (std::size_t i = 0; i < found.count; ++i)
    weights[i] *= noise2 / (noise2 + sqr(kErrorAtRadius * sqr(found.heap[i].error)));
}

std::optional<Gathered> GatherCache::interpolate(const GatherQuery& q) const {
  if (nodes_.empty()) return std::nullopt;
  Sum sum;
  if (q.points <= 0) {
    bounded(0, q, normal_bits(q.normal, q.min_cosine), sum);
    return sum.finished(q);
  }
  Nearest found;
  found.most = static_cast<std::size_t>(std::min(q.points, kMaxPoints)) + 1;
  const float none = std::numeric_limits<float>::infinity();
  const float worst = q.by_error ? q.accuracy : q.radii.max > 0 ? q.radii.max : none;
  found.bound = worst;
  found.normals = normal_bits(q.normal, q.min_cosine);
  found.scale = q.by_error ? q.radii : GatherRadii{1, 1};
  nearest(0, q, found);
  if (found.count == 0) return std::nullopt;
  std::sort_heap(found.heap.begin(), found.heap.begin() + static_cast<std::ptrdiff_t>(found.count));
  const std::size_t last = found.count - 1;
  const float h = found.count == found.most ? found.heap[last].error : worst;
  // Records at equal distances would all get weight 0; they get equal weights instead.
  const bool alike = !(found.heap[0].error < h);
  std::array<float, kMaxPoints + 1> weights;
  for (std::size_t i = 0; i <= last; ++i)
    weights[i] = alike ? 1 : sqr(1 - sqr(std::min(1.0f, found.heap[i].error / h)));
  if (q.by_error) prefer_exact(found, weights);
  for (std::size_t i = 0; i <= last; ++i) {
    const float w = weights[i];
    if (!(w > 0)) continue;
    sum.add(records_[found.heap[i].record], q, w);
    if (q.stencil) q.stencil->add(found.heap[i].record, w);
  }
  if (q.stencil) q.stencil->divide(sum.weight);
  if (!q.by_error && q.radii.max > 0)
    sum.result.fade = falling(0.5f, 1, found.heap[0].error / q.radii.max);
  return sum.finished(q);
}

}  // namespace oriel
