/* SPDX-License-Identifier: Apache-2.0 */
/* What the geometry shaders have made, as a colour. */
#include <shader.h>

struct cp_seen { miInteger what; };

DLLEXPORT int cp_seen_version(void) { return 1; }

DLLEXPORT miBoolean cp_seen(miColor *result, miState *state, struct cp_seen *paras)
{
    miVector p, dir;
    miColor  c;
    miScalar dot_nl;
    miTag   *lights;
    int      n, i, samples;

    result->r = result->g = result->b = 0;
    result->a = 1;
    switch (*mi_eval_integer(&paras->what)) {
    case 0: result->r = state->point.z * .25f;
            result->g = state->tex_list[0].x;
            result->b = state->normal.z;
            break;
    case 1: result->r = state->normal.x * .5f + .5f;
            result->g = state->normal.y * .5f + .5f;
            result->b = state->normal.z;
            break;
    case 2: mi_point_to_object(state, &p, &state->point);
            result->r = p.x * .25f + .25f;
            break;
    case 3: n = mi_global_lights_info(&lights);
            for (i = 0; i < n; i++) {
                samples = 0;
                while (mi_sample_light(&c, &dir, &dot_nl, state, lights[i], &samples)) {
                    result->r += c.r * dot_nl;
                    result->g += c.g * dot_nl;
                    result->b += c.b * dot_nl;
                }
            }
            break;
    }
    return miTRUE;
}
