/* SPDX-License-Identifier: Apache-2.0 */
/* Vector macros within expressions, conditions, comma expressions and each other. */
#include <shader.h>

struct cp_vectors { miVector axis; };

#define V(p) (&((p)->point))
#define FLIP(v, s) (mi_vector_dot((v), &(s)->dir) > 0 ? (mi_vector_neg(v), -1) : 1)

DLLEXPORT int cp_vectors_version(void) { return 1; }

DLLEXPORT miBoolean cp_vectors(miColor *result, miState *state, struct cp_vectors *paras)
{
    miVector axes[3], *a = axes, *b, sum, origin, least, most;
    miScalar length, side, det;
    int i, turned;

    origin.x = origin.y = origin.z = 1, mi_vector_mul(&origin, 0);
    axes[0] = *mi_eval_vector(&paras->axis);
    mi_vector_normalize(&axes[0]);
    if ((length = mi_vector_norm(&axes[0])) < 0.99f || length > 1.01f)
        return miFALSE;
    /* A basis: the normal, the axis, and what is upright on both. */
    axes[1] = state->normal;
    turned = FLIP(&axes[1], state);
    mi_vector_prod(&axes[2], a + 0, (b = &axes[1]));
    for (i = 0; i < 3; i++)
        if (mi_vector_norm(axes + i) < miSCALAR_EPSILON) return miFALSE; else mi_vector_normalize(axes + i);
    det = mi_vector_det(&axes[0], &axes[1], &axes[2]);
    mi_vector_sub(&sum, V(state), &origin);
    mi_vector_add(&sum, (turned, &sum), (i, &origin));
    side = mi_vector_dot(&sum, &axes[0]) / (1 ? mi_vector_norm(b) : 1);
    mi_vector_min(&least, &sum, &origin);
    mi_vector_max(&most, &sum, &origin);
    mi_vector_div(&most, (mi_vector_dist(&origin, &axes[0]) + 1.f));
    result->r = side > 0 ? side * .25f : 0;
    result->g = mi_vector_norm_d(&least) * .125f;
    result->b = most.y * .25f + (turned == 1 && det > .999f && det < 1.001f ? .25f : 0.f);
    result->a = 1;
    return miTRUE;
}
