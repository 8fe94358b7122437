/* SPDX-License-Identifier: Apache-2.0 */
/* A filtered lookup by the ellipse of the pixel, plain where there is none. */
#include <shader.h>

struct cp_filtered { miTag texture; miScalar disc; };

DLLEXPORT int cp_filtered_version(void) { return 1; }

DLLEXPORT miBoolean cp_filtered(miColor *result, miState *state, struct cp_filtered *paras)
{
    miTag       texture = *mi_eval_tag(&paras->texture);
    miTexfilter filter;
    miMatrix    ST;
    miVector    p[3], t[3];

    if (!texture)
        return miFALSE;
    memset(&filter, 0, sizeof(filter));
    filter.eccmax = 20;
    filter.max_minor = 16;
    filter.bilinear = miTRUE;
    filter.circle_radius = *mi_eval_scalar(&paras->disc);
    if (state->reflection_level == 0 &&
        mi_texture_filter_project(p, t, state, filter.circle_radius, 0) &&
        mi_texture_filter_transform(ST, p, t))
        if (mi_lookup_filter_color_texture(result, state, texture, &filter, ST))
            return miTRUE;
    return mi_lookup_color_texture(result, state, texture, &state->tex_list[0]);
}
