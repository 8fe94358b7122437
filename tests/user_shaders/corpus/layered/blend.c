/* SPDX-License-Identifier: Apache-2.0 */
/* Layers of materials, each with a weight; a layer that is not seen is not called. */
#include <shader.h>

struct layer { miTag material; miScalar weight; };
struct cp_blend {
    int          i_layer, n_layer;
    struct layer layer[1];
};

DLLEXPORT int cp_blend_version(void) { return 1; }

DLLEXPORT miBoolean cp_blend(miColor *result, miState *state, struct cp_blend *paras)
{
    struct layer *layer = paras->layer + *mi_eval_integer(&paras->i_layer);
    int           n = *mi_eval_integer(&paras->n_layer);
    miScalar      w;
    miColor       c;

    result->r = result->g = result->b = 0;
    result->a = 1;
    for (; n > 0; n--, layer++) {
        if ((w = *mi_eval_scalar(&layer->weight)) <= 0)
            continue;
        c.r = c.g = c.b = c.a = 0;
        if (!mi_call_shader_x(&c, miSHADER_MATERIAL, state, *mi_eval_tag(&layer->material), NULL))
            continue;
        result->r += w * (c.r - result->r);
        result->g += w * (c.g - result->g);
        result->b += w * (c.b - result->b);
    }
    return miTRUE;
}
