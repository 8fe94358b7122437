/* SPDX-License-Identifier: Apache-2.0 */
/* One lookup of each kind; textures may be pictures or shaders that read state->tex. */
#include <shader.h>

struct cp_lookups { miTag color, scalar, vector; miScalar repeat; };

DLLEXPORT int cp_lookups_version(void) { return 1; }

DLLEXPORT miBoolean cp_lookups(miColor *result, miState *state, struct cp_lookups *paras)
{
    miScalar repeat = *mi_eval_scalar(&paras->repeat), s = 1;
    miVector at = state->tex_list[0], v = {1, 1, 1};
    miTag    tag;

    at.x *= repeat;  at.y *= repeat;
    if (!mi_lookup_color_texture(result, state, *mi_eval_tag(&paras->color), &at))
        return miFALSE;
    if ((tag = *mi_eval_tag(&paras->scalar)) != miNULLTAG)
        mi_lookup_scalar_texture(&s, state, tag, &at);
    if ((tag = *mi_eval_tag(&paras->vector)) != miNULLTAG)
        mi_lookup_vector_texture(&v, state, tag, &at);
    result->r *= s * v.x;  result->g *= s * v.y;  result->b *= s * v.z;
    return miTRUE;
}

/* Three textures for it. */
DLLEXPORT int cp_tex_color_version(void) { return 1; }
DLLEXPORT miBoolean cp_tex_color(miColor *result, miState *state, void *paras)
{
    result->r = state->tex.x - floor(state->tex.x);
    result->g = state->tex.y - floor(state->tex.y);
    result->b = result->a = 1;
    return miTRUE;
}

DLLEXPORT int cp_tex_scalar_version(void) { return 1; }
DLLEXPORT miBoolean cp_tex_scalar(miScalar *result, miState *state, void *paras)
{
    *result = .5f * state->tex.x;
    return miTRUE;
}

DLLEXPORT int cp_tex_vector_version(void) { return 1; }
DLLEXPORT miBoolean cp_tex_vector(miVector *result, miState *state, void *paras)
{
    result->x = 1;  result->y = .5f;  result->z = state->tex.y;
    return miTRUE;
}
