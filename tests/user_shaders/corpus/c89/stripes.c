/* SPDX-License-Identifier: Apache-2.0 */
/* Stripes over a coordinate; one source for several systems. */
#if defined(WIN_NT) || defined(_WIN32)
#pragma warning(disable : 4244)
#pragma warning(disable : 4305)
#define EXPORT __declspec(dllexport)
#else
#define EXPORT
#endif

#ifdef IRIX
#include <ieeefp.h>
#endif
#include "..\..\include\shader.h"

typedef struct {
    miVector coord;
    miScalar number, duty;
    miColor  on, off;
} cp_stripes_t;

/* Between 0 and 1, also of negative numbers. */
static miScalar wrap(miScalar x) { return x - (miScalar)floor((double)x); }

#ifdef __cplusplus
extern "C" {
#endif

EXPORT int cp_stripes_version(void) { return(1); }

EXPORT miBoolean cp_stripes(miColor *result, miState *state, cp_stripes_t *paras)
{
    miVector *coord = mi_eval_vector(&paras->coord);
    miScalar at = wrap(coord->x * *mi_eval_scalar(&paras->number));

    if (at < *mi_eval_scalar(&paras->duty))
        *result = *mi_eval_color(&paras->on);
    else
        *result = *mi_eval_color(&paras->off);
    return(miTRUE);
}

#ifdef __cplusplus
}
#endif
