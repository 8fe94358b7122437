/* SPDX-License-Identifier: Apache-2.0 */
/* Texture coordinates through a matrix; the result is a vector. */
#include <shader.h>

struct cp_uvmatrix {
    miInteger   space;
    miMatrix    transform;
    miBoolean   torus;
};

#define FRAC(a) ((a) -= floor(a))

DLLEXPORT int cp_uvmatrix_version(void) { return 1; }

DLLEXPORT miBoolean cp_uvmatrix(
    miVector            *result,
    miState             *state,
    struct cp_uvmatrix  *paras)
{
    miInteger space = *mi_eval_integer(&paras->space);
    miScalar  *m;
    int       spaces = 0;

    if (!mi_query(miQ_NUM_TEXTURES, state, miNULLTAG, &spaces) || space >= spaces)
        return miFALSE;
    m = mi_eval_transform(&paras->transform);
    mi_point_transform(result, &state->tex_list[space], m);
    if (*mi_eval_boolean(&paras->torus)) {
        FRAC(result->x);
        FRAC(result->y);
    }
    return miTRUE;
}
