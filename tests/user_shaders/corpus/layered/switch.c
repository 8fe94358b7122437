/* SPDX-License-Identifier: Apache-2.0 */
/* A shader for each kind of ray; a kind without one has that of the eye. */
#include <shader.h>

struct cp_switch { miTag eye, reflection, transparent, finalgather; };

DLLEXPORT int cp_switch_version(void) { return 1; }

DLLEXPORT miBoolean cp_switch(miColor *result, miState *state, struct cp_switch *paras)
{
    miTag *which = &paras->eye, tag;

    if (state->type == miRAY_REFLECT)
        which = &paras->reflection;
    else if (state->type == miRAY_TRANSPARENT || state->type == miRAY_REFRACT)
        which = &paras->transparent;
    else if (state->type == miRAY_FINALGATHER)
        which = &paras->finalgather;
    tag = *mi_eval_tag(which);
    if (!tag)
        tag = *mi_eval_tag(&paras->eye);
    if (!tag)
        return miFALSE;
    return mi_call_shader_x(result, miSHADER_MATERIAL, state, tag, NULL);
}
