// SPDX-License-Identifier: Apache-2.0
// Where the search for chains starts at each place: the chains of nearby photons.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "transport/counts.h"
#include "transport/photon/photon_chain.h"
#include "transport/progress_monitor.h"

namespace oriel {

/// A chain near to a place.
struct ChainStart {
  ChainKind kind;
  Vec3 towards{0};  ///< the first interface of the chain, as counted from the receiver
};

/// Grids of starts. Immutable, so any thread may ask.
///
/// Model:   cells of kLevels sizes, each twice as large as those before. A place uses the smallest
///          of its cells with at least kEnough photons. Photons in such cells do not count in
///          larger ones; the largest cells need one photon. A photon of a cell gives a start if the
///          search does not find its chain from the starts that the cell already has, so cells
///          where all starts would lead to one solution have one start.
class ChainStarts {
 public:
  static constexpr int kLevels = 4;
  static constexpr std::size_t kMostStarts = 6;

  ChainStarts() = default;
  /// Concentration of the chain of a photon, if the search finds it from these starts at the
  /// photon's place; otherwise 0.
  using Finds = std::function<float(std::span<const ChainStart>, const ChainPhoton&, RayCounts&)>;
  /// Share of the caustics in the light at a photon's place, if they bring the given irradiance.
  using ShareOfLight = std::function<float(const ChainPhoton&, float irradiance, RayCounts&)>;
  /// Inputs:  photons: those that may give starts; low: lower corner of the scene; size: of the
  ///          smallest cells, scene units.
  ChainStarts(const std::vector<const ChainPhoton*>& photons, const Finds& finds,
              const ShareOfLight& share_of_light, const Vec3& low, float size, RayCounts& counts,
              const ProgressMonitor& monitor);

  bool empty() const { return starts_.empty(); }
  struct Found {
    std::span<const ChainStart> starts;
    float chance = 0;  ///< probability with which a vertex searches, above 0 if there are starts
    /// Largest concentration of chains: spikes much higher than the mean of a cell are noise.
    float limit = 0;
  };
  Found at(const Vec3& position) const;
  std::size_t bytes() const {
    return cells_.size() * sizeof(Cell) + starts_.size() * sizeof(ChainStart) +
           table_.size() * sizeof(std::uint32_t);
  }

  /// Writes the starts to a CheckpointWriter, or reads them.
  template <class Checkpoint>
  void visit_state(Checkpoint& checkpoint) {
    for (int k = 0; k < 3; ++k) checkpoint.value(low_[k]);
    checkpoint.value(size_);
    checkpoint.list(cells_);
    checkpoint.list(starts_);
    make_table();
  }
  /// Of starts that were read: indices are within their ranges.
  bool is_valid(std::size_t lights, std::size_t instances) const;

 private:
  struct Cell {
    std::uint64_t key = 0;
    std::uint32_t first = 0;
    std::uint16_t count = 0;
    std::uint16_t chance = 0;  ///< in 65535ths
    float limit = 0;
    std::uint32_t unused = 0;  ///< all bytes of checkpoints are determined
  };
  static constexpr float kCertain = 65535;
  std::uint64_t key_of(const Vec3& position, int level) const;
  const Cell* find(std::uint64_t key) const;
  void make_table();

  Vec3 low_{0};
  float size_ = 1;
  std::vector<Cell> cells_;
  std::vector<ChainStart> starts_;
  std::vector<std::uint32_t> table_;  // of cells_ by hashed key; index + 1, 0 = free
};

}  // namespace oriel
