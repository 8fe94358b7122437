// SPDX-License-Identifier: Apache-2.0
// The C functions behind the C++ classes of mi_shader_if.h, so that no C++ type is part of the ABI.
#ifndef ORIEL_SDK_INTERFACE_H
#define ORIEL_SDK_INTERFACE_H

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Level of this interface.
#define ORIEL_SHADER_INTERFACE_VERSION 3

typedef struct oriel_shader_interface oriel_shader_interface;
typedef struct oriel_string_options oriel_string_options;
typedef struct oriel_framebuffers oriel_framebuffers;

/// The C++ interface of the renderer; NULL if the version is unsupported.
oriel_shader_interface* mi_get_shader_interface(int version);

/// Like mi_sample_light, for directions around a unit axis up to a cosine; NULL = the normal.
miBoolean oriel_light_sample(miColor* result, miVector* dir, miScalar* dot_nl, miState* state,
                             miTag light_inst, int* samples, const miVector* axis,
                             miScalar cos_spread);
/// Converts a colour to a spectrum.
void oriel_spectrum_from_color(miSpectrum* result, miState* state, const miColor* color);

/// The named options of a tag (miOptions::string_options); NULL if there are none.
oriel_string_options* oriel_options_open(miTag tag);
/// Closes the result of oriel_options_open; NULL is ignored.
void oriel_options_close(oriel_string_options* options);
/// Sets a boolean option; miFALSE if options are read-only.
miBoolean oriel_options_set_boolean(oriel_string_options* options, const char* name,
                                    miBoolean value);
/// Sets an integer option.
miBoolean oriel_options_set_integer(oriel_string_options* options, const char* name, int value);
/// Sets an option of n scalars, 1, 3 or 4.
miBoolean oriel_options_set_scalars(oriel_string_options* options, const char* name,
                                    const float* values, int n);
/// Sets a string option.
miBoolean oriel_options_set_string(oriel_string_options* options, const char* name,
                                   const char* value);
/// Value of a boolean option; miFALSE and value unchanged if there is none.
miBoolean oriel_options_get_boolean(const oriel_string_options* options, const char* name,
                                    miBoolean* value);
/// Value of an integer option.
miBoolean oriel_options_get_integer(const oriel_string_options* options, const char* name,
                                    int* value);
/// Values of an option of n scalars.
miBoolean oriel_options_get_scalars(const oriel_string_options* options, const char* name,
                                    float* values, int n);
/// Value of a string option, valid until the end of the frame.
miBoolean oriel_options_get_string(const oriel_string_options* options, const char* name,
                                   const char** value);
/// Removes an option; miFALSE if there is none.
miBoolean oriel_options_remove(oriel_string_options* options, const char* name);

/// A new, empty list of named frame buffers.
miTag oriel_framebuffers_create(void);
/// A copy of a list of named frame buffers.
miTag oriel_framebuffers_copy(miTag tag);
/// The named frame buffers of a tag (miCamera::buffertag); NULL if there are none.
oriel_framebuffers* oriel_framebuffers_open(miTag tag, miBoolean edit);
/// Closes the result of oriel_framebuffers_open; NULL is ignored.
void oriel_framebuffers_close(oriel_framebuffers* buffers);
/// Number of a buffer for mi_fb_put; miFALSE if there is none of that name.
miBoolean oriel_framebuffers_index(const oriel_framebuffers* buffers, const char* name,
                                   size_t* index);
/// Sets a boolean parameter of a buffer.
miBoolean oriel_framebuffers_set_boolean(oriel_framebuffers* buffers, const char* buffer,
                                         const char* param, miBoolean value);
/// Sets an integer parameter of a buffer.
miBoolean oriel_framebuffers_set_integer(oriel_framebuffers* buffers, const char* buffer,
                                         const char* param, int value);
/// Sets a scalar parameter of a buffer.
miBoolean oriel_framebuffers_set_scalar(oriel_framebuffers* buffers, const char* buffer,
                                        const char* param, float value);
/// Sets a string parameter of a buffer.
miBoolean oriel_framebuffers_set_string(oriel_framebuffers* buffers, const char* buffer,
                                        const char* param, const char* value);
/// Value of a boolean parameter of a buffer.
miBoolean oriel_framebuffers_get_boolean(const oriel_framebuffers* buffers, const char* buffer,
                                         const char* param, miBoolean* value);
/// Value of an integer parameter of a buffer.
miBoolean oriel_framebuffers_get_integer(const oriel_framebuffers* buffers, const char* buffer,
                                         const char* param, int* value);
/// Value of a scalar parameter of a buffer.
miBoolean oriel_framebuffers_get_scalar(const oriel_framebuffers* buffers, const char* buffer,
                                        const char* param, float* value);
/// Value of a string parameter of a buffer, valid until the end of the frame.
miBoolean oriel_framebuffers_get_string(const oriel_framebuffers* buffers, const char* buffer,
                                        const char* param, const char** value);
/// Removes all buffers.
void oriel_framebuffers_reset(oriel_framebuffers* buffers);
/// Writes all buffers as scene text.
void oriel_framebuffers_echo(const oriel_framebuffers* buffers, FILE* file);

#ifdef __cplusplus
}
#endif

#endif
