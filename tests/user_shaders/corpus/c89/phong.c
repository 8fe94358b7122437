/* SPDX-License-Identifier: Apache-2.0 */
/* The same with a highlight; locals are declared in a macro too. */
#include "shader.h"
#include "illum.h"

struct cp_phong {
    miColor  ambience, ambient, diffuse, specular;
    miScalar exponent;
    int      mode;
    int      i_light, n_light;
    miTag    light[1];
};

#define VARS    miColor *diff, *spec, sum, color;       \
                miVector dir; miScalar dot_nl, expo, ks; int n, samples

DLLEXPORT int cp_phong_version() { return 1; }

DLLEXPORT miBoolean cp_phong(miColor *result, miState *state, struct cp_phong *paras)
{
    VARS;
    LIGHT_VARS;

    diff = mi_eval_color(&paras->diffuse);
    spec = mi_eval_color(&paras->specular);
    expo = *mi_eval_scalar(&paras->exponent);
    BLACK(result);
    MULADD(result, mi_eval_color(&paras->ambience), mi_eval_color(&paras->ambient), 1);
    LIGHT_LIST(paras);
    for (n = 0; n < n_l; n++) {
        BLACK(&sum);
        samples = 0;
        while (mi_sample_light(&color, &dir, &dot_nl, state, light[n], &samples)) {
            MULADD(&sum, diff, &color, dot_nl);
            if ((ks = mi_phong_specular(expo, state, &dir)) > 0.0)
                MULADD(&sum, spec, &color, ks);
        }
        if (samples > 0) {
            result->r += sum.r / samples;
            result->g += sum.g / samples;
            result->b += sum.b / samples;
        }
    }
    result->a = 1.0;
    return miTRUE;
}
