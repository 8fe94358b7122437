// SPDX-License-Identifier: Apache-2.0
// How does a shader find elements by name, and parameters of a declaration?
#ifndef ORIEL_SDK_LOOKUP_H
#define ORIEL_SDK_LOOKUP_H

#include "enums.h"
#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Name of an element, for the life of the program; NULL when it has none.
const char* mi_api_tag_lookup(miTag tag);
/// Tag of the element, or declaration, of that name; 0 when there is none. Takes over the string,
/// which mi_mem_strdup made.
miTag mi_api_name_lookup(const char* name);
/// Finds a parameter (out miTRUE: a result) of a declaration by name: its type, or the type of its
/// elements where it is an array, and its place in the block of miQ_FUNC_PARAM, bytes. miFALSE, and
/// the outputs as they were, when there is none.
miBoolean mi_api_parameter_lookup(miParam_type* type, miBoolean* is_array, int* offs, miTag decl,
                                  miBoolean out, const char* name);

#ifdef __cplusplus
}
#endif

#endif
