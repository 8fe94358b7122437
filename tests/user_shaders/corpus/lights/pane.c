/* SPDX-License-Identifier: Apache-2.0 */
/* A shadow shader: coloured glass; transmittance decreases with the angle. */
#include <shader.h>

struct cp_pane { miColor color; miBoolean by_angle; };

DLLEXPORT int cp_pane_version(void) { return 1; }

DLLEXPORT miBoolean cp_pane(miColor *result, miState *state, struct cp_pane *paras)
{
    miColor *color = mi_eval_color(&paras->color);
    miScalar f = 1;

    if (state->options->shadow == 's') {
        mi_trace_shadow_seg(result, state);
    }
    if (*mi_eval_boolean(&paras->by_angle))
        f = fabs(state->dot_nd);
    result->r *= color->r * f;
    result->g *= color->g * f;
    result->b *= color->b * f;
    return result->r > 0 || result->g > 0 || result->b > 0;
}
