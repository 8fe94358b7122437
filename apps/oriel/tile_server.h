// SPDX-License-Identifier: Apache-2.0
// A rank that renders tiles for rank 0.
#pragma once

#include "ranks.h"
#include "render/session.h"

namespace oriel::app {

/// Renders tiles for rank 0 until the picture ends.
///
/// Model:   one thread exchanges messages while the others draw. Portions overlap, so that no
///          thread waits for the last tile of one; each is sent back when all its tiles are drawn.
/// Checked: Mpi.* in tests/faults
void serve_tiles(Ranks& ranks, RenderSession& session);

}  // namespace oriel::app
