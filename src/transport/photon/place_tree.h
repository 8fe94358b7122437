// SPDX-License-Identifier: Apache-2.0
// A balanced tree of places on surfaces, for searches of the nearest ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geom/mesh.h"

namespace oriel {

/// Places in a balanced tree. Immutable, so any thread may search.
///
/// Model:   of each range the middle place is the node, and the places before and after it are its
///          two halves. The distance along the normal counts kFlattening times: a disc on the
///          surface, not a ball. Places of surfaces that face elsewhere are not found.
/// Inputs:  Place has `position` and `normal`, world space, unit.
/// Source:  Jensen, "Realistic Image Synthesis Using Photon Mapping", 2001, ch. 6.
/// Checked: PhotonMap.* in photon_map_test.cpp.
template <class Place>
class PlaceTree {
 public:
  static constexpr float kFlattening = 3;
  /// Least cosine between the normals of a place and of the point that asks. A guess that keeps
  /// edges of 90 degrees apart and curved surfaces whole.
  static constexpr float kMinAgreement = 0.5f;

  PlaceTree() = default;
  explicit PlaceTree(std::vector<Place> places) : places_(std::move(places)) {
    axis_.resize(places_.size());
    balance(0, places_.size());
  }

  const std::vector<Place>& places() const { return places_; }
  std::vector<Place>& places() { return places_; }
  std::size_t bytes() const { return places_.size() * (sizeof(Place) + 1); }

  /// Writes the tree to a CheckpointWriter, or reads it from a CheckpointReader.
  template <class Checkpoint>
  void visit_state(Checkpoint& checkpoint) {
    checkpoint.list(places_);
    checkpoint.list(axis_);
  }
  /// Of a tree that was read.
  bool is_valid() const {
    return axis_.size() == places_.size() &&
           std::all_of(axis_.begin(), axis_.end(), [](std::uint8_t axis) { return axis < 3; });
  }

  /// Calls nearest.add(squared distance, index) for places closer than nearest.reach2(), which may
  /// decrease meanwhile.
  template <class Nearest>
  void find(const Vec3& position, const Vec3& normal, Nearest& nearest) const;

 private:
  /// Ranges shorter than this are searched one by one, without an axis.
  static constexpr std::size_t kPlacesOfLeaf = 4;

  void balance(std::size_t begin, std::size_t end);

  std::vector<Place> places_;
  std::vector<std::uint8_t> axis_;
};

template <class Place>
void PlaceTree<Place>::balance(std::size_t begin, std::size_t end) {
  while (end - begin > kPlacesOfLeaf) {
    geom::Box3 box;
    for (std::size_t i = begin; i < end; ++i) box.extendBy(places_[i].position);
    const Vec3 size = box.size();
    const std::uint8_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return places_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](const Place& a, const Place& b) {
      return a.position[axis] < b.position[axis];
    });
    axis_[middle] = axis;
    balance(begin, middle);
    begin = middle + 1;
  }
}

template <class Place>
template <class Nearest>
void PlaceTree<Place>::find(const Vec3& position, const Vec3& normal, Nearest& nearest) const {
  const auto visit = [&](std::size_t i) {
    const Place& place = places_[i];
    const Vec3 d = place.position - position;
    const float distance2 = dot(d, d) + (sqr(kFlattening) - 1) * sqr(dot(d, normal));
    if (distance2 >= nearest.reach2() || dot(place.normal, normal) < kMinAgreement) return;
    nearest.add(distance2, static_cast<std::uint32_t>(i));
  };

  // Depth first, the near half first; the far half waits with the distance of its plane.
  struct Range {
    std::size_t begin, end;
    float plane2;
  } waiting[64];
  int count = 0;
  waiting[count++] = {0, places_.size(), 0};
  while (count > 0) {
    Range range = waiting[--count];
    if (range.plane2 >= nearest.reach2()) continue;
    while (range.end - range.begin > kPlacesOfLeaf) {
      const std::size_t middle = range.begin + (range.end - range.begin) / 2;
      const float to_plane = position[axis_[middle]] - places_[middle].position[axis_[middle]];
      Range far{middle + 1, range.end, sqr(to_plane)};
      if (to_plane < 0) {
        range.end = middle;
      } else {
        far = {range.begin, middle, sqr(to_plane)};
        range.begin = middle + 1;
      }
      if (far.plane2 < nearest.reach2()) {
        visit(middle);
        waiting[count++] = far;
      }
    }
    for (std::size_t i = range.begin; i < range.end; ++i) visit(i);
  }
}

}  // namespace oriel
