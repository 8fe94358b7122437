// SPDX-License-Identifier: Apache-2.0
// Light at the shading point.
#ifndef ORIEL_SDK_LIGHT_H
#define ORIEL_SDK_LIGHT_H

// Conventions
//   A light is the tag of an instance of a light or of a group of lights. A Lambert surface of
//   albedo a reflects a * colour * dot_nl. Directions point to the light, in internal space.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Takes one sample of a light, including shadows and volumes; call until miFALSE, then divide by
/// samples.
miBoolean mi_sample_light(miColor* result, miVector* dir, float* dot_nl, miState* state,
                          miTag light_inst, int* samples);
/// Takes one sample of a light, without a loop.
miBoolean mi_trace_light(miColor* result, miVector* dir, float* dot_nl, miState* state,
                         miTag light_inst);
/// Origin and direction of a light in its own space, and parameters of its shader; NULL = not
/// requested.
void mi_light_info(miTag light_inst, miVector* org, miVector* dir, void** paras);
/// Number and list of all lights of the scene.
int mi_global_lights_info(miTag** lights);
/// Replaces a list by the same lights as instances, for use as inclusive light list.
miBoolean mi_inclusive_lightlist(int* n, miTag** lights, miState* state);
/// Replaces a list by all other lights.
miBoolean mi_exclusive_lightlist(int* n, miTag** lights, miState* state);
/// Replaces groups of lights by the lights they contain.
miBoolean mi_expand_lightlist(int* n, miTag** lights, miState* state);
/// The lights linked to state->instance, or all lights of the scene.
miBoolean mi_instance_lightlist(int* n, miTag** lights, miState* state);
/// Value of a light profile by angles, or for `pos` in its space; rel: relative to the maximum.
miScalar mi_lightprofile_value(const void* profile, miScalar phi, miScalar costheta,
                               const miVector* pos, miBoolean rel);
/// Value of a light profile for the light ray of state; rel: relative to the maximum.
miScalar mi_lightprofile_sample(miState* state, miTag profile, miBoolean rel);

#ifdef __cplusplus
}
#endif

#endif
