/* SPDX-License-Identifier: Apache-2.0 */
/* What the shaders of a library share. */
#ifndef CPLIB_H
#define CPLIB_H

#include <shader.h>
#include "color/mix.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const miColor cplib_black;

miScalar cplib_clamp(miScalar v, miScalar lo, miScalar hi);
miScalar cplib_step(miScalar from, miScalar to, miScalar at);

#ifdef __cplusplus
}
#endif

#endif
