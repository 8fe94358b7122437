// SPDX-License-Identifier: Apache-2.0
// Connections of the parameters of the running shader.
#ifndef ORIEL_SDK_CONNECTION_H
#define ORIEL_SDK_CONNECTION_H

// Conventions
//   The parameter struct is followed by a copy of its layout with a tag in place of each parameter:
//   the connected shader, or 0 for a value. The copy exists if any parameter is connected.

#include "scene.h"
#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Whether a tag refers to a shader call.
miBoolean oriel_is_shader_tag(miTag tag);

/// Whether any parameter of the running shader is connected.
#define mi_has_connections(state) ((state)->shader != NULL && (state)->shader->ghost_offs != 0)
/// The shader connected to the parameter at address p. Requires mi_has_connections(state).
#define mi_get_ghost(state, p) \
  (*(const miTag*)(const void*)((const char*)(const void*)(p) + (state)->shader->ghost_offs))
/// Whether a tag does not refer to a shader: 0, a texture, a light, any other element.
#define mi_is_nonshader_tag(tag) (!oriel_is_shader_tag(tag))

#ifdef __cplusplus
}
#endif

#endif
