// SPDX-License-Identifier: Apache-2.0
// Which random number is it, and what does noise look like?
#ifndef ORIEL_SDK_SAMPLE_H
#define ORIEL_SDK_SAMPLE_H

// Conventions
//   Random numbers lie in [0,1). Noise lies in 0..1: mi_noise_* around 0.5, mi_unoise_* about
//   evenly spread. Gradients are not unit.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A point of dim dimensions. instance and n NULL: one; n NULL: endless; else miTRUE n times.
miBoolean mi_sample(double* sample, int* instance, miState* state, miUshort dim, const miUint* n);
/// A number of this sample: the same in each rendering.
double mi_par_random(miState* state);
/// A number that no sample decides.
miScalar mi_random(void);
/// A number from a seed, which moves on.
miScalar mi_erandom(unsigned short seed[3]);
/// Starts mi_random anew.
void mi_srandom(long seed);
/// Noise along a line.
miScalar mi_noise_1d(miScalar x);
/// Noise in a plane.
miScalar mi_noise_2d(miScalar x, miScalar y);
/// Noise in space.
miScalar mi_noise_3d(const miVector* p);
/// Even noise along a line.
miScalar mi_unoise_1d(miScalar x);
/// Even noise in a plane.
miScalar mi_unoise_2d(miScalar x, miScalar y);
/// Even noise in space.
miScalar mi_unoise_3d(const miVector* p);
/// Noise along a line and its slope.
miScalar mi_noise_1d_grad(miScalar x, miScalar* g);
/// Noise in a plane and its gradient.
miScalar mi_noise_2d_grad(miScalar x, miScalar y, miScalar* gx, miScalar* gy);
/// Noise in space and its gradient.
miScalar mi_noise_3d_grad(const miVector* p, miVector* g);
/// Even noise along a line and its slope.
miScalar mi_unoise_1d_grad(miScalar x, miScalar* g);
/// Even noise in a plane and its gradient.
miScalar mi_unoise_2d_grad(miScalar x, miScalar y, miScalar* gx, miScalar* gy);
/// Even noise in space and its gradient.
miScalar mi_unoise_3d_grad(const miVector* p, miVector* g);
/// Cardinal spline through n control points, 2 or more; t from 0 to 1.
miScalar mi_spline(miScalar t, int n, const miScalar* ctl);

#ifdef __cplusplus
}
#endif

#endif
