/* SPDX-License-Identifier: Apache-2.0 */
/* Old-style definition, one macro for all parameters. */
#include "shader.h"

#define EVAL(type, name) (*mi_eval_##type(&paras->name))

struct cp_tint {
    miBoolean enabled;
    miColor   color;
    miScalar  gain;
    miInteger only;         /* 0: all channels; 1, 2, 3: one */
};

DLLEXPORT int cp_tint_version(void) {return(1);}

static void scale_color(c, f)
    miColor *c;
    double f;
{
    c->r *= f;  c->g *= f;  c->b *= f;
}

DLLEXPORT miBoolean cp_tint(result, state, paras)
    miColor         *result;
    miState         *state;
    struct cp_tint  *paras;
{
    if (!EVAL(boolean, enabled)) {
        result->r = result->g = result->b = 0;
        result->a = 1;
        return(miTRUE);
    }
    *result = EVAL(color, color);
    scale_color(result, (double)EVAL(scalar, gain));
    switch (EVAL(integer, only)) {
      case 1:   result->g = result->b = 0;  break;
      case 2:   result->r = result->b = 0;  break;
      case 3:   result->r = result->g = 0;  break;
      default:  break;
    }
    return(miTRUE);
}
