// SPDX-License-Identifier: Apache-2.0
// How does a shader send rays?
#ifndef ORIEL_SDK_TRACE_H
#define ORIEL_SDK_TRACE_H

// Conventions
//   Directions are unit vectors in internal space; rays start at state->point. Results are colours.
//   After a call state->child is the state of the ray. miFALSE: nothing was found or the depth is
//   used up; the result is then black or the environment.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Lens shaders: the next lens, at last the eye ray; origin and direction are put into state.
miBoolean mi_trace_eye(miColor* result, miState* state, const miVector* origin,
                       const miVector* direction);
/// Light from the mirrored direction; a ray that misses gets the environment.
miBoolean mi_trace_reflection(miColor* result, miState* state, const miVector* direction);
/// Light from the refracted direction; refraction_volume becomes the volume of the ray.
miBoolean mi_trace_refraction(miColor* result, miState* state, const miVector* direction);
/// Light from straight behind, also when the options forbid tracing.
miBoolean mi_trace_transparent(miColor* result, miState* state);
/// What the environment shader shows in a direction; counts as no level.
miBoolean mi_trace_environment(miColor* result, miState* state, const miVector* direction);
/// Whether a ray hits something; runs no shader, state->child holds the hit.
miBoolean mi_trace_probe(miState* state, const miVector* direction, const miVector* origin);
/// What the ray would show if this hit were not there; counts as no level.
miBoolean mi_trace_continue(miColor* result, miState* state);
/// Light shaders: multiplies result with what lets light pass; miFALSE when nothing is left.
miBoolean mi_trace_shadow(miColor* result, miState* state);
/// Shadow shaders in segment mode: goes on to the next occluder towards the lit point.
miBoolean mi_trace_shadow_seg(miColor* result, miState* state);
/// Shadow shaders in segment mode: goes on as if this occluder were not there.
miBoolean mi_continue_shadow_seg(miColor* result, miState* state);
/// Least length of further rays of this call; the former value comes back in `offset`.
void mi_ray_offset(const miState* state, double* offset);
/// Range in which further rays fade to the environment; the former values come back.
void mi_ray_falloff(const miState* state, double* start, double* stop);
/// Tells the opacity of this sample, where it matters apart from the colour.
miBoolean mi_opacity_set(miState* state, const miColor* opacity);
/// The opacity told before; miFALSE when there is none.
miBoolean mi_opacity_get(miState* state, miColor* opacity);
/// Runs the material shader of state->material.
miBoolean mi_call_material(miColor* result, miState* state);
/// Runs the photon shader of state->material.
miBoolean mi_call_photon_material(miColor* result, miState* state);
/// Runs the shadow shader of state->material.
miBoolean mi_call_shadow_material(miColor* result, miState* state);
/// Runs the environment shader of state->material.
miBoolean mi_call_environment_material(miColor* result, miState* state);
/// Runs the volume shader of state->material.
miBoolean mi_call_volume_material(miColor* result, miState* state);
/// Runs the photon volume shader of state->material.
miBoolean mi_call_photonvol_material(miColor* result, miState* state);
/// Forgets results of connected shaders, so that mi_eval runs them again.
void mi_flush_cache(miState* state);
/// Accepted for sources of later levels; rays carry no differentials that a shader could change.
void mi_ray_differential_transform(const miState* state, ...);

#ifdef __cplusplus
}
#endif

#endif
