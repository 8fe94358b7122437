/* SPDX-License-Identifier: Apache-2.0 */
/* Writes every buffer of the user: their number is what the options have beyond the standard ones. */
#include <shader.h>

struct cp_all { miColor color; };

#define N_USER(state) ((state)->options->no_images - miRC_IMAGE_USER)

DLLEXPORT int cp_all_version(void) { return 1; }

DLLEXPORT miBoolean cp_all(miColor *result, miState *state, struct cp_all *paras)
{
    miColor *c = mi_eval_color(&paras->color), pass;
    int fb, n = N_USER(state);

    for (fb = 0; fb < n; fb++) {
        pass.r = c->r / (fb + 1);
        pass.g = c->g / (fb + 1);
        pass.b = (miScalar)(fb + 1) / n;
        pass.a = 1;
        mi_fb_put(state, fb, &pass);
    }
    result->r = result->g = result->b = n * 0.125f;
    result->a = 1;
    return miTRUE;
}
