// SPDX-License-Identifier: Apache-2.0
// Calls of shaders, and data exchange between shaders.
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

/// Stores a copy of size bytes under a key for shaders of subsequent rays; NULL or size 0 removes
/// it.
miBoolean mi_shaderstate_set(miState* state, const char* key, const void* value, int size,
                             int lifetime);
/// The stored copy, which may be modified; NULL if there is none. size: its bytes, may be NULL.
void* mi_shaderstate_get(miState* state, const char* key, int* size);
/// Calls cb for each stored value.
void mi_shaderstate_enumerate(miState* state,
                              void (*cb)(void* arg, char* key, void* value, int size, int lifetime),
                              void* arg);
/// Runs a shader, or the shader of a material of that kind; result has the declared type.
miBoolean mi_call_shader(miColor* result, miShader_type type, miState* state, miTag tag);
/// Like mi_call_shader, with a fourth argument.
miBoolean mi_call_shader_x(miColor* result, miShader_type type, miState* state, miTag tag,
                           void* arg);
/// A copy of a shader call with all of its connections.
miTag mi_phen_clone(miState* state, miTag tag);
/// Releases a copy of mi_phen_clone.
void mi_phen_unclone(miState* state, miTag tag);

/// Converts CIE XYZ to the rendering colour space, in place.
void mi_colorprofile_ciexyz_to_internal(miColor* color);
/// Converts CIE XYZ to the colour space of the picture, in place.
void mi_colorprofile_ciexyz_to_render(miColor* color);
/// Converts from the rendering colour space to CIE XYZ, in place.
void mi_colorprofile_internal_to_ciexyz(miColor* color);
/// Converts from the rendering colour space to that of the picture, in place.
void mi_colorprofile_internal_to_render(miColor* color);
/// Converts from the colour space of the picture to CIE XYZ, in place.
void mi_colorprofile_render_to_ciexyz(miColor* color);
/// Converts from the colour space of the picture to the rendering one, in place.
void mi_colorprofile_render_to_internal(miColor* color);

#ifdef __cplusplus
}
#endif

#endif
