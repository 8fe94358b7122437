// SPDX-License-Identifier: Apache-2.0
// Lookup of elements by name, and of parameters of a declaration.
#ifndef ORIEL_SDK_LOOKUP_H
#define ORIEL_SDK_LOOKUP_H

#include "enums.h"
#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Name of an element, valid until the end of the program; NULL if it has none.
const char* mi_api_tag_lookup(miTag tag);
/// Tag of a named element or declaration; 0 if there is none. Takes ownership of the string, which
/// has to be allocated with mi_mem_strdup.
miTag mi_api_name_lookup(const char* name);
/// Finds a parameter (out miTRUE: a result) of a declaration by name: its type (for arrays, that of
/// the elements) and its offset in the block of miQ_FUNC_PARAM in bytes. Returns miFALSE and leaves
/// the outputs unchanged if there is none.
miBoolean mi_api_parameter_lookup(miParam_type* type, miBoolean* is_array, int* offs, miTag decl,
                                  miBoolean out, const char* name);

#ifdef __cplusplus
}
#endif

#endif
