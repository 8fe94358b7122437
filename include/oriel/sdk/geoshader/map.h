// SPDX-License-Identifier: Apache-2.0
// Particles made by geometry shaders: positions with values, rendered as spheres or tubes.
#ifndef ORIEL_SDK_MAP_H
#define ORIEL_SDK_MAP_H

// Conventions
//   A declaration: decl_dim, fields, decl_begin, decl_end. An object: mi_api_object_begin,
//   obj_type, obj_field for each value of the shape, map_begin, particles, map_end,
//   mi_api_object_end. A particle: the values of its position, field_end, the values of each field
//   that is not global, each with its field_end, element_end. Values of global fields precede the
//   first particle.

#include "../shader/enums.h"
#include "../shader/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A field or a list of fields; opaque.
struct miParameter;
/// A declaration; opaque.
typedef struct miMap_decl miMap_decl;

/// Number of coordinates of a position, 1 to 6 (default 3).
miBoolean mi_api_map_decl_dim(int dim);
/// A field of type miTYPE_SCALAR or miTYPE_INTEGER. dimension: 0 one value, else an array.
/// global: one value for the map.
struct miParameter* mi_api_map_field_decl(miParam_type type, const char* name, int dimension,
                                          miBoolean global);
/// Appends a field to a list, which is represented by any of its fields.
struct miParameter* mi_api_map_field_append(struct miParameter* list, struct miParameter* field);
/// Begins a declaration.
miMap_decl* mi_api_map_decl_begin(const char* name, struct miParameter* fields);
/// Ends a declaration.
void mi_api_map_decl_end(void);

/// Shape of the particles of the open object: "spheres" or "tubes".
miBoolean mi_api_map_obj_type(const char* type);
/// Connects a shape attribute to a field: "radius"; for tubes also "radius0", "radius1", "length",
/// "direction".
miBoolean mi_api_map_obj_field(const char* shape_field, const char* map_field);
/// Begins a map with that declaration.
miBoolean mi_api_map_begin(const char* declaration);
/// Adds a value.
miBoolean mi_api_map_value(miParam_type type, void* value);
/// Ends a position or a field.
void mi_api_map_field_end(void);
/// Ends a particle.
void mi_api_map_element_end(void);
/// Ends a map and returns its tag, which only shows that a map exists. Pass 0.
miTag mi_api_map_end(int reserved);

#ifdef __cplusplus
}
#endif

#endif
