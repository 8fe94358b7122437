/* SPDX-License-Identifier: Apache-2.0 */
/* Refraction into a pane: the side that was hit distinguishes entry and exit. */
#include <shader.h>

struct cp_glass { miScalar ior; miColor tint; };

DLLEXPORT int cp_glass_version(void) { return 1; }

DLLEXPORT miBoolean cp_glass(miColor *result, miState *state, struct cp_glass *paras)
{
    miScalar ior = *mi_eval_scalar(&paras->ior);
    miVector dir;
    miColor *tint;
    miBoolean ok;

    if (state->inv_normal) {
        state->ior_in = ior;
        state->ior = 1;
    } else {
        state->ior_in = 1;
        state->ior = ior;
    }
    state->refraction_volume = state->camera->volume;
    if (state->ior == state->ior_in)
        ok = mi_trace_transparent(result, state);
    else if (mi_refraction_dir(&dir, state, state->ior_in, state->ior))
        ok = mi_trace_refraction(result, state, &dir);
    else {
        mi_reflection_dir(&dir, state);
        ok = mi_trace_reflection(result, state, &dir);
    }
    if (!ok)
        ok = mi_trace_environment(result, state, &dir);
    tint = mi_eval_color(&paras->tint);
    result->r *= tint->r;  result->g *= tint->g;  result->b *= tint->b;
    return ok;
}

/* Shows the x and y where it is met. */
DLLEXPORT int cp_place_version(void) { return 1; }
DLLEXPORT miBoolean cp_place(miColor *result, miState *state, void *paras)
{
    result->r = state->point.x * .1f;
    result->g = state->point.y * .1f;
    result->b = state->refraction_level * .25f;
    result->a = 1;
    return miTRUE;
}
