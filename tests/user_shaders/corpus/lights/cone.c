/* SPDX-License-Identifier: Apache-2.0 */
/* A spot: the cone is the light's own, asked by queries; the soft edge is a parameter. */
#include <shader.h>

struct cp_cone { miColor color; miBoolean shadow; miScalar cone; };

DLLEXPORT int cp_cone_version(void) { return 1; }

DLLEXPORT miBoolean cp_cone(miColor *result, miState *state, struct cp_cone *paras)
{
    miTag    light = miNULLTAG;
    miVector axis, dir;
    miScalar spread, cone, d, t;
    int      type = -1;

    *result = *mi_eval_color(&paras->color);
    if (state->type != miRAY_LIGHT)
        return miTRUE;
    mi_query(miQ_INST_ITEM, state, state->light_instance, &light);
    mi_query(miQ_LIGHT_TYPE, state, light, &type);
    if (type != miLIGHT_SPOT)
        return miFALSE;
    mi_query(miQ_LIGHT_DIRECTION, state, light, &axis);
    mi_query(miQ_LIGHT_SPREAD, state, light, &spread);
    mi_vector_to_light(state, &dir, &state->dir);
    mi_vector_normalize(&dir);
    mi_vector_normalize(&axis);
    d = mi_vector_dot(&dir, &axis);
    if (d <= spread)
        return miFALSE;
    cone = *mi_eval_scalar(&paras->cone);
    if (d < cone) {
        t = 1 - (d - cone) / (spread - cone);
        result->r *= t;  result->g *= t;  result->b *= t;
    }
    return *mi_eval_boolean(&paras->shadow) ? mi_trace_shadow(result, state) : miTRUE;
}
