// SPDX-License-Identifier: Apache-2.0
// Which objects and materials a pixel sees, and how much of it each covers.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/filter.h"
#include "transport/path/path.h"

namespace oriel {

/// Ranks of Cryptomattes when nobody says how many, and the most that may be asked for.
inline constexpr int kMatteRanks = 6, kMaxMatteRanks = 64;

/// What distinguishes the mattes.
enum class MatteKind : std::uint8_t { Object, Material, Asset };

/// What World does not keep of its instances, one entry for each.
struct MatteNames {
  std::vector<std::string> objects;   ///< see matte_names() in output/matte_layers.h
  std::vector<std::string> assets;    ///< the object element that an instance shows
  std::vector<std::uint32_t> labels;  ///< its `tag`, 0 where none is written
  int depth = kMatteRanks;            ///< ranks that Cryptomatte layers hold; 0: no such layers
};

/// Coverage of pixels by what their samples met first.
///
/// Model:   every path through the camera counts alike: what it met first gets its share, so edges,
///          depth of field, movement and cut-outs (which let paths through by chance) come out as
///          in the picture. Mirrors and glass are themselves what is met. Filtered as the picture
///          is; where a filter with negative lobes takes more than there is, nothing is left, and
///          what is left is scaled to sum to 1.
/// Checked: Mattes.* in mattes_test.cpp
class Mattes {
 public:
  Mattes(int width, int height, const FilterSampler& filter, MatteNames names);

  /// Of one sample of a pixel; different pixels from different threads.
  /// Inputs:  negative: it fell where the filter is.
  void add(int x, int y, std::span<const FirstSurface> seen, bool negative);
  void clear();

  struct Share {
    FirstSurface seen;  ///< no instance: nothing
    float coverage = 0;
  };
  /// What the pixel shows, each pair of instance and material once; sums to 1 from the first sample
  /// on.
  std::vector<Share> shares(int x, int y) const;
  const MatteNames& names() const { return names_; }

  /// Writes or reads the state of some pixels, given by their indices. For checkpoints and for
  /// streams of bytes in memory.
  template <class Writer>
  void save(Writer& out, const std::vector<Material>& materials,
            const std::vector<std::uint32_t>& pixels) const;
  /// Errors:  CheckpointError.
  template <class Reader>
  void restore(Reader& in, const std::vector<Material>& materials, std::size_t instances,
               const std::vector<std::uint32_t>& pixels);

 private:
  struct Entry {
    FirstSurface seen;
    float positive = 0, negative = 0;  ///< samples
  };
  int width_;
  float positive_share_, negative_share_;
  MatteNames names_;
  std::vector<std::vector<Entry>> pixels_;  ///< most see one thing or two
};

}  // namespace oriel
