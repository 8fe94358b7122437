// SPDX-License-Identifier: Apache-2.0
// What are an instance and a shader made of? Older forms of mi_query.
#ifndef ORIEL_SDK_INFO_H
#define ORIEL_SDK_INFO_H

// Conventions
//   Every pointer but the tag may be NULL = not asked. Without an answer tags and numbers are 0,
//   pointers NULL, matrices the identity.
//   The arguments are Oriel's choice: no description of them was available.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What an instance places, its material, and its matrices.
void mi_instance_info(miTag instance, miTag* item, miTag* material, miMatrix global_to_local,
                      miMatrix local_to_global);
/// Name and version of the declaration of a shader call, and its parameters, NULL for shaders of
/// the renderer.
void mi_shader_info(miTag shader, char** name, int* version, void** paras);

#ifdef __cplusplus
}
#endif

#endif
