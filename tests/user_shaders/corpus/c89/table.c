/* SPDX-License-Identifier: Apache-2.0 */
/* A table for each use of the shader, made in its init and asked for by every sample. */
#include <shader.h>

typedef struct { int n; miScalar *value; miScalar first; } table_t;

struct cp_table { miInteger n; miScalar exponent; };

static table_t *table_of(state)
miState *state;
{
    void **user = NULL;

    if (!mi_query(miQ_FUNC_USERPTR, state, 0, (void *)&user) || user == NULL)
        return NULL;
    return (table_t *)*user;
}

DLLEXPORT int cp_table_version() { return(1); }

DLLEXPORT void cp_table_init(state, paras, init_req)
miState *state;
struct cp_table *paras;
miBoolean *init_req;
{
    void **user;
    table_t *t;
    int i, size = 0;
    void *own = NULL;

    if (paras == NULL) {
        *init_req = miTRUE;
        return;
    }
    t = (table_t *)mi_mem_allocate(sizeof(table_t));
    t->n = *mi_eval_integer(&paras->n);
    t->value = (miScalar *)mi_mem_allocate((t->n + 1) * sizeof(miScalar));
    for (i = 0; i <= t->n; i++)
        t->value[i] = pow((double)i / t->n, *mi_eval_scalar(&paras->exponent));
    /* The parameters by way of a query are those of the call. */
    if (mi_query(miQ_FUNC_PARAM, state, 0, (void *)&own) && own == (void *)paras &&
        mi_query(miQ_FUNC_PARAM_SIZE, state, 0, (void *)&size) && size >= (int)sizeof(*paras))
        t->first = 1;
    mi_query(miQ_FUNC_USERPTR, state, 0, (void *)&user);
    *user = (void *)t;
}

DLLEXPORT void cp_table_exit(state, paras)
miState *state;
struct cp_table *paras;
{
    table_t *t;

    if (paras == NULL || (t = table_of(state)) == NULL)
        return;
    mi_mem_release(t->value);
    mi_mem_release(t);
}

DLLEXPORT miBoolean cp_table(result, state, paras)
miColor *result;
miState *state;
struct cp_table *paras;
{
    table_t *t = table_of(state);
    miScalar at;
    int i;

    if (t == NULL)
        return(miFALSE);
    at = state->tex_list[0].x * t->n;
    i = (int)at;
    if (i >= t->n)
        i = t->n - 1;
    at -= i;
    result->r = t->value[i] * (1 - at) + t->value[i + 1] * at;
    result->g = t->first * .5;
    result->b = 0;
    result->a = 1;
    return(miTRUE);
}
