/* SPDX-License-Identifier: Apache-2.0 */
/* Checks and messages of a developer's build: the macro is the source's own. */
#include <stdio.h>
#include <stdlib.h>
#include <shader.h>

#ifdef NDEBUG
#define miASSERT(b)
#define TRACE(args)
#else
#define miASSERT(b) ((b) ? (void)0 : mi_fatal("%s:%d: assertion failed: %s", __FILE__, __LINE__, #b))
#define TRACE(args) mi_debug args
#endif
#define miEPS 1e-4

struct cp_asserts { miScalar value; miInteger verbose; };

DLLEXPORT int cp_asserts_version(void) { return 1; }

DLLEXPORT miBoolean cp_asserts(miColor *result, miState *state, struct cp_asserts *paras)
{
    miScalar value = *mi_eval_scalar(&paras->value);

    miASSERT(state != NULL && paras != NULL);
    miASSERT(state->options->shadow >= 0);
    miASSERT(sizeof(miVector) == 3 * sizeof(miScalar) && sizeof(miMatrix) == 64);
    miASSERT(fabs(mi_vector_norm(&state->normal) - 1) < miEPS);
    if (*mi_eval_integer(&paras->verbose))
        TRACE(("cp_asserts: %f at %f %f, %s", value, state->raster_x, state->raster_y, __FILE__));
    if (*mi_eval_integer(&paras->verbose)) {
        mi_vdebug("cp_asserts: thread %d of type %d", (int)state->thread, (int)state->type);
        mi_debug("cp_asserts: %d%%", 100);
    }
    result->r = value;
    result->g = value * .5f;
    result->b = mi_par_aborted() ? 1 : 0;
    result->a = 1;
    return miTRUE;
}
