/* SPDX-License-Identifier: Apache-2.0 */
/* A lamp that fades between two distances and has a colour of its shadows. */
#include <shader.h>

struct cp_falloff { miColor color; miBoolean shadow; miScalar factor; miBoolean atten; miScalar start, stop; };

DLLEXPORT int cp_falloff_version(void) { return 1; }

DLLEXPORT miBoolean cp_falloff(miColor *result, miState *state, struct cp_falloff *paras)
{
    miScalar start, stop, t, factor;
    miColor  lit;

    *result = *mi_eval_color(&paras->color);
    if (state->type != miRAY_LIGHT)
        return miTRUE;
    if (*mi_eval_boolean(&paras->atten)) {
        start = *mi_eval_scalar(&paras->start);
        stop = *mi_eval_scalar(&paras->stop);
        if (state->dist >= stop)
            return miFALSE;
        if (state->dist > start && fabs(stop - start) > miSCALAR_EPSILON) {
            t = 1 - (state->dist - start) / (stop - start);
            result->r *= t;  result->g *= t;  result->b *= t;
        }
    }
    if (*mi_eval_boolean(&paras->shadow) && state->options->shadow) {
        factor = *mi_eval_scalar(&paras->factor);
        if (factor < 1) {
            lit = *result;
            if (!mi_trace_shadow(&lit, state))
                lit.r = lit.g = lit.b = 0;
            result->r = result->r * factor + lit.r * (1 - factor);
            result->g = result->g * factor + lit.g * (1 - factor);
            result->b = result->b * factor + lit.b * (1 - factor);
            return result->r + result->g + result->b > 0;
        }
    }
    return miTRUE;
}
