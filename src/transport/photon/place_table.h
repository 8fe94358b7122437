// SPDX-License-Identifier: Apache-2.0
// A table of the nearest places on surfaces, filled by the searches of the first look-ups.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "geom/mesh.h"
#include "sampling/sampler.h"

namespace oriel {

/// Stores the nearest place of each cell of a box: the first look-up in a cell searches for it.
///
/// Model:   cells are cubes, with one answer for each of 54 directions of normals: those of the
///          3 x 3 squares on each side of a cube. The answer is that of the centres of cell and
///          square, so it does not depend on which look-up is first. A hash table stores answers,
///          each in one word; where its neighbourhood is full, look-ups search. Thread-safe.
/// Checked: PlaceTable.*, PhotonMap.CoarseEstimates* in photon_map_test.cpp.
class PlaceTable {
 public:
  PlaceTable() = default;
  /// Inputs:  box: outside of it there are no places. cell: side of a cell, scene units, above 0;
  ///          larger where the box has more than 4096 along an axis. places: their number; from
  ///          2^22 - 1 on nothing is stored.
  PlaceTable(const geom::Box3& box, float cell, std::size_t places) : low_(box.min) {
    const Vec3 size = box.size();
    cell_ = std::max(cell, std::max({size.x, size.y, size.z}) / (kCellsAlongAxis - 1));
    for (int i = 0; i < 3; ++i) last_[i] = std::floor(size[i] / cell_);
    if (places >= kMostPlaces) return;
    lines_ = std::make_unique<Line[]>(kLines);
  }

  std::size_t bytes() const { return lines_ ? kLines * sizeof(Line) : 0; }

  /// The place nearest to a cell and a direction; nothing outside of the box. Inputs:  normal:
  /// unit. search: called with a point and a unit vector, returns an index or nothing.
  template <class Search>
  std::optional<std::uint32_t> find(const Vec3& position, const Vec3& normal,
                                    const Search& search) const {
    std::uint64_t block = 0, corner = 0;
    Vec3 centre(0);
    for (int i = 0; i < 3; ++i) {
      const float place = std::floor((position[i] - low_[i]) / cell_);
      if (!(place >= 0 && place <= last_[i])) return std::nullopt;
      const auto cell = static_cast<std::uint64_t>(place);
      block = block << (kBitsOfCell - 1) | cell >> 1;
      corner = corner << 1 | (cell & 1);
      centre[i] = low_[i] + (place + 0.5f) * cell_;
    }
    const Square square = square_of(normal);
    const auto searched = [&] { return search(centre, normalize(square.centre)); };
    if (!lines_) return searched();
    block = block << kBitsOfSquare | square.index;
    const std::uint64_t key = (block << 3 | corner) << kBitsOfPlace;
    const auto answer = [&] {
      const std::optional<std::uint32_t> found = searched();
      return key | (found ? *found + 1 : 0);
    };
    const auto place_of = [&](std::uint64_t entry) -> std::optional<std::uint32_t> {
      const auto field = static_cast<std::uint32_t>(entry & kMostPlaces);
      return field == 0 ? std::nullopt : std::optional(field - 1);
    };
    const std::uint64_t hash = sampling::mix_bits(block);
    std::optional<std::uint64_t> mine;
    for (std::uint64_t probe = 0; probe < kProbes; ++probe) {
      std::atomic<std::uint64_t>& slot = lines_[(hash + probe) & (kLines - 1)].entries[corner];
      std::uint64_t entry = slot.load(std::memory_order_relaxed);
      if (entry == 0) {
        if (!mine) mine = answer();
        if (slot.compare_exchange_strong(entry, *mine, std::memory_order_relaxed))
          return place_of(*mine);
      }
      if ((entry ^ key) <= kMostPlaces) return place_of(entry);
    }
    return place_of(mine ? *mine : answer());
  }

 private:
  static constexpr int kBitsOfCell = 12, kBitsOfSquare = 6, kBitsOfPlace = 22;
  static constexpr std::uint64_t kCellsAlongAxis = 1u << kBitsOfCell;
  static constexpr std::uint64_t kMostPlaces = (1u << kBitsOfPlace) - 1;
  static constexpr std::size_t kProbes = 8, kLines = 1u << 18;

  /// Eight cells that have a corner in common: one line of the processor's cache.
  struct alignas(64) Line {
    std::array<std::atomic<std::uint64_t>, 8> entries;
  };

  struct Square {
    std::uint64_t index;  ///< 1 to 54, so that no entry is 0
    Vec3 centre;          ///< on the cube from -1 to 1
  };
  static Square square_of(const Vec3& normal) {
    const Vec3 size(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const bool negative = normal[axis] < 0;
    Vec3 centre(0);
    centre[axis] = negative ? -1.0f : 1.0f;
    int index = 2 * axis + (negative ? 1 : 0);
    for (int side = 1; side < 3; ++side) {
      const int other = (axis + side) % 3;
      const float place = normal[other] / size[axis];  // -1 to 1
      const int third = place < -1.0f / 3 ? 0 : place > 1.0f / 3 ? 2 : 1;
      index = 3 * index + third;
      centre[other] = static_cast<float>(third - 1) * (2.0f / 3);
    }
    return {static_cast<std::uint64_t>(index + 1), centre};
  }

  Vec3 low_{0}, last_{-1};  // last_: of the cells along each axis
  float cell_ = 1;
  std::unique_ptr<Line[]> lines_;
};

}  // namespace oriel
