// SPDX-License-Identifier: Apache-2.0
// Shader declarations and shader calls made by geometry shaders.
#ifndef ORIEL_SDK_DECLARE_H
#define ORIEL_SDK_DECLARE_H

// Conventions
//   Only geometry shaders may call these functions. Strings are allocated with mi_mem_strdup; the
//   API takes ownership and frees them. Strings that are parameter values belong to the caller.

#include "scene.h"
#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A parameter or result of a declaration; opaque. It also represents the list that contains it.
typedef struct miParameter miParameter;

/// Creates a parameter; name NULL for a result of a simple type.
miParameter* mi_api_parameter_decl(miParam_type type, const char* name, void* unused);
/// Appends a parameter to a list (NULL: a new one); returns the parameter.
miParameter* mi_api_parameter_append(miParameter* list, miParameter* parm);
/// Sets the members of a struct or the element of an array.
miBoolean mi_api_parameter_child(miParameter* parm, miParameter* child);
/// Sets the default of the last declared parameter; for colors and vectors, one scalar per call.
miBoolean mi_api_parameter_default(miParam_type type, void* value);
/// Begins a declaration; an existing one is unchanged.
miFunction_decl* mi_api_funcdecl_begin(miParameter* result, const char* name, miParameter* list);
/// Ends a declaration.
void mi_api_funcdecl_end(void);

/// Begins a call of the declared shader.
miBoolean mi_api_function_call(const char* declaration);
/// Names the parameter that the next values belong to.
miBoolean mi_api_parameter_name(const char* name);
/// Sets a value of the parameter. Colors and vectors may be set by one scalar per call; scene
/// elements by name (a string) or by tag.
miBoolean mi_api_parameter_value(miParam_type type, void* value, ...);
/// Opens a struct, or an array if is_array is miTRUE.
miBoolean mi_api_parameter_push(miBoolean is_array);
/// Closes the struct or array opened last.
miBoolean mi_api_parameter_pop(void);
/// Begins the next element of an array.
miBoolean mi_api_new_array_element(void);
/// Connects the parameter to a named shader.
miBoolean mi_api_parameter_shader(const char* name);
/// Connects the parameter to a parameter of the enclosing phenomenon.
miBoolean mi_api_parameter_interface(const char* name);
/// Ends a call and returns its tag. next: the next call in a list, or 0.
miTag mi_api_function_call_end(miTag next);
/// Appends a call to a list of calls; returns the tag of the list.
miTag mi_api_function_append(miTag list, miTag next);
/// Tag of a named shader; 0 if there is none.
miTag mi_api_function_assign(const char* name);
/// Names a call.
miBoolean mi_api_shader_add(const char* name, miTag call);

#ifdef __cplusplus
}
#endif

#endif
