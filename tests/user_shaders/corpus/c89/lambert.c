/* SPDX-License-Identifier: Apache-2.0 */
/* Diffuse illumination over a list of lights with a mode. */
#include "shader.h"
#include "illum.h"

struct cp_lambert {
    miColor ambience, ambient, diffuse;
    int     mode;
    int     i_light, n_light;
    miTag   light[1];
};

DLLEXPORT int cp_lambert_version(void) {return(1);}

DLLEXPORT miBoolean cp_lambert(
    register miColor    *result,
    register miState    *state,
    register struct cp_lambert *paras)
{
    register miColor *diff, *ambi;
    miColor     sum, color;
    miVector    dir;
    miScalar    dot_nl;
    int         n, samples;
    LIGHT_VARS;

    if (state->type == miRAY_SHADOW || state->type == miRAY_DISPLACE)
        return(miFALSE);
    diff = mi_eval_color(&paras->diffuse);
    *result = *mi_eval_color(&paras->ambience);
    ambi = mi_eval_color(&paras->ambient);
    result->r *= ambi->r;  result->g *= ambi->g;  result->b *= ambi->b;
    LIGHT_LIST(paras);
    for (n = 0; n < n_l; n++, light++) {
        BLACK(&sum);
        samples = 0;
        while (mi_sample_light(&color, &dir, &dot_nl, state, *light, &samples))
            MULADD(&sum, diff, &color, dot_nl);
        if (samples) {
            result->r += sum.r / samples;
            result->g += sum.g / samples;
            result->b += sum.b / samples;
        }
    }
    result->a = 1.0;
    return(miTRUE);
}
