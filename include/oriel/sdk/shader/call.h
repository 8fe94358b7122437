// SPDX-License-Identifier: Apache-2.0
// How do shaders call each other and leave something for each other?
#ifndef ORIEL_SDK_CALL_H
#define ORIEL_SDK_CALL_H

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Lifetimes of values in the shader state.
#define miSS_LIFETIME_SUBRAYS 0
#define miSS_LIFETIME_EYERAY 1
#define miSS_LIFETIME_RECT 2

/// Leaves a copy of size bytes under a key for rays from here; NULL or size 0 takes it away.
miBoolean mi_shaderstate_set(miState* state, const char* key, const void* value, int size,
                             int lifetime);
/// The copy under a key, may be written; NULL when there is none. size: its bytes, may be NULL.
void* mi_shaderstate_get(miState* state, const char* key, int* size);
/// Calls cb for everything left.
void mi_shaderstate_enumerate(miState* state,
                              void (*cb)(void* arg, char* key, void* value, int size, int lifetime),
                              void* arg);
/// Runs a shader, or a material's shader of that kind; result is of the type it declares.
miBoolean mi_call_shader(miColor* result, miShader_type type, miState* state, miTag tag);
/// As mi_call_shader, with a fourth argument.
miBoolean mi_call_shader_x(miColor* result, miShader_type type, miState* state, miTag tag,
                           void* arg);
/// A copy of a shader call with all it is connected to.
miTag mi_phen_clone(miState* state, miTag tag);
/// Ends mi_phen_clone.
void mi_phen_unclone(miState* state, miTag tag);

/// CIE XYZ to the renderer's colours, in place.
void mi_colorprofile_ciexyz_to_internal(miColor* color);
/// CIE XYZ to the colours of the picture, in place.
void mi_colorprofile_ciexyz_to_render(miColor* color);
/// The renderer's colours to CIE XYZ, in place.
void mi_colorprofile_internal_to_ciexyz(miColor* color);
/// The renderer's colours to those of the picture, in place.
void mi_colorprofile_internal_to_render(miColor* color);
/// Colours of the picture to CIE XYZ, in place.
void mi_colorprofile_render_to_ciexyz(miColor* color);
/// Colours of the picture to the renderer's, in place.
void mi_colorprofile_render_to_internal(miColor* color);

#ifdef __cplusplus
}
#endif

#endif
