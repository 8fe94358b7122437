/* SPDX-License-Identifier: Apache-2.0 */
/* A ramp of keys: two arrays of parameters side by side. */
#include <shader.h>

struct cp_ramp {
    miScalar at;
    int      i_key;
    int      n_key;
    miScalar key[1];
    int      i_color;
    int      n_color;
    miColor  color[1];
};

DLLEXPORT int cp_ramp_version(void) { return 1; }

DLLEXPORT miBoolean cp_ramp(miColor *result, miState *state, struct cp_ramp *paras)
{
    miScalar  x = *mi_eval_scalar(&paras->at), t;
    miScalar *key = mi_eval_scalar(paras->key) + *mi_eval_integer(&paras->i_key);
    miColor  *color = mi_eval_color(paras->color) + *mi_eval_integer(&paras->i_color);
    int       n = *mi_eval_integer(&paras->n_key), k;

    if (n != *mi_eval_integer(&paras->n_color) || n < 1) {
        mi_error("cp_ramp: %d keys, %d colours", n, *mi_eval_integer(&paras->n_color));
        return miFALSE;
    }
    for (k = 0; k < n && key[k] <= x; k++)
        ;
    if (k == 0 || k == n) {
        *result = color[k == 0 ? 0 : n - 1];
        return miTRUE;
    }
    t = (x - key[k-1]) / (key[k] - key[k-1]);
    result->r = color[k-1].r + t * (color[k].r - color[k-1].r);
    result->g = color[k-1].g + t * (color[k].g - color[k-1].g);
    result->b = color[k-1].b + t * (color[k].b - color[k-1].b);
    result->a = 1;
    return miTRUE;
}

/* Gives a ramp its place: one coordinate as a scalar. */
struct cp_coordinate { miInteger axis; };

DLLEXPORT int cp_coordinate_version(void) { return 1; }

DLLEXPORT miBoolean cp_coordinate(miScalar *result, miState *state, struct cp_coordinate *paras)
{
    miInteger axis = *mi_eval_integer(&paras->axis);
    *result = (&state->tex_list[0].x)[axis];
    return miTRUE;
}
