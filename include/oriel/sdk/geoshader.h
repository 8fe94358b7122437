// SPDX-License-Identifier: Apache-2.0
// Objects made by geometry shaders. Other elements: shader/elements.h, shader/declare.h.
#ifndef ORIEL_SDK_GEOSHADER_H
#define ORIEL_SDK_GEOSHADER_H

// Conventions
//   Names are allocated with mi_mem_strdup; the API takes ownership and frees them. An object:
//   begin, basis_list_clear, group begin, all vectors, then vertices as indices of vectors, then
//   polygons as indices of vertices, group end, end. Indices count from 0. Only geometry shaders
//   (and callbacks of placeholders) may call these.

#include "geoshader/approx.h"
#include "geoshader/freeform.h"
#include "geoshader/hair.h"
#include "geoshader/map.h"
#include "geoshader/object.h"
#include "shader.h"
#include "shader/declare.h"
#include "shader/elements.h"

#ifdef __cplusplus
extern "C" {
#endif

#define miNAMESIZE 80
#define miPATHSIZE 1024

/// Adds an object, instance, group or light to what the geometry shader returns.
miBoolean mi_geoshader_add_result(miTag* result, miTag tag);

/// Options of mi_geoshader_echo_tag.
typedef struct miEchoOptions {
  miBoolean ascii_output;       ///< numbers as text
  miBoolean compressed_output;  ///< numbers as hexadecimal bytes
  miBoolean dont_echo;          ///< nothing is written
} miEchoOptions;

/// Writes an element and all elements below it as scene text. Unsupported: warns, returns miFALSE.
miBoolean mi_geoshader_echo_tag(FILE* file, miTag tag, miEchoOptions* options);

/// Removes the bases of curves and surfaces.
miBoolean mi_api_basis_list_clear(void);
/// Begins the geometry of an object; merge: distance within which surfaces are joined, 0 = none.
miBoolean mi_api_object_group_begin(double merge);
/// Ends the geometry of an object.
miBoolean mi_api_object_group_end(void);
/// Adds a vector in object space: point, normal, motion or texture coordinate.
miBoolean mi_api_vector_xyz_add(const miVector* v);
/// Adds a vertex at a point.
miBoolean mi_api_vertex_add(int point);
/// Sets the normal of the last vertex.
miBoolean mi_api_vertex_normal_add(int normal);
/// Sets a texture coordinate and a bump basis of the last vertex; -1 = none.
miBoolean mi_api_vertex_tex_add(int coordinate, int bump_x, int bump_y);
/// Sets the motion vector of the last vertex.
miBoolean mi_api_vertex_motion_add(int motion);
/// Begins a polygon; convex: 1 if it is known to be convex. material: 0 = that of the instance.
miBoolean mi_api_poly_begin_tag(int convex, miTag material);
/// Adds a vertex to the polygon.
miBoolean mi_api_poly_index_add(int vertex);
/// Begins a hole in the polygon.
miBoolean mi_api_poly_hole_add(void);
/// Ends a polygon.
miBoolean mi_api_poly_end(void);

#ifdef __cplusplus
}
#endif

#endif
