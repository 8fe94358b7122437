// SPDX-License-Identifier: Apache-2.0
// Texture lookups, and geometry data of the hit.
#ifndef ORIEL_SDK_TEXTURE_H
#define ORIEL_SDK_TEXTURE_H

// Conventions
//   A texture is the tag of an image, whose coordinates repeat from 0 to 1, or of a texture shader,
//   which receives the coordinate in state->tex. miFALSE: no such texture.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Settings of filtered lookups; NULL = the defaults.
typedef struct miTexfilter {
  miScalar eccmax;         ///< maximum ratio of the axes of the ellipse
  miScalar max_minor;      ///< maximum minor axis, texels
  miScalar circle_radius;  ///< radius of the disc on the screen, pixels
  miBoolean bilinear;
  miScalar spare[10];
} miTexfilter;

/// Colour at a coordinate.
miBoolean mi_lookup_color_texture(miColor* result, miState* state, miTag tag,
                                  const miVector* coord);
/// Scalar at a coordinate.
miBoolean mi_lookup_scalar_texture(miScalar* result, miState* state, miTag tag,
                                   const miVector* coord);
/// Vector at a coordinate.
miBoolean mi_lookup_vector_texture(miVector* result, miState* state, miTag tag,
                                   const miVector* coord);
/// Mean colour over the ellipse to which ST (screen to texture) maps a disc.
miBoolean mi_lookup_filter_color_texture(miColor* result, miState* state, miTag tag,
                                         const miTexfilter* filter, miMatrix ST);
/// Three points p around the hit, disc_r pixels apart, and their coordinates t in a space.
miBoolean mi_texture_filter_project(miVector p[3], miVector t[3], miState* state, miScalar disc_r,
                                    miUint space);
/// The matrix from the screen to the texture that maps p to t.
miBoolean mi_texture_filter_transform(miMatrix ST, miVector p[3], miVector t[3]);
/// Pixels of an image, or 0 and the parameters of a texture shader; NULL = not requested.
void mi_texture_info(miTag tag, int* xres, int* yres, void** paras);
/// Interpolates the texture coordinates of a space at the hit.
miBoolean mi_texture_interpolate(miState* state, miUint space, miScalar* result);
/// The hit triangle's vectors: 'p' points, 'n' normals, 'm' motion, 't' coordinates, 'u' 'v' bump.
miBoolean mi_tri_vectors(const miState* state, int which, int ntex, const miVector** a,
                         const miVector** b, const miVector** c);

#ifdef __cplusplus
}
#endif

#endif
