// SPDX-License-Identifier: Apache-2.0
// Spectra of 31 bands: of lamps and of colours, and their colours.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "base/vec.h"

namespace oriel {

// Conventions
//   Band i is 10 nm wide around 400 + 10 i nm. A flat spectrum of 1 has luminance Y = 1.

inline constexpr int kSpectrumBands = 31;
inline constexpr float kSpectrumFirstNm = 400, kSpectrumStepNm = 10;
using Spectrum = std::array<float, kSpectrumBands>;

/// CIE 1931 XYZ: means over the matching functions, divided by that of y.
/// Checked: Spectrum.*
Vec3 spectrum_xyz(const Spectrum& spectrum);

/// The spectrum of that XYZ whose neighbouring bands differ least, by the sum of squares. Linear in
/// its argument; saturated colours have negative bands.
/// Source:  S. A. Burns, "Numerical methods for smoothest reflectance reconstruction", Color
///          Research and Application 45(1), 2020, section 2 (least slope squared).
/// Checked: Spectrum.SmoothSpectraHaveTheirColour
Spectrum smooth_spectrum(const Vec3& xyz);

/// Planck's law relative to its value at 560 nm; kelvin > 0.
Spectrum black_body_spectrum(float kelvin);

/// The CIE's phase of daylight, 100 at 560 nm.
///
/// Inputs:  kelvin: 4000 ... 25000; what lies outside is taken as the end of the range.
/// Source:  CIE 15:2004, section 3.1 and table T.2.
/// Checked: Spectrum.DaylightIsTheTableOfD65
Spectrum daylight_spectrum(float kelvin);

/// Index of the band that contains a wavelength; -1 outside of all bands.
/// Checked: Spectrum.BandsAreCentredOnTheirWavelengths
int spectrum_band(float nm);

/// The spectrum scaled to a luminance Y; black where it has none.
/// Checked: Spectrum.ScalingSetsTheLuminance
Spectrum with_luminance(Spectrum spectrum, float luminance);

/// A standard illuminant of the CIE: "A", "D50", "D55", "D65", "D75" or "E"; null if unknown.
/// Source:  CIE 15:2004, section 3.1.
/// Checked: Spectrum.IlluminantsAreThoseOfTheCie
std::optional<Spectrum> cie_illuminant(std::string_view name);

}  // namespace oriel
