/* SPDX-License-Identifier: Apache-2.0 */
/* Moves the film: the direction is turned in the space of the camera. */
#include <shader.h>

struct cp_shift { miScalar x, y, zoom; };

DLLEXPORT int cp_shift_version(void) { return 1; }

DLLEXPORT miBoolean cp_shift(miColor *result, miState *state, struct cp_shift *paras)
{
    miVector dir;
    miScalar zoom = *mi_eval_scalar(&paras->zoom);

    mi_vector_to_camera(state, &dir, &state->dir);
    mi_vector_div(&dir, -dir.z);
    dir.x = dir.x / zoom + *mi_eval_scalar(&paras->x);
    dir.y = dir.y / zoom + *mi_eval_scalar(&paras->y);
    mi_vector_normalize(&dir);
    mi_vector_from_camera(state, &dir, &dir);
    return mi_trace_eye(result, state, &state->org, &dir);
}
