// SPDX-License-Identifier: Apache-2.0
// Colours of 32 bits with a shared exponent.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"

namespace oriel {

/// Three mantissas of 8 bits and an exponent biased by 128; all 0 is black.
/// Source:  Ward, "Real Pixels", Graphics Gems II, 1991.
using Rgbe = std::array<std::uint8_t, 4>;

/// Negative channels and colours below the smallest normal float become 0; large values are clamped
/// to 1e38. Checked: RgbeTest.*
Rgbe encode_rgbe(const Rgb& color);
/// Returns the centre of the quantisation interval.
Rgb decode_rgbe(const Rgbe& code);

}  // namespace oriel
