// SPDX-License-Identifier: Apache-2.0
// How does a point, vector or normal look in another space?
#ifndef ORIEL_SDK_SPACE_H
#define ORIEL_SDK_SPACE_H

// Conventions
//   The other side is internal space. Object space is that of state->instance, light space that of
//   state->light_instance. Points are moved, vectors are not, normals go through the inverse
//   transpose and are not made unit. result may be in. Raster: (0,0) is the lower left corner, the
//   first pixel's centre (.5, .5).

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A point of internal space in world space.
void mi_point_to_world(const miState* state, miVector* result, const miVector* in);
/// A point of world space in internal space.
void mi_point_from_world(const miState* state, miVector* result, const miVector* in);
/// A vector of internal space in world space.
void mi_vector_to_world(const miState* state, miVector* result, const miVector* in);
/// A vector of world space in internal space.
void mi_vector_from_world(const miState* state, miVector* result, const miVector* in);
/// A normal of internal space in world space.
void mi_normal_to_world(const miState* state, miVector* result, const miVector* in);
/// A normal of world space in internal space.
void mi_normal_from_world(const miState* state, miVector* result, const miVector* in);
/// A point of internal space in camera space.
void mi_point_to_camera(const miState* state, miVector* result, const miVector* in);
/// A point of camera space in internal space.
void mi_point_from_camera(const miState* state, miVector* result, const miVector* in);
/// A vector of internal space in camera space.
void mi_vector_to_camera(const miState* state, miVector* result, const miVector* in);
/// A vector of camera space in internal space.
void mi_vector_from_camera(const miState* state, miVector* result, const miVector* in);
/// A normal of internal space in camera space.
void mi_normal_to_camera(const miState* state, miVector* result, const miVector* in);
/// A normal of camera space in internal space.
void mi_normal_from_camera(const miState* state, miVector* result, const miVector* in);
/// A point of internal space in object space.
void mi_point_to_object(const miState* state, miVector* result, const miVector* in);
/// A point of object space in internal space.
void mi_point_from_object(const miState* state, miVector* result, const miVector* in);
/// A vector of internal space in object space.
void mi_vector_to_object(const miState* state, miVector* result, const miVector* in);
/// A vector of object space in internal space.
void mi_vector_from_object(const miState* state, miVector* result, const miVector* in);
/// A normal of internal space in object space.
void mi_normal_to_object(const miState* state, miVector* result, const miVector* in);
/// A normal of object space in internal space.
void mi_normal_from_object(const miState* state, miVector* result, const miVector* in);
/// A point of internal space in light space.
void mi_point_to_light(const miState* state, miVector* result, const miVector* in);
/// A point of light space in internal space.
void mi_point_from_light(const miState* state, miVector* result, const miVector* in);
/// A vector of internal space in light space.
void mi_vector_to_light(const miState* state, miVector* result, const miVector* in);
/// A vector of light space in internal space.
void mi_vector_from_light(const miState* state, miVector* result, const miVector* in);
/// A normal of internal space in light space.
void mi_normal_to_light(const miState* state, miVector* result, const miVector* in);
/// A normal of light space in internal space.
void mi_normal_from_light(const miState* state, miVector* result, const miVector* in);
/// A point of internal space in raster space, pixels.
void mi_point_to_raster(const miState* state, miVector* result, const miVector* in);
/// Size of a pixel along x and y at the hit point, object space.
miBoolean mi_raster_unit(const miState* state, miVector* x, miVector* y);

#ifdef __cplusplus
}
#endif

#endif
