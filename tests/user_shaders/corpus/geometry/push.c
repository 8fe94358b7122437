/* SPDX-License-Identifier: Apache-2.0 */
/* Displacement in a direction of its own: the normal that it leaves is the way of the point. */
#include <shader.h>

struct cp_push { miScalar height; miVector way; miScalar rise; };

DLLEXPORT int cp_push_version(void) { return 1; }

DLLEXPORT miBoolean cp_push(miScalar *result, miState *state, struct cp_push *paras)
{
    miScalar height = *mi_eval_scalar(&paras->height);
    miVector way = *mi_eval_vector(&paras->way);

    mi_vector_normalize(&way);
    mi_vector_from_object(state, &way, &way);
    state->normal = way;
    state->point.z += *mi_eval_scalar(&paras->rise);
    *result += height;
    return miTRUE;
}
