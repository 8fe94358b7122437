// SPDX-License-Identifier: Apache-2.0
// Calculations with spectra: 31 bands of 10 nm from 400 to 700 nm.
#ifndef ORIEL_SDK_SPECTRUM_H
#define ORIEL_SDK_SPECTRUM_H

// Conventions
//   Pictures are rendered in RGB: mi_spectrum_enabled returns NULL, and spectra are only used
//   inside shaders. Colours are linear. A flat spectrum of 1 has luminance 1. NULL spectra are
//   ignored: functions do nothing and return 0, miFALSE or NULL.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The spectrum element of a scene; opaque.
typedef struct miSpectrum_data miSpectrum_data;

/// Name of the colour profile of spectral rendering; always NULL.
const char* mi_spectrum_enabled(void);
/// Returns the spectrum, initialised to black if it was invalid.
miSpectrum* mi_spectrum_ensure(miSpectrum* s);
/// Whether a function of this header has initialised the spectrum.
miBoolean mi_spectrum_check(const miSpectrum* s);
/// Size of a spectrum in bytes; NULL: of every spectrum.
unsigned int mi_spectrum_size(const miSpectrum* s);
/// Wavelengths of the first and last band, nm.
void mi_spectrum_range_get(const miSpectrum* s, miScalar* lo, miScalar* hi);
/// Visible wavelengths, nm.
void mi_spectrum_visible_range(miScalar* lo, miScalar* hi);
/// A black spectrum as a template for others; must not be deleted.
miSpectrum* mi_spectrum_blueprint(void);

/// Creates a black spectrum; NULL: of the default kind, the only one.
miSpectrum* mi_spectrum_create(const miSpectrum* blueprint);
/// Same for init shaders.
miSpectrum* mi_spectrum_create_inheap(const miSpectrum* blueprint);
/// Creates a copy of a spectrum.
miSpectrum* mi_spectrum_clone(const miSpectrum* s);
/// Deletes a spectrum of mi_spectrum_create or mi_spectrum_clone.
void mi_spectrum_delete(miSpectrum* s);
/// Deletes a spectrum of mi_spectrum_create_inheap.
void mi_spectrum_delete_fromheap(miSpectrum* s);

/// Sets the spectrum to black.
void mi_spectrum_clear(miSpectrum* s);
/// Resets the spectrum to a new, black one.
void mi_spectrum_reset(miSpectrum* s);
/// Copies a spectrum of the same kind.
void mi_spectrum_copy(miSpectrum* to, const miSpectrum* from);
/// Copies a spectrum of any kind.
void mi_spectrum_assign(miSpectrum* to, const miSpectrum* from);
/// Copies a spectrum element. Ignored with a warning: spectrum elements are unsupported.
void mi_spectrum_assign_data(miSpectrum* to, const miSpectrum_data* from);
/// Adds another spectrum, band by band.
void mi_spectrum_add(miSpectrum* s, const miSpectrum* other);
/// Multiplies by another spectrum, band by band.
void mi_spectrum_mul(miSpectrum* s, const miSpectrum* other);
/// Multiplies by a number.
void mi_spectrum_scale(miSpectrum* s, miScalar factor);
/// Adds a smooth spectrum of the given colour.
void mi_spectrum_color_add(miSpectrum* s, const miColor* color);
/// Interpolates linearly to another spectrum, which is reached at t = 1.
void mi_spectrum_lerp(miSpectrum* s, const miSpectrum* other, miScalar t);

/// Value of the band that contains a wavelength; 0 outside of all bands.
miScalar mi_spectrum_value_get(const miSpectrum* s, miScalar nm);
/// Sets the band that contains a wavelength; returns its value.
miScalar mi_spectrum_value_set(miSpectrum* s, miScalar nm, miScalar value);
/// Adds to the band that contains a wavelength; returns its value.
miScalar mi_spectrum_value_add(miSpectrum* s, miScalar nm, miScalar value);
/// Width of the band that contains a wavelength, nm.
miScalar mi_spectrum_linewidth(const miSpectrum* s, miScalar nm);

/// Sets the spectrum to that of a black body, scaled to a luminance.
void mi_spectrum_blackbody(miSpectrum* s, miScalar kelvin, miScalar intensity);
/// Sets the spectrum to CIE daylight of a colour temperature, scaled to a luminance.
void mi_spectrum_cie_sky(miSpectrum* s, miScalar kelvin, miScalar intensity);
/// Sets the spectrum to a CIE illuminant, A, D50, D55, D65, D75 or E, scaled to a luminance.
void mi_spectrum_cie(miSpectrum* s, miScalar intensity, const char* illuminant);

/// The colour of a spectrum.
void mi_spectrum_rgb(miColor* to, const miSpectrum* s);
/// The CIE 1931 XYZ of a spectrum.
void mi_spectrum_ciexyz(miColor* to, const miSpectrum* s);

#ifdef __cplusplus
}
#endif

#endif
