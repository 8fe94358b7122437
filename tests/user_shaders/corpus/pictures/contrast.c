/* SPDX-License-Identifier: Apache-2.0 */
/* An output shader: contrast about a grey, over the window of the camera. */
#include <shader.h>

struct cp_contrast { miScalar amount, pivot; };

#define CONTRAST(x) ((x) = ((x) - pivot) * amount + pivot)

DLLEXPORT int cp_contrast_version(void) { return 1; }

DLLEXPORT miBoolean cp_contrast(void *result, miState *state, struct cp_contrast *paras)
{
    miScalar     amount = *mi_eval_scalar(&paras->amount), pivot = *mi_eval_scalar(&paras->pivot);
    miImg_image *fb = mi_output_image_open(state, miRC_IMAGE_RGBA);
    miColor      c;
    int          x, y;

    if (!fb)
        return miFALSE;
    for (y = 0; y < state->camera->y_resolution; y++) {
        if (mi_par_aborted())
            break;
        for (x = 0; x < state->camera->x_resolution; x++) {
            mi_img_get_color(fb, &c, x, y);
            CONTRAST(c.r);  CONTRAST(c.g);  CONTRAST(c.b);
            mi_img_put_color(fb, &c, x, y);
        }
    }
    mi_output_image_close(state, miRC_IMAGE_RGBA);
    return miTRUE;
}
