/* SPDX-License-Identifier: Apache-2.0 */
/* Spheres of a particle map: a number and a size of each, and one flag of the map. */
#include <shader.h>
#include <geoshader.h>

#define DECLARATION "cp_bubble_map"

struct cp_bubbles {
	int	  i_centers, n_centers;
	miVector  centers[1];
	miScalar  radius;
	miBoolean each;		/* every sphere is half as large as the one before */
};

DLLEXPORT int cp_bubbles_version(void) { return 1; }

static void declare_map(void)
{
	struct miParameter *fields = NULL;

	mi_api_map_decl_dim(3);
	fields = mi_api_map_field_append(fields,
		mi_api_map_field_decl(miTYPE_INTEGER, mi_mem_strdup("id"), 0, miFALSE));
	fields = mi_api_map_field_append(fields,
		mi_api_map_field_decl(miTYPE_SCALAR, mi_mem_strdup("extension"), 0, miFALSE));
	mi_api_map_decl_begin(mi_mem_strdup(DECLARATION), fields);
	mi_api_map_decl_end();
}

static void put_scalar(miScalar value) { mi_api_map_value(miTYPE_SCALAR, &value); }

static void put_bubble(int id, const miVector *p, miScalar radius)
{
	put_scalar(p->x);
	put_scalar(p->y);
	put_scalar(p->z);
	mi_api_map_field_end();
	mi_api_map_value(miTYPE_INTEGER, &id);
	mi_api_map_field_end();
	put_scalar(radius);
	mi_api_map_field_end();
	mi_api_map_element_end();
}

DLLEXPORT miBoolean cp_bubbles(miTag *result, miState *state, struct cp_bubbles *paras)
{
	int	  n = *mi_eval_integer(&paras->n_centers), i;
	miVector *p = mi_eval_vector(paras->centers) + *mi_eval_integer(&paras->i_centers);
	miScalar  radius = *mi_eval_scalar(&paras->radius);
	miObject *object;

	declare_map();
	object = mi_api_object_begin(mi_mem_strdup("cp_bubbles"));
	if (!object)
		return miFALSE;
	object->visible = object->shadow = miTRUE;
	mi_api_map_obj_type(mi_mem_strdup("spheres"));
	mi_api_map_obj_field(mi_mem_strdup("radius"), mi_mem_strdup("extension"));
	mi_api_map_begin(mi_mem_strdup(DECLARATION));
	for (i = 0; i < n; i++) {
		put_bubble(i, &p[i], radius);
		if (*mi_eval_boolean(&paras->each))
			radius *= 0.5f;
	}
	mi_api_map_end(0);
	return mi_geoshader_add_result(result, mi_api_object_end());
}
