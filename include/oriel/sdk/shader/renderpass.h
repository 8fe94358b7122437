// SPDX-License-Identifier: Apache-2.0
// What do files of render passes hold? Oriel neither reads nor writes them.
#ifndef ORIEL_SDK_RENDERPASS_H
#define ORIEL_SDK_RENDERPASS_H

// Conventions
//   All answer as for a pass that is not there, and the first call of each warns.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The sample of a pass (-1: the result) in a frame buffer; always NULL.
void* mi_renderpass_access(miState* state, int pass, int fb);
/// Place and size of a tile of a pass, and the resolution; all 0, and miFALSE.
miBoolean mi_renderpass_resolution(int* xl, int* yl, int* xs, int* ys, int* xres, int* yres,
                                   miState* state, int pass, int fb);
/// Reads a sample of a pass; always miFALSE, and result as it was.
miBoolean mi_renderpass_sample_get(void* result, int size, miState* state, int fb, int x, int y);
/// Writes a sample of a pass; always miFALSE.
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
