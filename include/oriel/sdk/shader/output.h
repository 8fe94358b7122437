// SPDX-License-Identifier: Apache-2.0
// How does a shader write frame buffers, and reach the finished picture?
#ifndef ORIEL_SDK_OUTPUT_H
#define ORIEL_SDK_OUTPUT_H

// Conventions
//   Frame buffer n is the one that `frame buffer n` makes. A buffer's data is a miColor for rgba, a
//   miScalar for s and z, a miVector for n and m. Row 0 is the bottom row.

#include "image.h"
#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Eye rays: sets buffer fb of this sample; miFALSE, and nothing done, when there is none.
miBoolean mi_fb_put(miState* state, int fb, const void* data);
/// What this sample has in buffer fb.
miBoolean mi_fb_get(miState* state, int fb, void* data);
/// Output shaders: a buffer of the finished picture, miRC_IMAGE_*; NULL when there is none.
miImg_image* mi_output_image_open(miState* state, miUint index);
/// Ends mi_output_image_open.
void mi_output_image_close(miState* state, miUint index);

/// End of a contour line.
typedef struct miContour_endpoint {
  miVector point;  ///< raster space
  miColor color;
  miScalar width;  ///< percent of the picture's width
  miVector motion;
  miVector normal;
  miTag material;
  miUint label;
} miContour_endpoint;

typedef void (*miContour_Shader)(miContour_endpoint* endpoint, void* info_near, void* info_far,
                                 miState* state, void* paras);

/// What a contour store function keeps of a hit; the size that it wrote comes back.
typedef void (*miContour_Store_Function)(void* info, int* info_size, miState* state,
                                         miColor* color);
/// Whether there is a contour between two hits.
typedef miBoolean (*miContour_Contrast_Function)(const void* info_near, const void* info_far,
                                                 int level, miState* state, void* paras);

/// Output shaders: the next contour line; miFALSE when there is no more.
miBoolean mi_get_contour_line(miContour_endpoint* p1, miContour_endpoint* p2);
/// Contour shaders: adds n lines.
void mi_add_contour_lines(miContour_endpoint p1[], miContour_endpoint p2[], int n);

#ifdef __cplusplus
}
#endif

#endif
