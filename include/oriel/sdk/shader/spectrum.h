// SPDX-License-Identifier: Apache-2.0
// How does a shader calculate with spectra: 31 bands of 10 nm from 400 to 700 nm.
#ifndef ORIEL_SDK_SPECTRUM_H
#define ORIEL_SDK_SPECTRUM_H

// Conventions
//   Pictures are rendered in three colours: mi_spectrum_enabled is NULL, and spectra are the
//   shader's own. Colours are linear, as everywhere. A flat spectrum of 1 has luminance 1. NULL
//   spectra are ignored: functions do nothing and answer 0, miFALSE or NULL.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The spectrum element of a scene; opaque.
typedef struct miSpectrum_data miSpectrum_data;

/// Name of the colour profile that renders spectra; always NULL.
const char* mi_spectrum_enabled(void);
/// The spectrum itself, black if it was not valid.
miSpectrum* mi_spectrum_ensure(miSpectrum* s);
/// Whether a function of this header has initialised the spectrum.
miBoolean mi_spectrum_check(const miSpectrum* s);
/// Bytes of a spectrum; NULL: of all.
unsigned int mi_spectrum_size(const miSpectrum* s);
/// Wavelengths of the first and last band, nm.
void mi_spectrum_range_get(const miSpectrum* s, miScalar* lo, miScalar* hi);
/// Wavelengths that are seen, nm.
void mi_spectrum_visible_range(miScalar* lo, miScalar* hi);
/// A black spectrum that others are made like; not to be deleted.
miSpectrum* mi_spectrum_blueprint(void);

/// A new black spectrum; NULL: of the default kind, the only one.
miSpectrum* mi_spectrum_create(const miSpectrum* blueprint);
/// The same, for init shaders.
miSpectrum* mi_spectrum_create_inheap(const miSpectrum* blueprint);
/// A new spectrum of the same values.
miSpectrum* mi_spectrum_clone(const miSpectrum* s);
/// Ends mi_spectrum_create and mi_spectrum_clone.
void mi_spectrum_delete(miSpectrum* s);
/// Ends mi_spectrum_create_inheap.
void mi_spectrum_delete_fromheap(miSpectrum* s);

/// Makes it black.
void mi_spectrum_clear(miSpectrum* s);
/// Makes it black, as if it were new.
void mi_spectrum_reset(miSpectrum* s);
/// Copies a spectrum of the same kind.
void mi_spectrum_copy(miSpectrum* to, const miSpectrum* from);
/// Copies a spectrum of any kind.
void mi_spectrum_assign(miSpectrum* to, const miSpectrum* from);
/// Copies a spectrum element. Ignored with a warning: no element reaches shaders.
void mi_spectrum_assign_data(miSpectrum* to, const miSpectrum_data* from);
/// Adds band by band.
void mi_spectrum_add(miSpectrum* s, const miSpectrum* other);
/// Multiplies band by band.
void mi_spectrum_mul(miSpectrum* s, const miSpectrum* other);
/// Multiplies by a number.
void mi_spectrum_scale(miSpectrum* s, miScalar factor);
/// Adds a smooth spectrum of that colour.
void mi_spectrum_color_add(miSpectrum* s, const miColor* color);
/// Moves towards another one, which is reached at t = 1.
void mi_spectrum_lerp(miSpectrum* s, const miSpectrum* other, miScalar t);

/// Value of the band that holds a wavelength; 0 outside of all.
miScalar mi_spectrum_value_get(const miSpectrum* s, miScalar nm);
/// Sets the band that holds a wavelength; its value.
miScalar mi_spectrum_value_set(miSpectrum* s, miScalar nm, miScalar value);
/// Adds to the band that holds a wavelength; its value.
miScalar mi_spectrum_value_add(miSpectrum* s, miScalar nm, miScalar value);
/// Width of the band that holds a wavelength, nm.
miScalar mi_spectrum_linewidth(const miSpectrum* s, miScalar nm);

/// Sets it to a black body's, scaled to a luminance.
void mi_spectrum_blackbody(miSpectrum* s, miScalar kelvin, miScalar intensity);
/// Sets it to the CIE's daylight of a colour temperature, scaled to a luminance.
void mi_spectrum_cie_sky(miSpectrum* s, miScalar kelvin, miScalar intensity);
/// Sets it to a CIE illuminant, A, D50, D55, D65, D75 or E, scaled to a luminance.
void mi_spectrum_cie(miSpectrum* s, miScalar intensity, const char* illuminant);

/// Its colour.
void mi_spectrum_rgb(miColor* to, const miSpectrum* s);
/// Its CIE 1931 XYZ.
void mi_spectrum_ciexyz(miColor* to, const miSpectrum* s);

#ifdef __cplusplus
}
#endif

#endif
