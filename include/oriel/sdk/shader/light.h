// SPDX-License-Identifier: Apache-2.0
// Which light arrives at the point, and from where?
#ifndef ORIEL_SDK_LIGHT_H
#define ORIEL_SDK_LIGHT_H

// Conventions
//   A light is the tag of an instance of a light or of a group of lights. Its colour lights a
//   Lambert surface of albedo a with a * colour * dot_nl. Directions point to the light, internal
//   space.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// One sample of a light, shadows and volumes included; call until miFALSE, then divide by samples.
miBoolean mi_sample_light(miColor* result, miVector* dir, float* dot_nl, miState* state,
                          miTag light_inst, int* samples);
/// A light as one sample, without a loop.
miBoolean mi_trace_light(miColor* result, miVector* dir, float* dot_nl, miState* state,
                         miTag light_inst);
/// Origin and direction of a light in its own space, and its shader's parameters; NULL = not asked.
void mi_light_info(miTag light_inst, miVector* org, miVector* dir, void** paras);
/// Number of all lights of the scene, and their list.
int mi_global_lights_info(miTag** lights);
/// Replaces a list by the same lights as instances, for a list of what lights the object.
miBoolean mi_inclusive_lightlist(int* n, miTag** lights, miState* state);
/// Replaces a list by all lights but those.
miBoolean mi_exclusive_lightlist(int* n, miTag** lights, miState* state);
/// Replaces groups of lights by the lights in them.
miBoolean mi_expand_lightlist(int* n, miTag** lights, miState* state);
/// The lights linked to state->instance, or all of the scene.
miBoolean mi_instance_lightlist(int* n, miTag** lights, miState* state);
/// Value of a light profile by angles, or by `pos` in its space; rel: 1 is the greatest value.
miScalar mi_lightprofile_value(const void* profile, miScalar phi, miScalar costheta,
                               const miVector* pos, miBoolean rel);
/// Value of a light profile for the light ray of state; rel: 1 is the greatest value.
miScalar mi_lightprofile_sample(miState* state, miTag profile, miBoolean rel);

#ifdef __cplusplus
}
#endif

#endif
