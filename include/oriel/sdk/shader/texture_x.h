// SPDX-License-Identifier: Apache-2.0
// What does a texture show under a filter that the shader gives?
#ifndef ORIEL_SDK_TEXTURE_X_H
#define ORIEL_SDK_TEXTURE_X_H

// Conventions
//   The filter lies over the pixel on the hit surface, around the coordinate. NULL, a texture
//   shader or a point without texture coordinates: as the functions of texture.h without _x.

#include "texture.h"

#ifdef __cplusplus
extern "C" {
#endif

/// As mi_lookup_color_texture, with a filter.
miBoolean mi_lookup_color_texture_x(miColor* result, miState* state, miTag tag,
                                    const miVector* coord, const miTexfilter* filter);
/// As mi_lookup_scalar_texture, with a filter.
miBoolean mi_lookup_scalar_texture_x(miScalar* result, miState* state, miTag tag,
                                     const miVector* coord, const miTexfilter* filter);
/// As mi_lookup_vector_texture, with a filter.
miBoolean mi_lookup_vector_texture_x(miVector* result, miState* state, miTag tag,
                                     const miVector* coord, const miTexfilter* filter);

#ifdef __cplusplus
}
#endif

#endif
