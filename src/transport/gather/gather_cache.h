// SPDX-License-Identifier: Apache-2.0
// The irradiance cache: selects stored records for a surface point and interpolates them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/assert.h"
#include "transport/gather/gather_record.h"

namespace oriel {

/// The records of a look-up with their weights.
struct GatherStencil {
  static constexpr int kMax = 8;
  std::array<std::uint32_t, kMax> record;
  std::array<float, kMax> weight;
  int count = 0;

  void add(std::uint32_t r, float w) {
    ORIEL_ASSERT(count < kMax);
    record[static_cast<std::size_t>(count)] = r;
    weight[static_cast<std::size_t>(count++)] = w;
  }
  void divide(float sum) {
    for (int i = 0; i < count; ++i) weight[static_cast<std::size_t>(i)] /= sum;
  }
};

/// A look-up of the cache.
struct GatherQuery {
  Vec3 position{0}, normal{0, 0, 1};  ///< normal: unit, on the lit side
  int points = 0;                     ///< number of records; 0 = all within the error
  /// `points` counts the records of least error, not the nearest
  bool by_error = false;
  float accuracy = 1;  ///< maximum error of a record; not used for the nearest
  /// Minimum cosine between the normals of record and point; weights fade towards it.
  float min_cosine = 0.9f;
  /// Scene units. By error: bounds of the records' radii, which replace those they were made with.
  /// Nearest: records farther than max are not used.
  GatherRadii radii;
  bool gradients = true;
  bool directional = false;  ///< fill Gathered::incoming
  /// Receives the irradiance by light layers, `layers` values; the last is for light of unknown
  /// layer. May be null.
  Rgb* by_light = nullptr;
  std::size_t layers = 0;
  bool through_walls = false;  ///< last resort: skip the tests for light leaks
  /// Receives the records used and their weights, whose sum is 1; may be null.
  GatherStencil* stencil = nullptr;

  /// Whether irradiance falls to 0 far from records.
  bool fades() const { return points > 0 && !by_error && radii.max > 0; }
};

struct Gathered {
  Rgb irradiance{0};  ///< as GatherRecord; never negative
  IncomingLight incoming;
  int records = 0;  ///< number of records used
  /// Nearest with a maximum radius: falls to 0 where the nearest record is that far away. Otherwise
  /// 1.
  float fade = 1;
};

/// Irradiance records in an octree.
///
/// Model:   a pass evaluates many points in parallel against the current cache, then inserts the
///          new records in a fixed order. Results depend on the records and their order only, not
///          on the division into batches. Look-ups are const and thread-safe.
///
///          Error-bounded: weight 1 / e - 1 / accuracy with e = distance / radius + sqrt(1 - cosine
///          of the normals), for records with e below `accuracy`. Accuracy 1 uses a record up to
///          its radius.
///          Nearest: of the N + 1 nearest records the weight is (1 - (d / h)^2)^2, where h is the
///          distance of the farthest, so the result is continuous when one record replaces another
///          (N >= 2); by error, the same with errors e in place of distances, times
///          n^2 / (n^2 + (.1 e^2)^2), where n is the mean noise of the records and .1 e^2 the error
///          of interpolation: of exact records the nearer ones count, noisy ones are averaged. In
///          both modes a record fades out as its normal turns away, when it lies in front of the
///          point or far below it, and when something occludes it: these factors divide the
///          distance or error used for selection, and multiply the weight of error-bounded records.
/// Source:  Ward, Rubinstein, Clear, "A Ray Tracing Solution for Diffuse Interreflection", SIGGRAPH
///          1988; Krivanek, Bouatouch, Pattanaik, Zara, "Making Radiance and Irradiance Caching
///          Practical", EGSR 2006 (neighbour clamping).
/// Checked: GatherCache.*
class GatherCache {
 public:
  static constexpr int kMaxPoints = 256;
  /// Relative error that a record may have at its radius; an estimate.
  static constexpr float kErrorAtRadius = 0.1f;

  /// Adds records in order, except unusable ones (see `usable`).
  /// Returns: the number of records added.
  std::size_t insert(std::span<const GatherRecord> records);

  /// Calls the two functions below, in their order. Required after inserting.
  void settle_radii();

  /// Neighbour clamping: no radius is longer than another record's radius plus the distance to it.
  /// This shortens the radius of a record whose rays missed a small object nearby. Required after
  /// inserting.
  void clamp_to_neighbours();

  /// Shortens radii where the irradiance of neighbours differs from the gradient's prediction: at
  /// its radius a record may be wrong by `tolerance`, relative to its irradiance, if errors grow
  /// with the square of the distance. Differences within the noise are ignored. The query applies
  /// the minimum radius. Call after clamping.
  void shorten_by_curvature(float tolerance);

  std::optional<Gathered> interpolate(const GatherQuery& query) const;
  /// Irradiance at the place of an earlier look-up, by its records and weights, with gradients.
  /// `by_light`: see GatherQuery.
  Rgb irradiance(const GatherStencil& from, const Vec3& position, const Vec3& normal,
                 Rgb* by_light = nullptr, std::size_t layers = 0) const;

  bool empty() const { return records_.empty(); }
  /// In the order of insertion, with their original radii.
  const std::vector<GatherRecord>& records() const { return records_; }
  /// The radius after clamping.
  float radius(std::size_t record) const { return radii_[record]; }

  /// Whether all numbers are finite and within bounds, the normal is unit, the irradiance is not
  /// negative and the radius is positive.
  static bool usable(const GatherRecord& record);

 private:
  /// Data of a record that the search tests before it reads the record.
  struct Entry {
    Vec3 position;
    float radius;
    Vec3 normal;
    std::uint32_t record;
  };
  struct Node {
    Vec3 low{3e38f}, high{-3e38f};  ///< bounding box of the positions below
    float reach = 0;                ///< largest radius below
    float least = 3e38f;            ///< smallest unclamped radius below
    std::uint64_t normals = 0;      ///< bits of the normals below, see normal_bit()
    std::uint32_t child = 0;        ///< index of the first of eight; 0 = leaf
    std::vector<Entry> entries;     ///< of a leaf

    float distance2(const Vec3& p) const {
      const float x = std::max(0.0f, std::max(low.x - p.x, p.x - high.x));
      const float y = std::max(0.0f, std::max(low.y - p.y, p.y - high.y));
      const float z = std::max(0.0f, std::max(low.z - p.z, p.z - high.z));
      return x * x + y * y + z * z;
    }
    void include(const Entry& entry, float own_radius);
  };
  /// Eight siblings as arrays, which look-ups test together.
  struct SearchNode {
    static constexpr int kChildren = 8;
    std::array<float, kChildren> low_x, low_y, low_z, high_x, high_y, high_z, reach;
    std::array<std::uint64_t, kChildren> normals;  ///< 0 = empty
    std::array<std::uint32_t, kChildren> first;    ///< SearchNode, or entry of a leaf
    std::array<std::uint32_t, kChildren> entries;  ///< number of a leaf's; 0 = no leaf

    void set(int child, const Node& node);
    std::array<float, kChildren> distances2(const Vec3& p) const;
  };
  struct Near;
  struct Nearest;
  struct Sum;

  /// Bit of the part of the sphere of directions that contains the normal.
  static std::uint64_t normal_bit(const Vec3& normal);
  /// Bits of all parts that contain normals with at least this cosine to `normal`.
  static std::uint64_t normal_bits(const Vec3& normal, float min_cosine);

  void place(const Entry& entry);
  void grow_to(const Vec3& position);
  void split(std::uint32_t node, const Vec3& centre);
  float refit(std::uint32_t node);
  float straight(std::uint32_t node, const GatherRecord& record, float radius,
                 float tolerance) const;
  float clamped(std::uint32_t node, const Vec3& position, float best) const;
  float compatibility(const Entry& entry, const GatherQuery& query) const;
  void flatten();
  void flatten_child(std::uint32_t node, std::uint32_t parent, std::size_t child);
  void bounded(std::uint32_t search_node, const GatherQuery& query, std::uint64_t normals,
               Sum& sum) const;
  void nearest(std::uint32_t search_node, const GatherQuery& query, Nearest& found) const;
  void prefer_exact(const Nearest& found, std::span<float> weights) const;
  void nearest_of_leaf(std::span<const Entry> entries, const GatherQuery& query,
                       Nearest& found) const;

  std::vector<GatherRecord> records_;
  std::vector<float> radii_;              ///< after clamping
  std::vector<Node> nodes_;               ///< the first is the root
  std::vector<SearchNode> search_nodes_;  ///< of all nodes; the first contains the root only
  std::vector<Entry> search_entries_;
  Vec3 centre_{0};
  float half_ = 1;
};

}  // namespace oriel
