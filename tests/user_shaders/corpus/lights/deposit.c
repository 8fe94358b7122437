/* SPDX-License-Identifier: Apache-2.0 */
/* A photon shader of a diffuse surface: store, choose, send on. */
#include <shader.h>

struct cp_deposit { miColor diffuse; };

DLLEXPORT int cp_deposit_version(void) { return 1; }

DLLEXPORT miBoolean cp_deposit(miColor *energy, miState *state, struct cp_deposit *paras)
{
    miColor  diffuse = *mi_eval_color(&paras->diffuse), none, color;
    miVector dir;

    none.r = none.g = none.b = none.a = 0;
    if (state->type != miPHOTON_LIGHT)
        mi_store_photon(energy, state);
    switch (mi_choose_simple_scatter_type(state, &diffuse, &none, &none, &none)) {
      case miPHOTON_REFLECT_DIFFUSE:
        color.r = energy->r * diffuse.r;
        color.g = energy->g * diffuse.g;
        color.b = energy->b * diffuse.b;
        color.a = 1;
        mi_reflection_dir_diffuse(&dir, state);
        return mi_photon_reflection_diffuse(&color, state, &dir);
      default:
        return miTRUE;
    }
}

/* The surface itself: light of the photons, by the irradiance. */
struct cp_matte { miColor diffuse; };

DLLEXPORT int cp_matte_version(void) { return 1; }

DLLEXPORT miBoolean cp_matte(miColor *result, miState *state, struct cp_matte *paras)
{
    miColor  c = *mi_eval_color(&paras->diffuse), light, sum, e;
    miTag   *lights;
    miScalar dot_nl;
    miVector dir;
    int      n = mi_global_lights_info(&lights), samples;

    sum.r = sum.g = sum.b = 0;
    while (n--) {
        samples = 0;
        while (mi_sample_light(&light, &dir, &dot_nl, state, lights[n], &samples)) {
            sum.r += light.r * dot_nl;  sum.g += light.g * dot_nl;  sum.b += light.b * dot_nl;
        }
    }
    if (!mi_compute_irradiance(&e, state))
        e.r = e.g = e.b = 0;
    result->r = c.r * (sum.r + e.r / M_PI);
    result->g = c.g * (sum.g + e.g / M_PI);
    result->b = c.b * (sum.b + e.b / M_PI);
    result->a = 1;
    return miTRUE;
}
