/* SPDX-License-Identifier: Apache-2.0 */
/* Shows the height that is seen and the x where it is. */
#include <shader.h>

DLLEXPORT int cp_height_version(void) { return 1; }

DLLEXPORT miBoolean cp_height(miColor *result, miState *state, void *paras)
{
    result->r = state->point.z * .25f;
    result->g = state->point.x * .125f + .5f;
    result->b = state->normal.z;
    result->a = 1;
    return miTRUE;
}
