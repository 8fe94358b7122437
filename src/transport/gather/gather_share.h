// SPDX-License-Identifier: Apache-2.0
// Which strata of a hemisphere deserve more gather rays.
#pragma once

#include <span>
#include <vector>

#include "transport/gather/gather_record.h"

namespace oriel {

/// How many rays of `more` each stratum gets beside its first one: those with contrast about them.
///
/// Model:   strata alternate like the squares of a chessboard, and one is judged by its four
///          neighbours alone, which are of the other colour, each colour having half of the rays.
///          So what a stratum's own rays found has no say in how many it gets, and the mean of them
///          stays unbiased. Rays go by the difference of the neighbours' brightness: about where
///          the rays of a stratum differ. Strata among equal ones get none, and a hemisphere
///          without contrast spends fewer rays than it may.
/// Inputs:  samples: as make_gather_record; sectors: even.
/// Checked: GatherShare.*
std::vector<int> share_rays(std::span<const GatherSample> samples, int rings, int sectors,
                            int more);

}  // namespace oriel
