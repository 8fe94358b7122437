/* SPDX-License-Identifier: Apache-2.0 */
/* Every way to read a parameter, of every type, of arrays and of members of structures. */
#include <shader.h>

typedef struct { miScalar weight; miVector shift; } evals_part;

struct cp_evals {
    miBoolean  on;
    miInteger  number;
    miScalar   scalar;
    miVector   vector;
    miColor    color;
    miMatrix   transform;
    miTag      text, texture, shader, light, material;
    evals_part one;
    int        i_part, n_part;
    evals_part part[1];
    int        i_tag, n_tag;
    miTag      tag[1];
};

DLLEXPORT int cp_evals_version(void) { return 1; }

DLLEXPORT miBoolean cp_evals(miColor *result, miState *state, struct cp_evals *paras)
{
    miBoolean   on = *mi_eval_boolean(&paras->on);
    miInteger   number = *(miInteger *)mi_eval(state, &paras->number);
    miScalar    scalar = *mi_eval_scalar(&(paras->scalar));
    miScalar   *matrix = mi_eval_transform(paras->transform);
    miVector   *vector = mi_eval_vector(&paras->vector), p;
    miColor     color = *mi_eval_color(&paras->color), called;
    evals_part *part = (evals_part *)mi_eval(state, paras->part) + *mi_eval_integer(&paras->i_part);
    miTag      *tag = mi_eval_tag(paras->tag) + *mi_eval_integer(&paras->i_tag);
    miScalar    sum = 0;
    int         i, tags = 0;

    /* The forms without a cache give the same. */
    if (*mi_call_boolean(&paras->on) != on || *mi_call_integer(&paras->number) != number ||
        *mi_call_scalar(&paras->scalar) != scalar || mi_call_vector(&paras->vector)->x != vector->x ||
        mi_call_color(&paras->color)->g != color.g || mi_call_transform(paras->transform)[5] != matrix[5] ||
        *mi_call_tag(&paras->text) != *mi_eval_tag(&paras->text)) {
        mi_error("cp_evals: two answers");
        return miFALSE;
    }
    mi_point_transform(&p, vector, matrix);
    for (i = 0; i < *mi_eval_integer(&paras->n_part); i++)
        sum += part[i].weight * part[i].shift.x;
    for (i = 0; i < *mi_eval_integer(&paras->n_tag); i++)
        tags += tag[i] != miNULLTAG;
    if (strcmp((char *)mi_db_access(*mi_eval_tag(&paras->text)), "text"))
        return miFALSE;
    mi_db_unpin(*mi_eval_tag(&paras->text));
    (void)mi_eval_tag(&paras->material);    /* may have no tag */
    if (!mi_call_shader(&called, miSHADER_TEXTURE, state, *mi_eval_tag(&paras->shader)))
        return miFALSE;
    result->r = (on ? scalar : 0) + color.r + sum;
    result->g = color.g + number * .0625f + p.y * .125f;
    result->b = called.b + *mi_eval_scalar(&paras->one.weight) + tags * .0625f +
                (*mi_eval_tag(&paras->light) ? .0625f : 0) +
                (*mi_eval_tag(&paras->texture) ? .0625f : 0);
    result->a = 1;
    return miTRUE;
}
