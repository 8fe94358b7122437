// SPDX-License-Identifier: Apache-2.0
// Information about instances and shaders. Older forms of mi_query.
#ifndef ORIEL_SDK_INFO_H
#define ORIEL_SDK_INFO_H

// Conventions
//   Every pointer except the tag may be NULL = not requested. If there is no result, tags and
//   numbers are 0, pointers NULL, matrices the identity.
//   The signatures are specific to Oriel, because no description of them was available.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The element of an instance, its material, and its matrices.
void mi_instance_info(miTag instance, miTag* item, miTag* material, miMatrix global_to_local,
                      miMatrix local_to_global);
/// Name and version of the declaration of a shader call, and its parameters; NULL for built-in
/// shaders.
void mi_shader_info(miTag shader, char** name, int* version, void** paras);

#ifdef __cplusplus
}
#endif

#endif
