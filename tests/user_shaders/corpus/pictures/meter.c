/* SPDX-License-Identifier: Apache-2.0 */
/* A state shader counts the materials that a sample calls; they count in its record. */
#include <shader.h>

#define KEY "cp_meter"

typedef struct { int calls; miScalar length; } record;

DLLEXPORT int cp_meter_version(void) { return 1; }

DLLEXPORT miBoolean cp_meter(miColor *result, miState *state, void *paras, miShader_state_arg *arg)
{
    record start = {0, 0}, *r;
    int    size = sizeof(start);

    switch (arg->op) {
      case miSHADERSTATE_SAMPLE_INIT:
        mi_shaderstate_set(state, KEY, &start, sizeof(start), miSS_LIFETIME_EYERAY);
        break;
      case miSHADERSTATE_SAMPLE_EXIT:
        r = (record *)mi_shaderstate_get(state, KEY, &size);
        if (!r || size != sizeof(record))
            return miFALSE;
        result->g = r->calls * .25f;
        result->b = r->length * .1f;
        break;
      default:
        break;
    }
    return miTRUE;
}

DLLEXPORT int cp_counted_version(void) { return 1; }

DLLEXPORT miBoolean cp_counted(miColor *result, miState *state, void *paras)
{
    record *r = (record *)mi_shaderstate_get(state, KEY, NULL);
    if (r) {
        r->calls++;
        r->length += state->dist;
    }
    result->r = .5f;
    result->g = result->b = 0;
    result->a = 1;
    if (state->type == miRAY_EYE)
        mi_trace_transparent(result, state);
    return miTRUE;
}
