// SPDX-License-Identifier: Apache-2.0
// Layout of a spectrum in the 74 numbers of miSpectrum.
#pragma once

#include <cstdint>

#include "color/spectrum.h"
#include "oriel/sdk/shader/types.h"

namespace oriel::sdk {

// CIE XYZ and 1, a marker of initialised spectra, and the bands.
inline constexpr int kSpectrumMarkAt = 4, kSpectrumBandsAt = 8;
inline constexpr std::uint32_t kSpectrumMark = 0x53504543u;

/// Initialises a spectrum with these bands.
void set_spectrum(miSpectrum& s, const Spectrum& bands);

}  // namespace oriel::sdk
