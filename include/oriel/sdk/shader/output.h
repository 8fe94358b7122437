// SPDX-License-Identifier: Apache-2.0
// Frame buffers, and access to the finished picture.
#ifndef ORIEL_SDK_OUTPUT_H
#define ORIEL_SDK_OUTPUT_H

// Conventions
//   Frame buffer n is defined by `frame buffer n`. The data of a buffer is a miColor for rgba, a
//   miScalar for s and z, a miVector for n and m. Row 0 is the bottom row.

#include "image.h"
#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Eye rays: sets buffer fb of this sample; returns miFALSE if there is none.
miBoolean mi_fb_put(miState* state, int fb, const void* data);
/// Value of this sample in buffer fb.
miBoolean mi_fb_get(miState* state, int fb, void* data);
/// Output shaders: a buffer of the finished picture, miRC_IMAGE_*; NULL if there is none.
miImg_image* mi_output_image_open(miState* state, miUint index);
/// Ends mi_output_image_open.
void mi_output_image_close(miState* state, miUint index);

/// End of a contour line.
typedef struct miContour_endpoint {
  miVector point;  ///< raster space
  miColor color;
  miScalar width;  ///< percent of the picture width
  miVector motion;
  miVector normal;
  miTag material;
  miUint label;
} miContour_endpoint;

typedef void (*miContour_Shader)(miContour_endpoint* endpoint, void* info_near, void* info_far,
                                 miState* state, void* paras);

/// Stores contour data of a hit, and returns its size.
typedef void (*miContour_Store_Function)(void* info, int* info_size, miState* state,
                                         miColor* color);
/// Whether there is a contour between two hits.
typedef miBoolean (*miContour_Contrast_Function)(const void* info_near, const void* info_far,
                                                 int level, miState* state, void* paras);

/// Output shaders: the next contour line; miFALSE after the last one.
miBoolean mi_get_contour_line(miContour_endpoint* p1, miContour_endpoint* p2);
/// Contour shaders: adds n lines.
void mi_add_contour_lines(miContour_endpoint p1[], miContour_endpoint p2[], int n);

#ifdef __cplusplus
}
#endif

#endif
