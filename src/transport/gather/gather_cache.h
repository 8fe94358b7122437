// SPDX-License-Identifier: Apache-2.0
// The irradiance cache: which stored points speak for a surface point, and what they say together.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "transport/gather/gather_record.h"

namespace oriel {

/// A question to the cache.
struct GatherQuery {
  Vec3 position{0}, normal{0, 0, 1};  ///< normal unit, on the side that is lit
  int points = 0;                     ///< above 0: so many records; 0: all within the error
  bool by_error = false;              ///< of `points`: those of least error, not the nearest
  float accuracy = 1;                 ///< largest error a record may have; not for the nearest
  /// Records whose normals differ by more than this cosine are not used; their weight fades before.
  float min_cosine = 0.9f;
  /// Scene units. By error: the records' radii are kept within, in place of those they were made
  /// with where narrower or wider. Nearest: records farther than max are not used.
  GatherRadii radii;
  bool gradients = true;
  bool directional = false;  ///< fill Gathered::incoming
  /// Where to add the irradiance by layers of lights, `layers` of them, the last for what does not
  /// know its own; null = nowhere.
  Rgb* by_light = nullptr;
  std::size_t layers = 0;
  bool through_walls = false;  ///< last resort: leave out the tests against leaking

  /// Whether there is nothing but black far from records.
  bool fades() const { return points > 0 && !by_error && radii.max > 0; }
};

struct Gathered {
  Rgb irradiance{0};  ///< as GatherRecord; never negative
  IncomingLight incoming;
  int records = 0;  ///< how many spoke
  /// Nearest with a max radius: falls to 0 where the nearest record reaches it. Else 1.
  float fade = 1;
};

/// Records in an octree of points.
///
/// Model:   a pass evaluates many points in parallel against the cache as it stands and inserts
///          what it made in a fixed order. Answers depend on the records and their order alone, not
///          on how they were split into batches. Look-ups are const and may run in parallel.
///
///          Error-bounded: weight 1 / e - 1 / accuracy with e = distance / radius + sqrt(1 -
///          cosine of the normals), for records with e below `accuracy`. So accuracy 1 uses a
///          record up to its radius. Nearest: of the N + 1 nearest the weight is (1 - (d / h)^2)^2,
///          h the farthest's distance, so nothing jumps when one takes another's place (for N of
///          at least 2); the same with errors in place of distances. In all a record fades out as
///          its normal turns away, when it lies in front of the point or far below it, and when
///          something stands between: the tests' factors divide the distance or error that picks
///          and multiply the weight of the error-bounded.
/// Source:  Ward, Rubinstein, Clear, "A Ray Tracing Solution for Diffuse Interreflection", SIGGRAPH
///          1988; Krivanek, Bouatouch, Pattanaik, Zara, "Making Radiance and Irradiance Caching
///          Practical", EGSR 2006 (neighbour clamping).
/// Checked: GatherCache.*
class GatherCache {
 public:
  static constexpr int kMaxPoints = 256;

  /// Adds records in order. Those that are not usable (see `usable`) are left out.
  /// Returns: how many were added.
  std::size_t insert(std::span<const GatherRecord> records);

  /// Both of what follows, in their order. Call when records were inserted.
  void settle_radii();

  /// Neighbour clamping: no radius longer than another record's plus the distance to it. A record
  /// whose rays missed a small thing nearby so learns of it. Call after inserting.
  void clamp_to_neighbours();

  /// Shortens radii where neighbours gathered something else than the gradient predicts: at its
  /// radius a record may be wrong by `tolerance`, a share of its irradiance, if errors grow with
  /// the square of the distance. What noise explains does not count; the least radius is the
  /// query's affair. Call after clamping.
  void shorten_by_curvature(float tolerance);

  std::optional<Gathered> interpolate(const GatherQuery& query) const;

  bool empty() const { return records_.empty(); }
  /// In the order of insertion, with the radii they were made with.
  const std::vector<GatherRecord>& records() const { return records_; }
  /// After clamping.
  float radius(std::size_t record) const { return radii_[record]; }

  /// All numbers finite and within bounds, normal unit, irradiance not negative, radius positive.
  static bool usable(const GatherRecord& record);

 private:
  /// What the search looks at before it opens a record.
  struct Entry {
    Vec3 position;
    float radius;
    Vec3 normal;
    std::uint32_t record;
  };
  struct Node {
    Vec3 low{3e38f}, high{-3e38f};  ///< box of the positions below
    float reach = 0;                ///< largest radius below
    float least = 3e38f;            ///< smallest unclamped radius below
    std::uint32_t child = 0;        ///< first of eight; 0 = leaf
    std::vector<Entry> entries;     ///< of a leaf

    float distance2(const Vec3& p) const {
      const float x = std::max(0.0f, std::max(low.x - p.x, p.x - high.x));
      const float y = std::max(0.0f, std::max(low.y - p.y, p.y - high.y));
      const float z = std::max(0.0f, std::max(low.z - p.z, p.z - high.z));
      return x * x + y * y + z * z;
    }
    void include(const Entry& entry, float own_radius);
  };
  struct Near;
  struct Nearest;
  struct Sum;

  void place(const Entry& entry);
  void grow_to(const Vec3& position);
  void split(std::uint32_t node, const Vec3& centre);
  float refit(std::uint32_t node);
  float straight(std::uint32_t node, const GatherRecord& record, float radius,
                 float tolerance) const;
  float clamped(std::uint32_t node, const Vec3& position, float best) const;
  float compatibility(const Entry& entry, const GatherQuery& query) const;
  void bounded(std::uint32_t node, const GatherQuery& query, Sum& sum) const;
  void nearest(std::uint32_t node, const GatherQuery& query, Nearest& found) const;

  std::vector<GatherRecord> records_;
  std::vector<float> radii_;  ///< clamped
  std::vector<Node> nodes_;   ///< the first is the root
  Vec3 centre_{0};
  float half_ = 1;
};

}  // namespace oriel
