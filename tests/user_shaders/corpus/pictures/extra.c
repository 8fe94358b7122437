/* SPDX-License-Identifier: Apache-2.0 */
/* A surface that shows the red of its place and leaves green in a buffer. */
#include <shader.h>

struct cp_extra { miInteger pass; };

DLLEXPORT int cp_extra_version(void) { return 1; }

DLLEXPORT miBoolean cp_extra(miColor *result, miState *state, struct cp_extra *paras)
{
    miColor green;
    result->r = state->tex_list[0].y;
    result->g = result->b = 0;
    result->a = 1;
    green.r = green.b = 0;  green.g = .5f;  green.a = 1;
    mi_fb_put(state, *mi_eval_integer(&paras->pass), &green);
    return miTRUE;
}
