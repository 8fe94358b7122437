// SPDX-License-Identifier: Apache-2.0
// Spectra of 31 bands: illuminants, reflectances, and conversion to and from colours.
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

/// The smoothest spectrum of an XYZ colour: minimises the sum of squared differences of
/// neighbouring bands. Linear in its argument; saturated colours have negative bands.
/// Source:  S. A. Burns, "Numerical methods for smoothest reflectance reconstruction", Color
///          Research and Application 45(1), 2020, section 2 (least slope squared).
/// Checked: Spectrum.SmoothSpectraHaveTheirColour
Spectrum smooth_spectrum(const Vec3& xyz);

/// Planck's law relative to its value at 560 nm; kelvin > 0.
Spectrum black_body_spectrum(float kelvin);

/// CIE daylight, 100 at 560 nm.
///
/// Inputs:  kelvin: clamped to 4000 ... 25000.
/// Source:  CIE 15:2004, section 3.1 and table T.2.
/// Checked: Spectrum.DaylightIsTheTableOfD65
Spectrum daylight_spectrum(float kelvin);

/// Index of the band that contains a wavelength; -1 outside of all bands.
/// Checked: Spectrum.BandsAreCentredOnTheirWavelengths
int spectrum_band(float nm);

/// The spectrum scaled to luminance Y; black if its luminance is 0.
/// Checked: Spectrum.ScalingSetsTheLuminance
Spectrum with_luminance(Spectrum spectrum, float luminance);

/// A CIE standard illuminant: "A", "D50", "D55", "D65", "D75" or "E"; null if unknown.
/// Source:  CIE 15:2004, section 3.1.
/// Checked: Spectrum.IlluminantsAreThoseOfTheCie
std::optional<Spectrum> cie_illuminant(std::string_view name);

}  // namespace oriel
