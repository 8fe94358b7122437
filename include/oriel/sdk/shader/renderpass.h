// SPDX-License-Identifier: Apache-2.0
// Render pass files, which are unsupported.
#ifndef ORIEL_SDK_RENDERPASS_H
#define ORIEL_SDK_RENDERPASS_H

// Conventions
//   All functions return the result for a missing pass and warn at the first call.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The sample of a pass (-1: the result) in a frame buffer; always NULL.
void* mi_renderpass_access(miState* state, int pass, int fb);
/// Position and size of a tile of a pass, and the resolution; all 0, returns miFALSE.
miBoolean mi_renderpass_resolution(int* xl, int* yl, int* xs, int* ys, int* xres, int* yres,
                                   miState* state, int pass, int fb);
/// Reads a sample of a pass; always returns miFALSE and leaves result unchanged.
miBoolean mi_renderpass_sample_get(void* result, int size, miState* state, int fb, int x, int y);
/// Writes a sample of a pass; always returns miFALSE.
miBoolean mi_renderpass_sample_put(const void* sample, int size, miState* state, int fb, int x,
                                   int y);
/// Whether a tile of a pass is black; always miFALSE.
miBoolean mi_renderpass_samplerect_black(miState* state, int pass, int x, int y);
/// Ends work on a tile of a pass; always miFALSE.
miBoolean mi_renderpass_samplerect_flush(miState* state, int pass, int x, int y);

#ifdef __cplusplus
}
#endif

#endif
