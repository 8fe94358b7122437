/* SPDX-License-Identifier: Apache-2.0 */
/* Waves as a bump: the normal is tilted against the slope, along the bump vectors of the surface. */
#include <shader.h>

struct cp_wave { miScalar length, height; };

DLLEXPORT int cp_wave_version(void) { return 1; }

DLLEXPORT miBoolean cp_wave(miColor *result, miState *state, struct cp_wave *paras)
{
    miScalar length = *mi_eval_scalar(&paras->length);
    miScalar slope;
    miVector normal, along;
    int      bumps = 0;

    if (!mi_query(miQ_NUM_BUMPS, state, miNULLTAG, &bumps) || bumps < 1 || !state->bump_x_list)
        along = state->derivs[0];
    else
        along = state->bump_x_list[0];
    if (mi_vector_norm(&along) < miSCALAR_EPSILON)
        along = state->derivs[0];
    mi_vector_normalize(&along);
    slope = *mi_eval_scalar(&paras->height) * 2 * M_PI / length *
            cos(2 * M_PI * state->point.x / length);
    mi_normal_to_object(state, &normal, &state->normal);
    mi_vector_normalize(&normal);
    normal.x -= slope * along.x;
    normal.y -= slope * along.y;
    normal.z -= slope * along.z;
    mi_normal_from_object(state, &normal, &normal);
    mi_vector_normalize(&normal);
    state->normal = normal;
    state->dot_nd = mi_vector_dot(&state->normal, &state->dir);
    return miTRUE;
}

/* Calls the bump, then shows the normal or a surface shader's colour, and puts the normal back. */
struct cp_bumped { miTag bump; miTag surface; };

DLLEXPORT int cp_bumped_version(void) { return 1; }

DLLEXPORT miBoolean cp_bumped(miColor *result, miState *state, struct cp_bumped *paras)
{
    miVector normal = state->normal;
    miScalar dot_nd = state->dot_nd;
    miTag    bump = *mi_eval_tag(&paras->bump), surface = *mi_eval_tag(&paras->surface);
    miColor  none;
    miBoolean answer = miTRUE;

    if (bump)
        mi_call_shader(&none, miSHADER_TEXTURE, state, bump);
    if (surface)
        answer = mi_call_shader(result, miSHADER_MATERIAL, state, surface);
    else {
        result->r = state->normal.x * .5 + .5;
        result->g = state->normal.y * .5 + .5;
        result->b = state->normal.z;
        result->a = 1;
    }
    state->normal = normal;
    state->dot_nd = dot_nd;
    return answer;
}

/* Diffuse light of all lights with the normal as it is. */
DLLEXPORT int cp_lit_version(void) { return 1; }

DLLEXPORT miBoolean cp_lit(miColor *result, miState *state, void *paras)
{
    miTag   *lights;
    int      n = mi_global_lights_info(&lights), samples;
    miColor  c;
    miVector dir;
    miScalar dot_nl;

    result->r = result->g = result->b = 0;
    result->a = 1;
    while (n-- > 0) {
        samples = 0;
        while (mi_sample_light(&c, &dir, &dot_nl, state, lights[n], &samples)) {
            dot_nl = mi_vector_dot(&state->normal, &dir);
            result->r += c.r * dot_nl;  result->g += c.g * dot_nl;  result->b += c.b * dot_nl;
        }
    }
    return miTRUE;
}
