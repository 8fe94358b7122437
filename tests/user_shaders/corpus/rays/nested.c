/* SPDX-License-Identifier: Apache-2.0 */
/* Probes from hit to hit along the ray: how many surfaces are behind this one, and how far. */
#include <shader.h>

struct cp_nested { miInteger most; miScalar scale; miBoolean loop; };

typedef struct { int n; double way; miVector last; } found_t;

DLLEXPORT int cp_nested_version(void) { return 1; }

/* Each probe is cast from the state of the one before it. */
static miBoolean inner(miState *state, int most, found_t *found)
{
    miState *child;

    if (most <= 0 || !mi_trace_probe(state, &state->dir, &state->point))
        return miTRUE;
    child = state->child;
    if (!child || child->dist <= 0 || child->parent != state)
        return miFALSE;
    found->n++;
    found->way += child->dist;
    found->last = child->point;
    return inner(child, most - 1, found);
}

/* The same with one state, from its child's point. */
static miBoolean along(miState *state, int most, found_t *found)
{
    miVector org = state->point;

    while (most-- > 0 && mi_trace_probe(state, &state->dir, &org)) {
        if (!state->child || state->child->dist <= 0)
            return miFALSE;
        found->n++;
        found->way += mi_vector_dist(&org, &state->child->point);
        org = found->last = state->child->point;
    }
    return most < 0 || state->child->dist == 0;     /* after a miss */
}

DLLEXPORT miBoolean cp_nested(miColor *result, miState *state, struct cp_nested *paras)
{
    int most = *mi_eval_integer(&paras->most);
    found_t found;

    found.n = 0;
    found.way = 0;
    found.last = state->point;
    if (!(*mi_eval_boolean(&paras->loop) ? along : inner)(state, most, &found))
        return miFALSE;
    result->r = found.n * 0.125f;
    result->g = (miScalar)found.way * *mi_eval_scalar(&paras->scale);
    result->b = -found.last.z * .125f;
    result->a = 1;
    return miTRUE;
}
