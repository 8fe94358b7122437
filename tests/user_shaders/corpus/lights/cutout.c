/* SPDX-License-Identifier: Apache-2.0 */
/* One function for the surface and for its shadow: holes by texture coordinate. */
#include <shader.h>

struct cp_cutout { miColor color; miScalar edge; };

DLLEXPORT int cp_cutout_version(void) { return 1; }

DLLEXPORT miBoolean cp_cutout(miColor *result, miState *state, struct cp_cutout *paras)
{
    miBoolean hole = state->tex_list[0].x > *mi_eval_scalar(&paras->edge);

    if (state->type == miRAY_SHADOW) {
        if (hole)
            return miTRUE;
        result->r = result->g = result->b = 0;
        return miFALSE;
    }
    if (hole)
        return mi_trace_continue(result, state);
    *result = *mi_eval_color(&paras->color);
    return miTRUE;
}
