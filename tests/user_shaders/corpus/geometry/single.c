/* SPDX-License-Identifier: Apache-2.0 */
/* One instance is the whole result: its tag is written, no list is made. */
#include <shader.h>
#include <geoshader.h>

struct cp_single { miScalar half; miVector at; miBoolean listed; };

DLLEXPORT int cp_single_version(void) { return 1; }

DLLEXPORT miBoolean cp_single(miTag *result, miState *state, struct cp_single *paras)
{
    miScalar half = *mi_eval_scalar(&paras->half);
    miVector at = *mi_eval_vector(&paras->at), v;
    miInstance *inst;
    miObject *obj = mi_api_object_begin(mi_mem_strdup("cp_single"));
    miTag tag;
    int i;

    obj->visible = miTRUE;
    mi_api_object_group_begin(0.);
    for (i = 0; i < 4; i++) {
        v.x = i == 0 || i == 3 ? -half : half;
        v.y = i < 2 ? -half : half;
        v.z = 0;
        mi_api_vector_xyz_add(&v);
    }
    for (i = 0; i < 4; i++)
        mi_api_vertex_add(i);
    mi_api_poly_begin_tag(1, 0);
    for (i = 0; i < 4; i++)
        mi_api_poly_index_add(i);
    mi_api_poly_end();
    mi_api_object_group_end();
    mi_api_object_end();

    inst = mi_api_instance_begin(mi_mem_strdup("cp_single_inst"));
    mi_matrix_ident(inst->tf.global_to_local);
    inst->tf.global_to_local[12] = -at.x;
    inst->tf.global_to_local[13] = -at.y;
    inst->tf.global_to_local[14] = -at.z;
    mi_matrix_invert(inst->tf.local_to_global, inst->tf.global_to_local);
    tag = mi_api_instance_end(mi_mem_strdup("cp_single"), 0, 0);
    if (*mi_eval_boolean(&paras->listed))
        return mi_geoshader_add_result(result, tag);
    *result = tag;
    return miTRUE;
}
