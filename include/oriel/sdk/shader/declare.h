// SPDX-License-Identifier: Apache-2.0
// How does a geometry shader declare shaders and call them?
#ifndef ORIEL_SDK_DECLARE_H
#define ORIEL_SDK_DECLARE_H

// Conventions
//   Only geometry shaders may call these functions. Strings are made with mi_mem_strdup; the API
//   takes them over and frees them. Strings that are values belong to the caller.

#include "scene.h"
#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A parameter or result of a declaration; opaque. Each one also stands for the list it is part of.
typedef struct miParameter miParameter;

/// Makes a parameter; name NULL for a result of a simple type.
miParameter* mi_api_parameter_decl(miParam_type type, const char* name, void* unused);
/// Appends a parameter to a list (NULL: a new one); returns the parameter.
miParameter* mi_api_parameter_append(miParameter* list, miParameter* parm);
/// Gives a struct its members, or an array its element.
miBoolean mi_api_parameter_child(miParameter* parm, miParameter* child);
/// Sets the default of the parameter declared last; of colors and vectors one scalar a call.
miBoolean mi_api_parameter_default(miParam_type type, void* value);
/// Begins a declaration; one that exists already stays as it is.
miFunction_decl* mi_api_funcdecl_begin(miParameter* result, const char* name, miParameter* list);
/// Ends a declaration.
void mi_api_funcdecl_end(void);

/// Begins a call of the shader of that declaration.
miBoolean mi_api_function_call(const char* declaration);
/// Names the parameter that the next values are for.
miBoolean mi_api_parameter_name(const char* name);
/// Sets a value of the parameter. Colors and vectors may be set by one scalar a call; elements of
/// the scene by their name, a string, or by their tag.
miBoolean mi_api_parameter_value(miParam_type type, void* value, ...);
/// Opens a struct, or an array where is_array is miTRUE.
miBoolean mi_api_parameter_push(miBoolean is_array);
/// Closes the struct or array opened last.
miBoolean mi_api_parameter_pop(void);
/// Begins the next element of an array.
miBoolean mi_api_new_array_element(void);
/// Connects the parameter to the shader of that name.
miBoolean mi_api_parameter_shader(const char* name);
/// Connects the parameter to a parameter of the phenomenon around it.
miBoolean mi_api_parameter_interface(const char* name);
/// Ends a call; its tag. next: the call behind it in a list, or 0.
miTag mi_api_function_call_end(miTag next);
/// Chains a call behind a list of calls; the tag of the list.
miTag mi_api_function_append(miTag list, miTag next);
/// Tag of the shader of that name; 0 when there is none.
miTag mi_api_function_assign(const char* name);
/// Gives a call a name.
miBoolean mi_api_shader_add(const char* name, miTag call);

#ifdef __cplusplus
}
#endif

#endif
