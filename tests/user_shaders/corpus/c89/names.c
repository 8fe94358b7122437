/* SPDX-License-Identifier: Apache-2.0 */
/* A string picks the colour; the string is looked up in the scene's data. */
#include <shader.h>

struct cp_names { miTag name; };

static struct { char *name; miColor color; } table[] = {
    { "Rost",  { 0.5f, 0.2f, 0.1f, 1.0f } },
    { "Kupfer", { 0.8f, 0.5f, 0.3f, 1.0f } },
    { 0 }
};

DLLEXPORT int cp_names_version(void) { return 1; }

DLLEXPORT miBoolean cp_names(miColor *result, miState *state, struct cp_names *paras)
{
    miTag tag = *mi_eval_tag(&paras->name);
    char *name, *copy;
    int i;

    if (!tag)
        return miFALSE;
    name = mi_db_access(tag);
    copy = mi_mem_strdup(name);
    mi_db_unpin(tag);
    for (i = 0; table[i].name; i++)
        if (!strcmp(table[i].name, copy))
            break;
    mi_mem_release(copy);
    if (!table[i].name)
        return miFALSE;
    *result = table[i].color;
    return miTRUE;
}
