/* SPDX-License-Identifier: Apache-2.0 */
/* An array of structures: layers over a base, each with its way of mixing. */
#include <shader.h>

struct layer { miColor color; miScalar weight; miInteger mode; };

struct cp_stack {
    miColor      base;
    int          i_layers;
    int          n_layers;
    struct layer layers[1];
};

enum { OVER, ADD, MULTIPLY };

static void mix(miColor *r, const miColor *c, miScalar w, int mode)
{
    switch (mode) {
    case OVER:
        r->r = r->r * (1 - w) + c->r * w;
        r->g = r->g * (1 - w) + c->g * w;
        r->b = r->b * (1 - w) + c->b * w;
        break;
    case ADD:
        r->r += c->r * w;  r->g += c->g * w;  r->b += c->b * w;
        break;
    case MULTIPLY:
        r->r *= 1 - w + w * c->r;  r->g *= 1 - w + w * c->g;  r->b *= 1 - w + w * c->b;
        break;
    }
}

DLLEXPORT int cp_stack_version(void) { return 1; }

DLLEXPORT miBoolean cp_stack(miColor *result, miState *state, struct cp_stack *paras)
{
    int first = *mi_eval_integer(&paras->i_layers);
    int n = *mi_eval_integer(&paras->n_layers), i;
    struct layer *layer = paras->layers + first;

    *result = *mi_eval_color(&paras->base);
    for (i = 0; i < n; i++, layer++)
        mix(result, mi_eval_color(&layer->color), *mi_eval_scalar(&layer->weight),
            *mi_eval_integer(&layer->mode));
    return miTRUE;
}
