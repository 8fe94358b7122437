// SPDX-License-Identifier: Apache-2.0
// Where the values of a spectrum stand in the 74 numbers that shaders have of it.
#pragma once

#include <cstdint>

#include "color/spectrum.h"
#include "oriel/sdk/shader/types.h"

namespace oriel::sdk {

// CIE XYZ and a 1, a mark of spectra that were initialised, and the bands.
inline constexpr int kSpectrumMarkAt = 4, kSpectrumBandsAt = 8;
inline constexpr std::uint32_t kSpectrumMark = 0x53504543u;

/// Makes it a valid spectrum of these bands.
void set_spectrum(miSpectrum& s, const Spectrum& bands);

}  // namespace oriel::sdk
