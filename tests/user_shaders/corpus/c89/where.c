/* SPDX-License-Identifier: Apache-2.0 */
/* Shows the hit in one of four spaces. */
#include <shader.h>

struct cp_where { miInteger space; miScalar scale; };

DLLEXPORT int cp_where_version(void) { return 1; }

DLLEXPORT miBoolean cp_where(miColor *result, miState *state, struct cp_where *paras)
{
    miVector p, back;
    miScalar s = *mi_eval_scalar(&paras->scale);
    miMatrix *m;

    switch (*mi_eval_integer(&paras->space)) {
    case 0: mi_point_to_world(state, &p, &state->point); break;
    case 1: mi_point_to_camera(state, &p, &state->point);
            mi_point_from_camera(state, &back, &p);
            if (mi_vector_dist(&back, &state->point) > 1e-3) return miFALSE; break;
    case 2: mi_query(miQ_TRANS_INTERNAL_TO_OBJECT, state, miNULLTAG, &m);
            mi_point_transform(&p, &state->point, *m); break;
    case 3: mi_point_to_raster(state, &p, &state->point); break;
    default: return miFALSE;
    }
    result->r = p.x * s;  result->g = p.y * s;  result->b = p.z * s;  result->a = 1;
    return miTRUE;
}
