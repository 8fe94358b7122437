// SPDX-License-Identifier: Apache-2.0
// Conversion of points, vectors and normals between spaces.
#ifndef ORIEL_SDK_SPACE_H
#define ORIEL_SDK_SPACE_H

// Conventions
//   The other space is internal space. Object space is that of state->instance, light space that of
//   state->light_instance. Translation applies to points only. Normals are transformed by the
//   inverse transpose and are not normalised. result may be in. Raster: (0,0) is the lower left
//   corner, the centre of the first pixel is (.5, .5).

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Transforms a point from internal to world space.
void mi_point_to_world(const miState* state, miVector* result, const miVector* in);
/// Transforms a point from world to internal space.
void mi_point_from_world(const miState* state, miVector* result, const miVector* in);
/// Transforms a vector from internal to world space.
void mi_vector_to_world(const miState* state, miVector* result, const miVector* in);
/// Transforms a vector from world to internal space.
void mi_vector_from_world(const miState* state, miVector* result, const miVector* in);
/// Transforms a normal from internal to world space.
void mi_normal_to_world(const miState* state, miVector* result, const miVector* in);
/// Transforms a normal from world to internal space.
void mi_normal_from_world(const miState* state, miVector* result, const miVector* in);
/// Transforms a point from internal to camera space.
void mi_point_to_camera(const miState* state, miVector* result, const miVector* in);
/// Transforms a point from camera to internal space.
void mi_point_from_camera(const miState* state, miVector* result, const miVector* in);
/// Transforms a vector from internal to camera space.
void mi_vector_to_camera(const miState* state, miVector* result, const miVector* in);
/// Transforms a vector from camera to internal space.
void mi_vector_from_camera(const miState* state, miVector* result, const miVector* in);
/// Transforms a normal from internal to camera space.
void mi_normal_to_camera(const miState* state, miVector* result, const miVector* in);
/// Transforms a normal from camera to internal space.
void mi_normal_from_camera(const miState* state, miVector* result, const miVector* in);
/// Transforms a point from internal to object space.
void mi_point_to_object(const miState* state, miVector* result, const miVector* in);
/// Transforms a point from object to internal space.
void mi_point_from_object(const miState* state, miVector* result, const miVector* in);
/// Transforms a vector from internal to object space.
void mi_vector_to_object(const miState* state, miVector* result, const miVector* in);
/// Transforms a vector from object to internal space.
void mi_vector_from_object(const miState* state, miVector* result, const miVector* in);
/// Transforms a normal from internal to object space.
void mi_normal_to_object(const miState* state, miVector* result, const miVector* in);
/// Transforms a normal from object to internal space.
void mi_normal_from_object(const miState* state, miVector* result, const miVector* in);
/// Transforms a point from internal to light space.
void mi_point_to_light(const miState* state, miVector* result, const miVector* in);
/// Transforms a point from light to internal space.
void mi_point_from_light(const miState* state, miVector* result, const miVector* in);
/// Transforms a vector from internal to light space.
void mi_vector_to_light(const miState* state, miVector* result, const miVector* in);
/// Transforms a vector from light to internal space.
void mi_vector_from_light(const miState* state, miVector* result, const miVector* in);
/// Transforms a normal from internal to light space.
void mi_normal_to_light(const miState* state, miVector* result, const miVector* in);
/// Transforms a normal from light to internal space.
void mi_normal_from_light(const miState* state, miVector* result, const miVector* in);
/// Projects a point from internal space to raster space, pixels.
void mi_point_to_raster(const miState* state, miVector* result, const miVector* in);
/// Size of a pixel along x and y at the hit point, object space.
miBoolean mi_raster_unit(const miState* state, miVector* x, miVector* y);

#ifdef __cplusplus
}
#endif

#endif
