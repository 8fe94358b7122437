// SPDX-License-Identifier: Apache-2.0
// What paths read of coarse records, kept apart from the rest of their light.
#pragma once

#include <vector>

#include "transport/gather/gather_cache.h"

namespace oriel {

/// The look-ups of a path. Its radiance is that of its record plus, for each read, the factor times
/// the irradiance of the records.
struct BounceReads {
  struct Read {
    GatherStencil records;
    Vec3 position{0}, normal{0, 0, 1};
    Rgb factor{1};
  };
  std::vector<Read> of;
  /// False: other light of the path depends on the records too.
  bool complete = true;

  /// Multiplies the reads from `first` on.
  void scale(std::size_t first, const Rgb& factor) {
    for (std::size_t i = first; i < of.size(); ++i) of[i].factor *= factor;
  }
};

}  // namespace oriel
