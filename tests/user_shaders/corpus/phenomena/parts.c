/* SPDX-License-Identifier: Apache-2.0 */
/* Shaders for phenomena: a root, a node, a lens and an environment. */
#include <shader.h>

struct cp_root { miColor color; miScalar gain; int i_more, n_more; miColor more[1]; };

DLLEXPORT int cp_root_version(void) { return 1; }
DLLEXPORT miBoolean cp_root(miColor *result, miState *state, struct cp_root *paras)
{
    miColor  c = *mi_eval_color(&paras->color);
    miScalar gain = *mi_eval_scalar(&paras->gain);
    int      n = *mi_eval_integer(&paras->n_more), i = *mi_eval_integer(&paras->i_more);
    miColor *more;

    for (; n > 0; n--, i++) {
        more = mi_eval_color(&paras->more[i]);
        c.r += more->r;  c.g += more->g;  c.b += more->b;
    }
    result->r = c.r * gain;  result->g = c.g * gain;  result->b = c.b * gain;  result->a = 1;
    return miTRUE;
}

/* Two results: a colour and its inverse. */
struct cp_pair { miColor in; };
struct pair { miColor out; miColor inverse; };

DLLEXPORT int cp_pair_version(void) { return 1; }
DLLEXPORT miBoolean cp_pair(struct pair *result, miState *state, struct cp_pair *paras)
{
    miColor *c = mi_eval_color(&paras->in);
    result->out = *c;
    result->inverse.r = 1 - c->r;
    result->inverse.g = 1 - c->g;
    result->inverse.b = 1 - c->b;
    result->inverse.a = 1;
    return miTRUE;
}

struct cp_gel { miColor gel; };

DLLEXPORT int cp_gel_version(void) { return 1; }
DLLEXPORT miBoolean cp_gel(miColor *result, miState *state, struct cp_gel *paras)
{
    miColor *gel = mi_eval_color(&paras->gel);
    miBoolean hit = mi_trace_eye(result, state, &state->org, &state->dir);
    result->r *= gel->r;  result->g *= gel->g;  result->b *= gel->b;
    return hit;
}
