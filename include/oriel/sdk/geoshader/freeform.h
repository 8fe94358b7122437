// SPDX-License-Identifier: Apache-2.0
// Free-form surfaces made by geometry shaders.
#ifndef ORIEL_SDK_FREEFORM_H
#define ORIEL_SDK_FREEFORM_H

// Conventions
//   Bases are defined between mi_api_object_begin and the group, surfaces in the group after its
//   vertices. A surface: begin, params of u and of v, a vertex_ref_add for each control point (u
//   varies fastest), textures with their control points, end. Lists of numbers are copied.

#include "approx.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Directions of mi_api_surface_params.
#define miU 0
#define miV 1

typedef enum miBasis_type {
  miBASIS_BEZIER = 0,
  miBASIS_BSPLINE,
  miBASIS_TAYLOR,
  miBASIS_CARDINAL,
  miBASIS_MATRIX
} miBasis_type;

typedef enum miDlist_type { miDLIST_GEOSCALAR = 0, miDLIST_TAG, miDLIST_POINTER } miDlist_type;

/// A growable list; opaque.
typedef struct miDlist miDlist;

/// Creates an empty list.
miDlist* mi_api_dlist_create(miDlist_type type);
/// Appends a copy of a miGeoScalar or miTag, or a pointer itself.
miBoolean mi_api_dlist_add(miDlist* list, void* value);
/// Deletes a list; NULL is ignored.
void mi_api_dlist_delete(miDlist* list);

/// As mi_api_vector_xyz_add, from doubles.
miBoolean mi_api_geovector_xyz_add(const miGeoVector* v);
/// Adds a basis to the open object. step and matrix (numbers) apply to miBASIS_MATRIX.
miBoolean mi_api_basis_add(const char* name, miBoolean rational, miBasis_type type, int degree,
                           int step, miDlist* matrix);
/// Begins a surface; material: NULL = that of the instance.
miBoolean mi_api_surface_begin(const char* name, const char* material);
/// Basis, range and knots of the open surface in a direction, miU or miV.
miBoolean mi_api_surface_params(int direction, const char* basis, double min, double max,
                                miDlist* knots, miBoolean rational);
/// Adds a control point to the open surface, or to its last texture.
miBoolean mi_api_vertex_ref_add(int vertex, double weight);
/// Begins a texture surface of the open surface. bump: the first of two with bump basis vectors.
miBoolean mi_api_surface_texture_begin(miBoolean volume, miBoolean bump, const char* basis_u,
                                       miDlist* u, miBoolean rational_u, const char* basis_v,
                                       miDlist* v, miBoolean rational_v);
/// Ends a surface.
miBoolean mi_api_surface_end(void);

#ifdef __cplusplus
}
#endif

#endif
