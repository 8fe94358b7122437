/* SPDX-License-Identifier: Apache-2.0 */
/* From one colour to another as the surface turns away. */
#include <shader.h>

struct cp_facing { miColor front; miColor side; miScalar power; };

#define CLAMP01(x) ((x) < 0.0 ? 0.0 : (x) > 1.0 ? 1.0 : (x))
#define BLEND(f, a, b) ((a) * (1.0 - (f)) + (b) * (f))

DLLEXPORT int cp_facing_version(void) { return 1; }

DLLEXPORT miBoolean cp_facing(miColor *result, miState *state, struct cp_facing *paras)
{
    double   f = CLAMP01(-state->dot_nd);
    miColor *a, *b;

    f = pow(1.0 - f, (double)*mi_eval_scalar(&paras->power));
    /* The colour that is not seen is not evaluated. */
    if (f <= 0.0) { *result = *mi_eval_color(&paras->front); return miTRUE; }
    if (f >= 1.0) { *result = *mi_eval_color(&paras->side); return miTRUE; }
    a = mi_eval_color(&paras->front);
    b = mi_eval_color(&paras->side);
    result->r = BLEND(f, a->r, b->r);
    result->g = BLEND(f, a->g, b->g);
    result->b = BLEND(f, a->b, b->b);
    result->a = 1.0;
    return miTRUE;
}
