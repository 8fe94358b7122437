// SPDX-License-Identifier: Apache-2.0
// How many rays were traced, by why.
#pragma once

#include <cstdint>

namespace oriel {

struct RayCounts {
  std::uint64_t eye = 0, reflect = 0, refract = 0, gather = 0, shadow = 0, probe = 0;
  std::uint64_t environment = 0;  ///< look-ups

  std::uint64_t rays() const { return eye + reflect + refract + gather + shadow + probe; }
  RayCounts& operator+=(const RayCounts& o) {
    eye += o.eye;
    reflect += o.reflect;
    refract += o.refract;
    gather += o.gather;
    shadow += o.shadow;
    probe += o.probe;
    environment += o.environment;
    return *this;
  }
};

/// Writes the numbers to a stream or checkpoint, or reads them. Counts: RayCounts, constant or not.
template <class Stream, class Counts>
void visit_counts(Stream& stream, Counts& counts) {
  for (auto* count : {&counts.eye, &counts.reflect, &counts.refract, &counts.gather, &counts.shadow,
                      &counts.probe, &counts.environment})
    stream.value(*count);
}

}  // namespace oriel
