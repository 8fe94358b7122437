/* SPDX-License-Identifier: Apache-2.0 */
/* Single texels: the size of the picture is asked for, each is looked up at its middle. */
#include <shader.h>

struct cp_texels { miTag texture; miBoolean mirrored; };

#define MIDDLE(n, size) (((miScalar)(n) + 0.5f) / (size))

DLLEXPORT int cp_texels_version(void) { return 1; }

DLLEXPORT miBoolean cp_texels(miColor *result, miState *state, struct cp_texels *paras)
{
    miTag    tag = *mi_eval_tag(&paras->texture);
    int      width = 0, height = 0, asked = 0, x, y;
    miVector at;

    if (!tag || mi_db_type(tag) != miSCENE_IMAGE)
        return miFALSE;
    mi_texture_info(tag, &width, &height, NULL);
    if (!mi_query(miQ_IMAGE_WIDTH, NULL, tag, &asked) || asked != width || height < 1)
        return miFALSE;
    x = (int)(state->tex_list[0].x * width);
    y = (int)(state->tex_list[0].y * height);
    if (*mi_eval_boolean(&paras->mirrored))
        x = width - 1 - x;
    at.x = MIDDLE(x, width);
    at.y = MIDDLE(y, height);
    at.z = 0;
    return mi_lookup_color_texture(result, state, tag, &at);
}
