/* SPDX-License-Identifier: Apache-2.0 */
/* Displacement by the texture coordinate, in addition to what was there. */
#include <shader.h>

struct cp_lift { miScalar height; };

DLLEXPORT int cp_lift_version(void) { return 1; }

DLLEXPORT miBoolean cp_lift(miScalar *result, miState *state, struct cp_lift *paras)
{
    if (state->type != miRAY_DISPLACE)
        return miFALSE;
    *result += *mi_eval_scalar(&paras->height) * state->tex_list[0].x;
    return miTRUE;
}
