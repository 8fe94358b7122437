/* SPDX-License-Identifier: Apache-2.0 */
/* How much of the sky is open: probes over the hemisphere, and the share of them that hit nothing. */
#include <shader.h>

struct cp_open_sky { miInteger rays; };

DLLEXPORT int cp_open_sky_version(void) { return 1; }

DLLEXPORT miBoolean cp_open_sky(miColor *result, miState *state, struct cp_open_sky *paras)
{
    const miUint n = *mi_eval_integer(&paras->rays);
    double s[2];
    int    k = 0, open = 0;
    miVector dir;

    while (mi_sample(s, &k, state, 2, &n)) {
        mi_reflection_dir_diffuse_x(&dir, state, s);
        if (!mi_trace_probe(state, &dir, &state->point))
            open++;
    }
    result->r = result->g = result->b = (miScalar)open / n;
    result->a = 1;
    return miTRUE;
}
