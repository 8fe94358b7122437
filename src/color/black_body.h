// SPDX-License-Identifier: Apache-2.0
// Colour and luminance of a black body by temperature.
#pragma once

#include "base/vec.h"

namespace oriel {

/// CIE 1931 2-degree colour matching functions at a wavelength, as XYZ.
///
/// Model:   sums of piecewise Gaussians, within about 1 % of the tables.
/// Source:  Wyman, Sloan, Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching
///          Functions", JCGT 2(2), 2013, equation 4.
Vec3 cie_1931_matching(float wavelength_nm);

/// Planck's law: spectral radiance of a black body, W m^-2 sr^-1 per nanometre; 0 unless both
/// arguments are positive.
/// Checked: BlackBody.SpectrumPeaksWhereWienSays
double black_body_spectral_radiance(double wavelength_nm, double kelvin);

/// Radiance of a black body integrated over all wavelengths, W m^-2 sr^-1; 0 unless `kelvin` is
/// positive.
///
/// Source:  the law of Stefan and Boltzmann, sigma T^4 / pi.
double black_body_radiance(double kelvin);

/// XYZ of a black body at `kelvin` > 0, where Y is luminance in cd/m2.
/// Checked: BlackBody.ChromaticityMatchesTable, BlackBody.SunDiscGivesItsIlluminance
Vec3 black_body_xyz(float kelvin);

/// Linear sRGB of a black body scaled to a largest component of 1; negative channels become 0.
Rgb black_body_color(float kelvin);

/// Luminous efficacy of the total radiation of a black body, lm/W.
float black_body_efficacy(float kelvin);

}  // namespace oriel
