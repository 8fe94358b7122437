/* SPDX-License-Identifier: Apache-2.0 */
/* The picture upside down, from a copy made before the first pixel is written. */
#include <shader.h>

DLLEXPORT int cp_upside_version(void) { return 1; }

DLLEXPORT miBoolean cp_upside(miColor *result, miState *state, void *paras)
{
    miImg_image *fb = mi_output_image_open(state, miRC_IMAGE_RGBA);
    miColor     *copy;
    int          w, h, x, y;

    if (!fb)
        return miFALSE;
    w = mi_img_get_width(fb);
    h = mi_img_get_height(fb);
    copy = mi_mem_allocate(w * h * sizeof(miColor));
    for (y = 0; y < h; y++)
        for (x = 0; x < w; x++)
            mi_img_get_color(fb, copy + y * w + x, x, y);
    for (y = 0; y < h; y++)
        for (x = 0; x < w; x++)
            mi_img_put_color(fb, copy + (h - 1 - y) * w + x, x, y);
    mi_mem_release(copy);
    mi_output_image_close(state, miRC_IMAGE_RGBA);
    return miTRUE;
}
