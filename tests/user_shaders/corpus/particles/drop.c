/* SPDX-License-Identifier: Apache-2.0 */
/* Shows the normal of particles, or that there is one. */
#include <shader.h>

struct cp_drop { miInteger what; };

DLLEXPORT int cp_drop_version(void) { return 1; }

DLLEXPORT miBoolean cp_drop(miColor *result, miState *state, struct cp_drop *paras)
{
    miBoolean flat = *mi_eval_integer(&paras->what) == 0;

    result->r = flat ? 1.0f : (miScalar)(0.5 + 0.5 * state->normal.x);
    result->g = flat ? 0.5f : (miScalar)(0.5 + 0.5 * state->normal.y);
    result->b = flat ? 0.25f : -state->dot_nd;
    result->a = 1;
    return miTRUE;
}
