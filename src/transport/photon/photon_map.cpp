// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/photon_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "base/math.h"
#include "base/parallel.h"
#include "sampling/sampler.h"
#include "transport/photon/photon_merge.h"

namespace oriel {
namespace {

using Filter = scene::PhotonOptions::Filter;

/// Unit vectors may be this much off after rounding.
constexpr float kUnitError = 1e-2f;

/// The numbers of a photon as bits, since floats have two zeros.
std::array<std::uint32_t, 13> bits(const Photon& p) {
  std::array<std::uint32_t, 13> out{};
  out[12] = p.layer;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    out[at] = std::bit_cast<std::uint32_t>(p.position[i]);
    out[3 + at] = std::bit_cast<std::uint32_t>(p.direction[i]);
    out[6 + at] = std::bit_cast<std::uint32_t>(p.power[i]);
    out[9 + at] = std::bit_cast<std::uint32_t>(p.normal[i]);
  }
  return out;
}

/// Any order that depends on nothing but the photons.
bool precedes(const Photon& a, const Photon& b) { return bits(a) < bits(b); }

bool is_sound(const Photon& p) {
  return is_finite(p.position) && is_finite(p.direction) && is_finite(p.power) &&
         is_finite(p.normal);
}

/// Weight by squared distance over squared radius, of mean 1 over the disc.
class FilterWeight {
 public:
  explicit FilterWeight(const PhotonLookup& lookup) : filter_(lookup.filter) {
    if (filter_ == Filter::Cone) {
      inverse_constant_ = 1 / std::max(1.0f, lookup.filter_constant);
      norm_ = 1 / (1 - inverse_constant_ * (2 / 3.0f));
    } else if (filter_ == Filter::Gauss) {
      norm_ = 1 / (1 - (1 - (1 - math::exp(-kBeta / 2)) / (kBeta / 2)) / (1 - math::exp(-kBeta)));
    }
  }
  float operator()(float share) const {
    if (filter_ == Filter::Cone) return norm_ * (1 - std::sqrt(share) * inverse_constant_);
    if (filter_ == Filter::Gauss)
      return norm_ * (1 - (1 - math::exp(-share * (kBeta / 2))) / (1 - math::exp(-kBeta)));
    return 1;
  }

 private:
  /// Source: Jensen 2001, eq. 7.9, after Pavicic, "Convenient Anti-Aliasing Filters that Minimize
  ///         Bumpy Sampling", Graphics Gems, 1990. Its other factor is replaced by the exact norm.
  static constexpr float kBeta = 1.953f;
  Filter filter_;
  float inverse_constant_ = 1, norm_ = 1;
};

struct Found {
  float distance2;
  std::uint32_t index;
  bool operator<(const Found& o) const { return distance2 < o.distance2; }
};

/// The nearest `most` photons so far, the farthest on top.
class Nearest {
 public:
  Nearest(int most, float radius) : most_(most), reach2_(sqr(radius)) {}
  float reach2() const { return reach2_; }
  int count() const { return count_; }
  bool is_full() const { return count_ == most_; }
  const Found& operator[](int i) const { return heap_[i]; }

  void add(float distance2, std::uint32_t index) {
    if (is_full()) {
      std::pop_heap(heap_, heap_ + count_);
      heap_[count_ - 1] = {distance2, index};
    } else {
      heap_[count_++] = {distance2, index};
    }
    std::push_heap(heap_, heap_ + count_);
    if (is_full()) reach2_ = heap_[0].distance2;
  }

 private:
  int most_, count_ = 0;
  float reach2_;
  Found heap_[PhotonMap::kMaxCount + 1];  // only the first count_ are set
};

/// Half of the photons, chosen at random, are places of estimates by the other half: places where
/// photons lie apart have a larger neighbourhood, so that estimates by the same photons would be
/// some percent too dark.
bool is_place(std::size_t photon) { return (sampling::mix_bits(photon + 1) & 1) != 0; }

/// The nearest photons that are no places.
class NearestOthers : public Nearest {
 public:
  using Nearest::Nearest;
  void add(float distance2, std::uint32_t index) {
    if (!is_place(index)) Nearest::add(distance2, index);
  }
};

/// The nearest one.
class NearestPlace {
 public:
  explicit NearestPlace(float radius) : reach2_(sqr(radius)) {}
  float reach2() const { return reach2_; }
  void add(float distance2, std::uint32_t index) { reach2_ = distance2, index_ = index; }
  std::optional<std::uint32_t> found() const { return index_; }

 private:
  float reach2_;
  std::optional<std::uint32_t> index_;
};

}  // namespace

float default_photon_radius(const geom::Box3& scene, PhotonKind kind) {
  if (scene.isEmpty()) return 1;
  const float extent = length(scene.max - scene.min);
  return kind == PhotonKind::Global ? extent / 10 : extent / 2 / 100;
}

PhotonLookup photon_lookup(const scene::PhotonOptions& options, const geom::Box3& scene,
                           PhotonKind kind) {
  return {.count = options.accuracy,
          .radius = options.radius > 0 ? options.radius : default_photon_radius(scene, kind),
          .filter = options.filter,
          .filter_constant = options.filter_constant,
          .scale = rgb(options.scale)};
}

PhotonMap::PhotonMap(std::vector<Photon> photons, float merge) {
  std::erase_if(photons, [](const Photon& p) { return !is_sound(p); });
  std::sort(photons.begin(), photons.end(), precedes);
  if (merge > 0) photons = merge_photons(photons, merge, kMinAgreement);
  tree_ = PlaceTree<Photon>(std::move(photons));
}

bool PhotonMap::is_valid() const {
  const auto is_unit = [](const Vec3& v) { return std::abs(v.length2() - 1) < kUnitError; };
  return tree_.is_valid() && (near_wall_.empty() || near_wall_.size() == size()) &&
         std::all_of(photons().begin(), photons().end(), [&](const Photon& p) {
           return is_sound(p) && is_unit(p.direction) && is_unit(p.normal);
         });
}

float PhotonMap::extent() const {
  if (empty()) return 0;
  constexpr double kLeftOut = 0.05;
  const auto first = static_cast<std::size_t>(kLeftOut * static_cast<double>(size()));
  Vec3 extent(0);
  std::vector<float> places(size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(photons().begin(), photons().end(), places.begin(),
                   [axis](const Photon& p) { return p.position[axis]; });
    const auto at = [&](std::size_t i) { return places.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t last = size() - 1 - first;
    std::nth_element(places.begin(), at(first), places.end());
    const float low = places[first];
    std::nth_element(at(first), at(last), places.end());
    extent[axis] = places[last] - low;
  }
  return length(extent) / static_cast<float>(1 - 2 * kLeftOut);
}

float PhotonMap::radius(const Vec3& position, const Vec3& normal,
                        const PhotonLookup& lookup) const {
  if (empty() || !(lookup.radius > 0)) return 0;
  Nearest nearest(std::clamp(lookup.count, 1, kMaxCount) + 1, lookup.radius);
  tree_.find(position, normal, nearest);
  return nearest.is_full() ? std::sqrt(nearest.reach2()) : lookup.radius;
}

void PhotonMap::estimate_at_places(const PhotonLookup& lookup) {
  if (!(lookup.radius > 0)) return;
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = 0; i < size(); ++i)
    if (is_place(i)) chosen.push_back(i);
  std::vector<Estimate> estimates(chosen.size());
  const int count = std::clamp(lookup.count / 2, 1, kMaxCount) + 1;
  constexpr std::size_t kBlock = 256;
  parallel_for_blocks(chosen.size(), kBlock, [&](std::size_t i) {
    const Photon& photon = photons()[chosen[i]];
    NearestOthers nearest(count, lookup.radius);
    tree_.find(photon.position, photon.normal, nearest);
    const float radius2 = nearest.is_full() ? nearest.reach2() : sqr(lookup.radius);
    Rgb sum(0);
    for (int k = nearest.is_full() ? 1 : 0; k < nearest.count(); ++k)
      sum += photons()[nearest[k].index].power * 2.0f;
    estimates[i] = {photon.position, photon.normal, Rgb(0)};
    if (radius2 > 0) estimates[i].irradiance = lookup.scale * sum * (1 / (kPi * radius2));
  });
  geom::Box3 box;
  for (const Estimate& estimate : estimates) box.extendBy(estimate.position);
  const Vec3 reach(kReachOfEstimates * lookup.radius);
  nearest_ = box.isEmpty() ? PlaceTable()
                           : PlaceTable({box.min - reach, box.max + reach},
                                        kCellOfEstimates * lookup.radius, estimates.size());
  estimates_ = PlaceTree<Estimate>(std::move(estimates));
}

Rgb PhotonMap::coarse_irradiance(const Vec3& position, const Vec3& normal,
                                 const PhotonLookup& lookup) const {
  const auto found = nearest_.find(position, normal, [&](const Vec3& centre, const Vec3& facing) {
    NearestPlace nearest(kReachOfEstimates * lookup.radius);
    estimates_.find(centre, facing, nearest);
    return nearest.found();
  });
  return found ? estimates_.places()[*found].irradiance : Rgb(0);
}

Rgb PhotonMap::irradiance(const Vec3& position, const Vec3& normal, const PhotonLookup& lookup,
                          Rgb* by_light, std::size_t unknown, int* found) const {
  if (empty() || !(lookup.radius > 0)) return Rgb(0);
  Nearest nearest(std::clamp(lookup.count, 1, kMaxCount) + 1, lookup.radius);
  tree_.find(position, normal, nearest);

  const float radius2 = nearest.is_full() ? nearest.reach2() : sqr(lookup.radius);
  if (!(radius2 > 0)) return Rgb(0);
  const FilterWeight weight(lookup);
  const Vec3 above = normal * (kWayHeight * std::sqrt(radius2));
  const Rgb scale = lookup.scale * (1 / (kPi * radius2));
  Rgb sum(0);
  if (found) *found += nearest.count() - (nearest.is_full() ? 1 : 0);
  for (int i = nearest.is_full() ? 1 : 0; i < nearest.count(); ++i) {
    const Photon& photon = photons()[nearest[i].index];
    if (lookup.walls_of && !near_wall_.empty() && near_wall_[nearest[i].index] != 0 &&
        is_walled_off(*lookup.walls_of, photon.position + above, position + above))
      continue;
    const Rgb power = photon.power * weight(nearest[i].distance2 / radius2);
    sum += power;
    if (by_light) by_light[std::min<std::size_t>(photon.layer, unknown)] += power * scale;
  }
  return lookup.scale * sum * (1 / (kPi * radius2));
}

}  // namespace oriel
