// SPDX-License-Identifier: Apache-2.0
// Ray tracing functions.
#ifndef ORIEL_SDK_TRACE_H
#define ORIEL_SDK_TRACE_H

// Conventions
//   Directions are unit vectors in internal space; rays start at state->point. Results are colours.
//   After a call state->child is the state of the ray. miFALSE: nothing was hit or the trace depth
//   is exceeded; the result is then black or the environment.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Lens shaders: runs the next lens, finally the eye ray; origin and direction are stored in state.
miBoolean mi_trace_eye(miColor* result, miState* state, const miVector* origin,
                       const miVector* direction);
/// Radiance from the mirror direction; a ray that misses returns the environment.
miBoolean mi_trace_reflection(miColor* result, miState* state, const miVector* direction);
/// Radiance from the refracted direction; refraction_volume becomes the volume of the ray.
miBoolean mi_trace_refraction(miColor* result, miState* state, const miVector* direction);
/// Radiance in the direction of the ray behind the surface, also if the options disable tracing.
miBoolean mi_trace_transparent(miColor* result, miState* state);
/// Radiance of the environment in a direction; does not increase the trace depth.
miBoolean mi_trace_environment(miColor* result, miState* state, const miVector* direction);
/// Whether a ray hits something; runs no shader, state->child is the hit.
miBoolean mi_trace_probe(miState* state, const miVector* direction, const miVector* origin);
/// Radiance of the ray as if this hit did not exist; does not increase the trace depth.
miBoolean mi_trace_continue(miColor* result, miState* state);
/// Light shaders: multiplies result by the transmittance to the light; miFALSE if nothing is left.
miBoolean mi_trace_shadow(miColor* result, miState* state);
/// Shadow shaders in segment mode: continues to the next occluder towards the lit point.
miBoolean mi_trace_shadow_seg(miColor* result, miState* state);
/// Shadow shaders in segment mode: continues as if this occluder did not exist.
miBoolean mi_continue_shadow_seg(miColor* result, miState* state);
/// Minimum length of subsequent rays of this call; the previous value is returned in `offset`.
void mi_ray_offset(const miState* state, double* offset);
/// Range in which subsequent rays fade to the environment; the previous values are returned.
void mi_ray_falloff(const miState* state, double* start, double* stop);
/// Sets the opacity of this sample, if it differs from the alpha of the colour.
miBoolean mi_opacity_set(miState* state, const miColor* opacity);
/// The opacity that was set; miFALSE if there is none.
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
/// Discards cached results of connected shaders, so that mi_eval runs them again.
void mi_flush_cache(miState* state);
/// Accepted for sources of later levels; rays have no differentials that a shader could change.
void mi_ray_differential_transform(const miState* state, ...);

#ifdef __cplusplus
}
#endif

#endif
