// SPDX-License-Identifier: Apache-2.0
// Caches of indirect light in checkpoints.
#pragma once

#include "base/checkpoint_file.h"
#include "transport/gather/gather_cache.h"

namespace oriel {

/// Writes the records of a cache.
void save_cache(CheckpointWriter& out, const GatherCache& cache);

/// A cache with the records of save_cache(), equal to that one.
/// Errors:  CheckpointError.
/// Checked: SessionState.*
GatherCache restore_cache(CheckpointReader& in);

}  // namespace oriel
