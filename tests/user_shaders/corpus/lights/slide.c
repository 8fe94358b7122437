/* SPDX-License-Identifier: Apache-2.0 */
/* A projector: a picture in front of the lamp, square, in the light's own space. */
#include <shader.h>

struct cp_slide { miColor color; miTag picture; miScalar half; };

DLLEXPORT int cp_slide_version(void) { return 1; }

DLLEXPORT miBoolean cp_slide(miColor *result, miState *state, struct cp_slide *paras)
{
    miVector dir, coord;
    miScalar half = *mi_eval_scalar(&paras->half);
    miColor  gel;
    miTag    picture;

    if (state->type != miRAY_LIGHT)
        return miFALSE;
    mi_vector_to_light(state, &dir, &state->dir);
    if (dir.z >= 0)
        return miFALSE;
    coord.x = (dir.x / -dir.z / half + 1) / 2;
    coord.y = (dir.y / -dir.z / half + 1) / 2;
    coord.z = 0;
    if (coord.x < 0 || coord.x >= 1 || coord.y < 0 || coord.y >= 1)
        return miFALSE;
    *result = *mi_eval_color(&paras->color);
    picture = *mi_eval_tag(&paras->picture);
    if (picture && mi_lookup_color_texture(&gel, state, picture, &coord)) {
        result->r *= gel.r;  result->g *= gel.g;  result->b *= gel.b;
    }
    return mi_trace_shadow(result, state);
}
