/* SPDX-License-Identifier: Apache-2.0 */
/* A light and its instance: it is placed by its name. */
#include <shader.h>
#include <geoshader.h>

struct cp_lantern { miColor color; miVector place; };

#define NAME(s) mi_mem_strdup(s)

DLLEXPORT int cp_lantern_version(void) { return 1; }

static miTag light_shader(const miColor *color)
{
    miScalar channel[3];
    miBoolean on = miTRUE;
    int k;

    channel[0] = color->r;  channel[1] = color->g;  channel[2] = color->b;
    if (!mi_api_function_call(NAME("mib_light_point")))
        return miNULLTAG;
    mi_api_parameter_name(NAME("color"));
    for (k = 0; k < 3; k++)
        mi_api_parameter_value(miTYPE_SCALAR, &channel[k], 0, 0);
    mi_api_parameter_name(NAME("shadow"));
    mi_api_parameter_value(miTYPE_BOOLEAN, &on, 0, 0);
    return mi_api_function_call_end(0);
}

DLLEXPORT miBoolean cp_lantern(miTag *result, miState *state, struct cp_lantern *paras)
{
    miTag shader = light_shader(mi_eval_color(&paras->color));
    miVector place = *mi_eval_vector(&paras->place);
    miInstance *instance;
    miLight *light = mi_api_light_begin(NAME("cp_lantern"));
    miTag tag;

    if (!light || !shader)
        return miFALSE;
    light->type = miLIGHT_ORIGIN;
    light->shader = shader;
    light->origin.x = light->origin.y = light->origin.z = 0;
    mi_api_light_end();
    if (!mi_api_name_lookup(NAME("cp_lantern")))
        return miFALSE;
    instance = mi_api_instance_begin(NAME("cp_lantern_i"));
    mi_matrix_ident(instance->tf.local_to_global);
    mi_matrix_ident(instance->tf.global_to_local);
    instance->tf.local_to_global[12] = place.x;
    instance->tf.local_to_global[13] = place.y;
    instance->tf.local_to_global[14] = place.z;
    mi_matrix_invert(instance->tf.global_to_local, instance->tf.local_to_global);
    tag = mi_api_instance_end(NAME("cp_lantern"), 0, 0);
    return mi_geoshader_add_result(result, tag);
}
