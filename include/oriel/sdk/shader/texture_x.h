// SPDX-License-Identifier: Apache-2.0
// Texture lookups with a filter.
#ifndef ORIEL_SDK_TEXTURE_X_H
#define ORIEL_SDK_TEXTURE_X_H

// Conventions
//   The filter covers the pixel on the hit surface, around the coordinate. With NULL, a texture
//   shader, or a point without texture coordinates: like the functions of texture.h without _x.

#include "texture.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Like mi_lookup_color_texture, with a filter.
miBoolean mi_lookup_color_texture_x(miColor* result, miState* state, miTag tag,
                                    const miVector* coord, const miTexfilter* filter);
/// Like mi_lookup_scalar_texture, with a filter.
miBoolean mi_lookup_scalar_texture_x(miScalar* result, miState* state, miTag tag,
                                     const miVector* coord, const miTexfilter* filter);
/// Like mi_lookup_vector_texture, with a filter.
miBoolean mi_lookup_vector_texture_x(miVector* result, miState* state, miTag tag,
                                     const miVector* coord, const miTexfilter* filter);

#ifdef __cplusplus
}
#endif

#endif
