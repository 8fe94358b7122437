// SPDX-License-Identifier: Apache-2.0
// Random numbers and noise.
#ifndef ORIEL_SDK_SAMPLE_H
#define ORIEL_SDK_SAMPLE_H

// Conventions
//   Random numbers are in [0,1). Noise is in 0..1: mi_noise_* is concentrated around 0.5,
//   mi_unoise_* is about uniformly distributed. Gradients are not normalised.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A point of dim dimensions. instance and n NULL: one; n NULL: infinite loop; else miTRUE n times.
miBoolean mi_sample(double* sample, int* instance, miState* state, miUshort dim, const miUint* n);
/// A random number of this sample, reproducible.
double mi_par_random(miState* state);
/// A random number that does not depend on the sample.
miScalar mi_random(void);
/// A random number from a seed, which is advanced.
miScalar mi_erandom(unsigned short seed[3]);
/// Seeds mi_random.
void mi_srandom(long seed);
/// 1D noise.
miScalar mi_noise_1d(miScalar x);
/// 2D noise.
miScalar mi_noise_2d(miScalar x, miScalar y);
/// 3D noise.
miScalar mi_noise_3d(const miVector* p);
/// Uniformly distributed 1D noise.
miScalar mi_unoise_1d(miScalar x);
/// Uniformly distributed 2D noise.
miScalar mi_unoise_2d(miScalar x, miScalar y);
/// Uniformly distributed 3D noise.
miScalar mi_unoise_3d(const miVector* p);
/// 1D noise and its derivative.
miScalar mi_noise_1d_grad(miScalar x, miScalar* g);
/// 2D noise and its gradient.
miScalar mi_noise_2d_grad(miScalar x, miScalar y, miScalar* gx, miScalar* gy);
/// 3D noise and its gradient.
miScalar mi_noise_3d_grad(const miVector* p, miVector* g);
/// Uniformly distributed 1D noise and its derivative.
miScalar mi_unoise_1d_grad(miScalar x, miScalar* g);
/// Uniformly distributed 2D noise and its gradient.
miScalar mi_unoise_2d_grad(miScalar x, miScalar y, miScalar* gx, miScalar* gy);
/// Uniformly distributed 3D noise and its gradient.
miScalar mi_unoise_3d_grad(const miVector* p, miVector* g);
/// Cardinal spline through n >= 2 control points; t from 0 to 1.
miScalar mi_spline(miScalar t, int n, const miScalar* ctl);

#ifdef __cplusplus
}
#endif

#endif
