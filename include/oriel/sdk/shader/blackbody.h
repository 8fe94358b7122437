// SPDX-License-Identifier: Apache-2.0
// Black-body radiation and colour matching functions.
#ifndef ORIEL_SDK_BLACKBODY_H
#define ORIEL_SDK_BLACKBODY_H

// Conventions
//   Temperatures in kelvin, wavelengths in nanometres.
//   The signatures are specific to Oriel, because no description of them was available.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Spectral radiance of a black body at a wavelength, W / (m^2 sr nm).
miScalar mi_blackbody_spectral_radiance(miScalar kelvin, miScalar nm);
/// Radiance of a black body integrated over all wavelengths, W / (m^2 sr).
miScalar mi_blackbody_radiance(miScalar kelvin);
/// CIE 1931 colour matching functions at a wavelength: x, y, z in r, g, b.
void mi_ciexyz_weights(miScalar nm, miColor* weights);

#ifdef __cplusplus
}
#endif

#endif
