/* SPDX-License-Identifier: Apache-2.0 */
/* A material over what lies behind: opacity by a colour, the rest shines through. */
#include <shader.h>

struct cp_veil { miColor color, opacity; };

DLLEXPORT int cp_veil_version(void) { return 1; }

DLLEXPORT miBoolean cp_veil(miColor *result, miState *state, struct cp_veil *paras)
{
    miColor *opacity = mi_eval_color(&paras->opacity), *color, behind;

    mi_opacity_set(state, opacity);
    if (opacity->r == 0 && opacity->g == 0 && opacity->b == 0)
        return mi_trace_transparent(result, state);
    color = mi_eval_color(&paras->color);
    *result = *color;
    if (opacity->r < 1 || opacity->g < 1 || opacity->b < 1) {
        behind.r = behind.g = behind.b = behind.a = 0;
        mi_trace_transparent(&behind, state);
        result->r = opacity->r * color->r + (1 - opacity->r) * behind.r;
        result->g = opacity->g * color->g + (1 - opacity->g) * behind.g;
        result->b = opacity->b * color->b + (1 - opacity->b) * behind.b;
    }
    result->a = 1;
    return miTRUE;
}
