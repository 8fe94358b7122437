// SPDX-License-Identifier: Apache-2.0
// How does a geometry shader make objects? Other elements: shader/elements.h, shader/declare.h.
#ifndef ORIEL_SDK_GEOSHADER_H
#define ORIEL_SDK_GEOSHADER_H

// Conventions
//   Names are made with mi_mem_strdup; the API takes them over and frees them. An object: begin,
//   basis_list_clear, group begin, all vectors, then vertices as indices of vectors, then polygons
//   as indices of vertices, group end, end. Indices count from 0. Only geometry shaders (and
//   callbacks of placeholders) may call these.

#include "shader.h"
#include "shader/declare.h"
#include "shader/elements.h"

#ifdef __cplusplus
extern "C" {
#endif

#define miNAMESIZE 80
#define miPATHSIZE 1024

/// A polygonal object while it is made. Set its members between begin and end.
typedef struct miObject {
  int type;
  miBoolean visible, shadow;
  miUchar reflection, refraction, transparency;
  miUchar caustic, globillum, finalgather;  ///< bit 0 casts, bit 1 receives
  char face;                                ///< 'f', 'b', 'a'
  miBoolean select;
  miScalar maxdisplace;
  miTag userdata;
  miUint label;
  miVector bbox_min, bbox_max;      ///< object space
  miVector bbox_min_m, bbox_max_m;  ///< with motion
  miBoolean mbox_explicit;
  int min_samples, max_samples;
  double ray_offset;
} miObject;

/// How finely a surface is divided; all zero = as the object's own.
typedef struct miApprox {
  int kind;         ///< 0 default, 1 none, 2 fine
  miScalar length;  ///< edges at most, pixels where `view` is set
  miCBoolean view;
  int min_level, max_level;
} miApprox;

/// Makes the miApprox variable `a` the object's own.
#define miAPPROX_DEFAULT(a) \
  ((a).kind = 0, (a).length = 0, (a).view = 0, (a).min_level = 0, (a).max_level = 0)
/// Makes the miApprox variable `a` none.
#define miAPPROX_NONE(a) \
  ((a).kind = 1, (a).length = 0, (a).view = 0, (a).min_level = 0, (a).max_level = 0)
/// Makes the miApprox variable `a` a quarter of a pixel.
#define miAPPROX_FINE_DEFAULT(a) \
  ((a).kind = 2, (a).length = 0.25f, (a).view = 1, (a).min_level = 0, (a).max_level = 7)

/// Makes the content of a placeholder; `args` is what was given with it.
typedef miBoolean (*miGeoshader_callback)(miTag tag, void* args);

/// Adds an object, instance, group or light to what the geometry shader returns.
miBoolean mi_geoshader_add_result(miTag* result, miTag tag);

/// Begins an object.
miObject* mi_api_object_begin(const char* name);
/// Ends an object; its tag.
miTag mi_api_object_end(void);
/// Forgets the bases of curves and surfaces.
miBoolean mi_api_basis_list_clear(void);
/// Begins the geometry of an object; merge: distance in which surfaces join, 0 = none.
miBoolean mi_api_object_group_begin(double merge);
/// Ends the geometry of an object.
miBoolean mi_api_object_group_end(void);
/// Adds a vector: point, normal, motion or texture coordinate, object space.
miBoolean mi_api_vector_xyz_add(const miVector* v);
/// Adds a vertex at a point.
miBoolean mi_api_vertex_add(int point);
/// Gives the last vertex a normal.
miBoolean mi_api_vertex_normal_add(int normal);
/// Gives the last vertex a texture coordinate and a bump basis; -1 = none.
miBoolean mi_api_vertex_tex_add(int coordinate, int bump_x, int bump_y);
/// Gives the last vertex a motion vector.
miBoolean mi_api_vertex_motion_add(int motion);
/// Begins a polygon; convex: 1 if it is so for sure. material: 0 = of the instance.
miBoolean mi_api_poly_begin_tag(int convex, miTag material);
/// Adds a vertex to the polygon.
miBoolean mi_api_poly_index_add(int vertex);
/// Begins a hole in the polygon.
miBoolean mi_api_poly_hole_add(void);
/// Ends a polygon.
miBoolean mi_api_poly_end(void);
/// Has a callback make the object's content when it is needed.
miBoolean mi_api_object_callback(miGeoshader_callback callback, void* args);
/// Whether elements of a known name replace it from here on.
miBoolean mi_api_incremental(miBoolean on);

#ifdef __cplusplus
}
#endif

#endif
