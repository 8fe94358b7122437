/* SPDX-License-Identifier: Apache-2.0 */
/* Writes passes into the buffers whose numbers it is given, each in the form of its kind. */
#include <shader.h>

struct cp_by_number {
    miColor   color;
    miInteger color_pass, scalar_pass, vector_pass;
};

DLLEXPORT int cp_by_number_version(void) { return 1; }

DLLEXPORT miBoolean cp_by_number(miColor *result, miState *state, struct cp_by_number *paras)
{
    miColor  color = *mi_eval_color(&paras->color);
    miScalar depth = (miScalar)state->dist * 0.25f;
    miVector normal;

    mi_normal_to_world(state, &normal, &state->normal);
    *result = color;
    color.r *= 2;  color.g *= 2;  color.b *= 2;
    if (*mi_eval_integer(&paras->color_pass) >= 0)
        mi_fb_put(state, *mi_eval_integer(&paras->color_pass), &color);
    if (*mi_eval_integer(&paras->scalar_pass) >= 0)
        mi_fb_put(state, *mi_eval_integer(&paras->scalar_pass), &depth);
    if (*mi_eval_integer(&paras->vector_pass) >= 0)
        mi_fb_put(state, *mi_eval_integer(&paras->vector_pass), &normal);
    return miTRUE;
}
