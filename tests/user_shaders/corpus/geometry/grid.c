/* SPDX-License-Identifier: Apache-2.0 */
/* A mesh of quadrilaterals over a slope, with normals and texture coordinates. */
#include <shader.h>
#include <geoshader.h>

struct cp_grid { miInteger n; miScalar half, slope; };

DLLEXPORT int cp_grid_version(void) { return 1; }

DLLEXPORT miBoolean cp_grid(miTag *result, miState *state, struct cp_grid *paras)
{
    int       n = *mi_eval_integer(&paras->n), i, j, count, at;
    miScalar  half = *mi_eval_scalar(&paras->half), slope = *mi_eval_scalar(&paras->slope);
    miVector  v;
    miObject *object;

    if (n < 1)
        return miFALSE;
    object = mi_api_object_begin(mi_mem_strdup("cp_grid"));
    object->visible = object->shadow = miTRUE;
    object->reflection = object->refraction = 3;
    mi_api_basis_list_clear();
    mi_api_object_group_begin(0.0);
    count = (n + 1) * (n + 1);
    for (j = 0; j <= n; j++)
        for (i = 0; i <= n; i++) {
            v.x = half * (2.0f * i / n - 1);
            v.y = half * (2.0f * j / n - 1);
            v.z = slope * v.x;
            mi_api_vector_xyz_add(&v);
        }
    for (j = 0; j <= n; j++)
        for (i = 0; i <= n; i++) {
            v.x = (miScalar)i / n;
            v.y = (miScalar)j / n;
            v.z = 0;
            mi_api_vector_xyz_add(&v);
        }
    v.x = -slope;  v.y = 0;  v.z = 1;
    mi_vector_normalize(&v);
    mi_api_vector_xyz_add(&v);
    for (i = 0; i < count; i++) {
        mi_api_vertex_add(i);
        mi_api_vertex_normal_add(2 * count);
        mi_api_vertex_tex_add(count + i, -1, -1);
    }
    for (j = 0; j < n; j++)
        for (i = 0; i < n; i++) {
            at = j * (n + 1) + i;
            mi_api_poly_begin_tag(1, miNULLTAG);
            mi_api_poly_index_add(at);
            mi_api_poly_index_add(at + 1);
            mi_api_poly_index_add(at + n + 2);
            mi_api_poly_index_add(at + n + 1);
            mi_api_poly_end();
        }
    mi_api_object_group_end();
    return mi_geoshader_add_result(result, mi_api_object_end());
}
