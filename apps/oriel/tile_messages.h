// SPDX-License-Identifier: Apache-2.0
// Messages about tiles between the ranks that render a picture.
#pragma once

#include <cstdint>
#include <vector>

#include "transport/counts.h"

namespace oriel::app {

/// The beginning of a message. Targets of the held tiles and pixels of the others follow.
struct TilesHead {
  std::int32_t picture = 0;
  std::vector<int> held;   ///< tiles whose pixels the receiver has
  std::vector<int> tiles;  ///< other tiles
  RayCounts rays;

  template <class Stream>
  void visit(Stream& stream) {
    stream.value(picture);
    stream.list(held);
    stream.list(tiles);
    visit_counts(stream, rays);
  }
};

}  // namespace oriel::app
