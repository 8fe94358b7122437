// SPDX-License-Identifier: Apache-2.0
// Photon tracing.
#ifndef ORIEL_SDK_PHOTON_H
#define ORIEL_SDK_PHOTON_H

// Conventions
//   Energy is a colour. Only photon shaders call these functions; they must not call mi_trace_*.
//   miFALSE: the photon ends, because the object does not scatter it in this pass or at this depth.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Photon emitters: emits a photon along state->dir from state->org.
miBoolean mi_photon_light(miColor* energy, miState* state);
/// Continues along dir as a mirrored photon.
miBoolean mi_photon_reflection_specular(miColor* energy, miState* state, const miVector* dir);
/// Continues along dir as a glossily reflected photon.
miBoolean mi_photon_reflection_glossy(miColor* energy, miState* state, const miVector* dir);
/// Continues along dir as a diffusely reflected photon.
miBoolean mi_photon_reflection_diffuse(miColor* energy, miState* state, const miVector* dir);
/// Continues along dir as a refracted photon.
miBoolean mi_photon_transmission_specular(miColor* energy, miState* state, const miVector* dir);
/// Continues along dir as a glossily transmitted photon.
miBoolean mi_photon_transmission_glossy(miColor* energy, miState* state, const miVector* dir);
/// Continues along dir as a diffusely transmitted photon.
miBoolean mi_photon_transmission_diffuse(miColor* energy, miState* state, const miVector* dir);
/// Continues in the same direction.
miBoolean mi_photon_transparent(miColor* energy, miState* state);
/// Photon volume shaders: continues along dir after scattering in the volume.
miBoolean mi_photon_volume_scattering(miColor* energy, miState* state, const miVector* dir);
/// Stores a photon at the hit point.
miBoolean mi_store_photon(miColor* energy, miState* state);
/// Stores a photon in the volume.
miBoolean mi_store_volume_photon(miColor* energy, miState* state);
/// Russian roulette over scattering types; the selected colour is rescaled in place,
/// miPHOTON_ABSORB: none.
miRay_type mi_choose_scatter_type(miState* state, miScalar transp, miColor* diffuse,
                                  miColor* glossy, miColor* specular);
/// Same for diffuse and mirror scattering, reflected and transmitted.
miRay_type mi_choose_simple_scatter_type(miState* state, miColor* rdiff, miColor* rspec,
                                         miColor* tdiff, miColor* tspec);

#ifdef __cplusplus
}
#endif

#endif
