/* SPDX-License-Identifier: Apache-2.0 */
/* Angles in proportion to the distance from the middle; black outside of the circle. */
#include <shader.h>

#define MIN(a, b) ((a) < (b) ? (a) : (b))

struct cp_fisheye { miScalar angle; miColor outside; };

DLLEXPORT int cp_fisheye_version(void) { return 1; }

DLLEXPORT miBoolean cp_fisheye(miColor *result, miState *state, struct cp_fisheye *paras)
{
    miVector camdir, dir;
    miScalar x, y, r, theta;

    mi_vector_to_camera(state, &camdir, &state->dir);
    x = camdir.x / -camdir.z * state->camera->focal / (state->camera->aperture / 2);
    y = camdir.y / -camdir.z * state->camera->focal / (state->camera->aperture / 2);
    r = sqrt(x * x + y * y);
    if (r >= 1) {
        *result = *mi_eval_color(&paras->outside);
        return miFALSE;
    }
    theta = r * *mi_eval_scalar(&paras->angle) * M_PI / 360;
    if (r > 0) {
        dir.x = x / r * sin(theta);
        dir.y = y / r * sin(theta);
    } else
        dir.x = dir.y = 0;
    dir.z = -cos(theta);
    mi_vector_from_camera(state, &dir, &dir);
    return mi_trace_eye(result, state, &state->org, &dir);
}
