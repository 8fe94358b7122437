/* SPDX-License-Identifier: Apache-2.0 */
/* A mirror that changes the state for its ray and restores it: volume, level, environment. */
#include <shader.h>

struct cp_mirror { miColor tint; };

DLLEXPORT int cp_mirror_version(void) { return 1; }

DLLEXPORT miBoolean cp_mirror(miColor *result, miState *state, struct cp_mirror *paras)
{
    miTag    volume = state->volume;
    miVector dir;
    miBoolean hit;
    miColor *tint;

    if (state->reflection_level >= state->options->reflection_depth) {
        result->r = result->g = result->b = 0;
        result->a = 1;
        return miTRUE;
    }
    state->volume = miNULLTAG;
    mi_reflection_dir(&dir, state);
    hit = mi_trace_reflection(result, state, &dir) ||
          mi_trace_environment(result, state, &dir);
    state->volume = volume;
    tint = mi_eval_color(&paras->tint);
    result->r *= tint->r;  result->g *= tint->g;  result->b *= tint->b;
    return hit;
}
