/* SPDX-License-Identifier: Apache-2.0 */
/* Bump of a texture by differences: looks it up thrice. */
#include <shader.h>

struct cp_height { miTag texture; miScalar factor; miScalar step; };

DLLEXPORT int cp_height_version(void) { return 1; }

static miScalar height_at(miState *state, miTag tag, miScalar u, miScalar v)
{
    miVector at;
    miColor  c;
    at.x = u;  at.y = v;  at.z = 0;
    if (!mi_lookup_color_texture(&c, state, tag, &at))
        return 0;
    return (c.r + c.g + c.b) / 3;
}

DLLEXPORT miBoolean cp_height(miVector *result, miState *state, struct cp_height *paras)
{
    miTag    tag = *mi_eval_tag(&paras->texture);
    miScalar step = *mi_eval_scalar(&paras->step), factor = *mi_eval_scalar(&paras->factor);
    miScalar u = state->tex_list[0].x, v = state->tex_list[0].y;
    miScalar h = height_at(state, tag, u, v);

    result->x = factor * (height_at(state, tag, u + step, v) - h) / step;
    result->y = factor * (height_at(state, tag, u, v + step) - h) / step;
    result->z = h;
    return miTRUE;
}

/* Shows a vector as a colour. */
struct cp_show { miVector vector; miScalar scale; };
DLLEXPORT int cp_show_version(void) { return 1; }
DLLEXPORT miBoolean cp_show(miColor *result, miState *state, struct cp_show *paras)
{
    miVector *v = mi_eval_vector(&paras->vector);
    miScalar  s = *mi_eval_scalar(&paras->scale);
    result->r = v->x * s;  result->g = v->y * s;  result->b = v->z * s;  result->a = 1;
    return miTRUE;
}
