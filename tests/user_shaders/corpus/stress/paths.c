/* SPDX-License-Identifier: Apache-2.0 */
/* Includes as other people's folders have them. */
#include <stdio.h>
#include "..\..\mental ray\include\shader.h"
#include "D:\devkit\mray\include\geoshader.h"
#include "../../../inc/mi_shader_if.h"
#include <mia_material_api.h>

#pragma warning(disable : 4244 4305)

struct cp_paths { miScalar value; };

DLLEXPORT int cp_paths_version(void) { return 1; }

DLLEXPORT miBoolean cp_paths(miColor *result, miState *state, struct cp_paths *paras)
{
    mia_material_api_storage storage;
    char name[miNAMESIZE];

    storage.struct_size = sizeof(storage);
    sprintf(name, "%s", miA_MATERIAL_API_STORAGE);
    result->r = *mi_eval_scalar(&paras->value);
    result->g = strlen(name) * .0625f;
    result->b = storage.struct_size > sizeof(miColor) ? .25f : 0;
    result->a = 1;
    return miTRUE;
}
