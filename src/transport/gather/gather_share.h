// SPDX-License-Identifier: Apache-2.0
// Distribution of further gather rays over the strata of a hemisphere.
#pragma once

#include <span>
#include <vector>

#include "transport/gather/gather_record.h"

namespace oriel {

/// Number of the `more` rays that each stratum gets beside its first one, by local contrast.
///
/// Model:   strata alternate like the squares of a chessboard. The number of rays of a stratum
///          depends on its four neighbours only, which are of the other colour; each colour gets
///          half of the rays. The number is thus independent of the stratum's own rays, and their
///          mean is unbiased. Rays are distributed by the difference of the neighbours' brightness,
///          which approximates the variation within the stratum. Strata among equal ones get none,
///          and a hemisphere without contrast uses fewer rays than permitted.
/// Inputs:  samples: as make_gather_record; sectors: even.
/// Checked: GatherShare.*
std::vector<int> share_rays(std::span<const GatherSample> samples, int rings, int sectors,
                            int more);

}  // namespace oriel
