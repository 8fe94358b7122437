// SPDX-License-Identifier: Apache-2.0
// Which parameters of the running shader are connected to another shader?
#ifndef ORIEL_SDK_CONNECTION_H
#define ORIEL_SDK_CONNECTION_H

// Conventions
//   Behind the parameter struct stands a copy of its layout with a tag in the place of each
//   parameter: the shader that it is connected to, 0 for a value. The copy exists where one of the
//   parameters is connected.

#include "scene.h"
#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Whether a tag is that of a shader call.
miBoolean oriel_is_shader_tag(miTag tag);

/// Whether any parameter of the running shader is connected.
#define mi_has_connections(state) ((state)->shader != NULL && (state)->shader->ghost_offs != 0)
/// What the parameter at address p is connected to. Only where mi_has_connections(state) is true.
#define mi_get_ghost(state, p) \
  (*(const miTag*)(const void*)((const char*)(const void*)(p) + (state)->shader->ghost_offs))
/// Whether a tag is none of a shader: 0, a texture, a light, any other element.
#define mi_is_nonshader_tag(tag) (!oriel_is_shader_tag(tag))

#ifdef __cplusplus
}
#endif

#endif
