/* SPDX-License-Identifier: Apache-2.0 */
/* A highlight of rough metal: the index of refraction has a colour. */
#include <shader.h>
#include "illum.h"

struct cp_gloss {
    miColor  ambience, ambient, diffuse, specular;
    miScalar roughness;
    miColor  ior;
    int      mode;
    int      i_light, n_light;
    miTag    light[1];
};

DLLEXPORT int cp_gloss_version(void) { return 1; }

DLLEXPORT miBoolean cp_gloss(miColor *result, miState *state, struct cp_gloss *paras)
{
    miColor *diff = mi_eval_color(&paras->diffuse), *spec = mi_eval_color(&paras->specular);
    miColor *ior = mi_eval_color(&paras->ior);
    miScalar rough = *mi_eval_scalar(&paras->roughness), dot_nl;
    miColor sum, color, lobe;
    miVector dir;
    int samples;
    LIGHT_VARS;

    BLACK(result);
    LIGHT_LIST(paras);
    while (n_l-- > 0) {
        BLACK(&sum);
        samples = 0;
        while (mi_sample_light(&color, &dir, &dot_nl, state, *light, &samples)) {
            MULADD(&sum, diff, &color, dot_nl);
            if (mi_cooktorr_specular(&lobe, &state->dir, &dir, &state->normal, rough, ior)) {
                lobe.r *= color.r;  lobe.g *= color.g;  lobe.b *= color.b;
                MULADD(&sum, spec, &lobe, 1);
            }
        }
        if (samples) {
            miColor one;
            one.r = one.g = one.b = 1;
            MULADD(result, &sum, &one, 1.0f / samples);
        }
        light++;
    }
    result->a = 1;
    return miTRUE;
}
