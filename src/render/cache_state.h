// SPDX-License-Identifier: Apache-2.0
// Caches of indirect light in checkpoints and messages.
#pragma once

#include "transport/gather/gather_cache.h"
#include "transport/gather/record_state.h"

namespace oriel {

/// Writes the records of a cache to a CheckpointWriter or ByteWriter.
template <class Out>
void save_cache(Out& out, const GatherCache& cache) {
  save_records(out, cache.records());
}

/// A cache with the records of save_cache(), equal to that one.
/// Errors:  CheckpointError.
/// Checked: SessionState.*
template <class In>
GatherCache restore_cache(In& in) {
  const std::vector<GatherRecord> records = restore_records(in);
  GatherCache cache;
  if (cache.insert(records) != records.size())
    throw CheckpointError("its gather points are invalid");
  cache.settle_radii();
  return cache;
}

}  // namespace oriel
