/* SPDX-License-Identifier: Apache-2.0 */
/* An environment of three colours by the height of the direction. */
#include <shader.h>

struct cp_gradient { miColor below, horizon, above; };

static void between(miColor *r, const miColor *a, const miColor *b, miScalar t)
{
    r->r = a->r + (b->r - a->r) * t;
    r->g = a->g + (b->g - a->g) * t;
    r->b = a->b + (b->b - a->b) * t;
    r->a = 1;
}

DLLEXPORT int cp_gradient_version(void) { return 1; }

DLLEXPORT miBoolean cp_gradient(miColor *result, miState *state, struct cp_gradient *paras)
{
    miVector dir;
    mi_vector_to_world(state, &dir, &state->dir);
    if (dir.y >= 0)
        between(result, mi_eval_color(&paras->horizon), mi_eval_color(&paras->above), dir.y);
    else
        between(result, mi_eval_color(&paras->horizon), mi_eval_color(&paras->below), -dir.y);
    return miTRUE;
}
