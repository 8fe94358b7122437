// SPDX-License-Identifier: Apache-2.0
// Reflectance of a transparent film on a surface.
#pragma once

#include "base/vec.h"

namespace oriel::bsdf {

/// Reflectance of unpolarised light for one wavelength.
///
/// Model:   Airy's sum of the beams between a film without absorption and a dielectric base.
/// Inputs:  cosine: of the angle of incidence, in air; film, base: indices of refraction, at least
///          1; thickness, wavelength: nm.
/// Source:  Born, Wolf, "Principles of Optics", 7.6.1.
/// Checked: ThinFilm.*
float thin_film_reflectance(float cosine, float film, float base, float thickness,
                            float wavelength);

/// The same as a linear sRGB colour: means over the visible spectrum, weighted such that a constant
/// reflectance gives grey. Channels outside of 0..1 are clamped.
///
/// Inputs:  base: reflectance at normal incidence without the film, 0..1; each channel has the
///          index of a dielectric.
Rgb thin_film_color(float cosine, float film, const Rgb& base, float thickness);

}  // namespace oriel::bsdf
