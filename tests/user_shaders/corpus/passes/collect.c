/* SPDX-License-Identifier: Apache-2.0 */
/* Calls a material and adds what it brings to a buffer that others add to as well. */
#include <shader.h>

struct cp_collect {
    miTag     material;
    miInteger pass;
    miColor   tint;
};

DLLEXPORT int cp_collect_version(void) { return 1; }

DLLEXPORT miBoolean cp_collect(miColor *result, miState *state, struct cp_collect *paras)
{
    miTag     material = *mi_eval_tag(&paras->material);
    miInteger pass = *mi_eval_integer(&paras->pass);
    miColor   sum, *tint = mi_eval_color(&paras->tint);

    if (!mi_call_shader_x(result, miSHADER_MATERIAL, state, material, NULL))
        return miFALSE;
    result->r *= tint->r;  result->g *= tint->g;  result->b *= tint->b;
    if (mi_fb_get(state, pass, &sum)) {
        sum.r += result->r;  sum.g += result->g;  sum.b += result->b;  sum.a = 1;
        mi_fb_put(state, pass, &sum);
    }
    return miTRUE;
}
