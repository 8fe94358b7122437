/* SPDX-License-Identifier: Apache-2.0 */
/* A lens with an opening: several rays through it meet in the plane of focus. */
#include <shader.h>

struct cp_thin_lens { miScalar focus, radius; miInteger samples; };

DLLEXPORT int cp_thin_lens_version(void) { return 1; }

DLLEXPORT miBoolean cp_thin_lens(miColor *result, miState *state, struct cp_thin_lens *paras)
{
    miScalar focus = *mi_eval_scalar(&paras->focus), radius = *mi_eval_scalar(&paras->radius);
    miUint   n = *mi_eval_integer(&paras->samples);
    miVector org, dir, at, from, to;
    miColor  sum, one;
    double   s[2];
    int      k = 0, rays = 0;

    mi_point_to_camera(state, &org, &state->org);
    mi_vector_to_camera(state, &dir, &state->dir);
    /* Where the ray meets the plane of focus. */
    at.x = org.x - dir.x / dir.z * (focus + org.z);
    at.y = org.y - dir.y / dir.z * (focus + org.z);
    at.z = -focus;
    sum.r = sum.g = sum.b = sum.a = 0;
    while (mi_sample(s, &k, state, 2, &n)) {
        from.x = org.x + radius * sqrt(s[0]) * cos(2 * M_PI * s[1]);
        from.y = org.y + radius * sqrt(s[0]) * sin(2 * M_PI * s[1]);
        from.z = org.z;
        mi_vector_sub(&to, &at, &from);
        mi_vector_normalize(&to);
        mi_point_from_camera(state, &from, &from);
        mi_vector_from_camera(state, &to, &to);
        one.r = one.g = one.b = one.a = 0;
        mi_trace_eye(&one, state, &from, &to);
        sum.r += one.r;  sum.g += one.g;  sum.b += one.b;
        rays++;
    }
    if (!rays)
        return miFALSE;
    result->r = sum.r / rays;  result->g = sum.g / rays;  result->b = sum.b / rays;
    result->a = 1;
    return miTRUE;
}
