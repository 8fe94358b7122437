/* SPDX-License-Identifier: Apache-2.0 */
/* A volume that fades to a colour with the way; what is infinitely far is all haze. */
#include <shader.h>

struct cp_haze { miColor color; miScalar reach; miBoolean on_lights; };

DLLEXPORT int cp_haze_version(void) { return 1; }

DLLEXPORT miBoolean cp_haze(miColor *result, miState *state, struct cp_haze *paras)
{
    miColor *color;
    double   kept, reach;

    if (state->type == miRAY_LIGHT && !*mi_eval_boolean(&paras->on_lights))
        return miTRUE;
    if (state->type == miRAY_SHADOW)
        return miTRUE;
    color = mi_eval_color(&paras->color);
    reach = *mi_eval_scalar(&paras->reach);
    if (state->dist <= 0) {
        if (state->type == miRAY_LIGHT)
            return miTRUE;
        *result = *color;
        return miTRUE;
    }
    kept = exp(-state->dist / reach);
    result->r = result->r * kept;
    result->g = result->g * kept;
    result->b = result->b * kept;
    if (state->type != miRAY_LIGHT) {
        result->r += color->r * (1 - kept);
        result->g += color->g * (1 - kept);
        result->b += color->b * (1 - kept);
    }
    return miTRUE;
}
