/* SPDX-License-Identifier: Apache-2.0 */
/* What an edge of glass reflects of white light: each wavelength has an index of its own (Cauchy). */
#include <shader.h>

struct cp_disperse { miScalar a, b, light; };

#define FOR_BANDS(s, nm, lo, hi) \
    for (mi_spectrum_range_get((s), &(lo), &(hi)), (nm) = (lo); (nm) <= (hi); \
         (nm) += mi_spectrum_linewidth((s), (nm)))

DLLEXPORT int cp_disperse_version(void) { return 1; }

DLLEXPORT miBoolean cp_disperse(miColor *result, miState *state, struct cp_disperse *paras)
{
    miScalar a = *mi_eval_scalar(&paras->a), b = *mi_eval_scalar(&paras->b);
    miScalar light = *mi_eval_scalar(&paras->light), nm, lo, hi;
    miSpectrum own;

    memset(&own, 0, sizeof own);
    mi_spectrum_ensure(&own);
    FOR_BANDS(&own, nm, lo, hi)
        mi_spectrum_value_add(&own, nm, light * mi_fresnel_reflection(state, 1, a + b / (nm * nm)));
    mi_spectrum_rgb(result, &own);
    result->a = 1;
    mi_spectrum_clear(&own);
    return miTRUE;
}
