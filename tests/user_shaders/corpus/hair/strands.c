/* SPDX-License-Identifier: Apache-2.0 */
/* Upright straight hairs: each has a radius and a colour, written one scalar after the other. */
#include <shader.h>
#include <geoshader.h>

#define PER_HAIR   (1 + 4)	/* 'r' and 't' */
#define PER_VERTEX 3
#define VERTICES   2
#define HAIR_SIZE  (PER_HAIR + VERTICES * PER_VERTEX)
#define PUT(at, value) (*(at)++ = (miScalar)(value))

struct cp_strands {
	int	 n;
	miScalar radius, gap;
	int	 i_color, n_color;
	miColor	 color[1];
};

DLLEXPORT int cp_strands_version(void) { return 1; }

static miScalar *strand(at, x, radius, c)
	miScalar *at;
	double x, radius;
	const miColor *c;
{
	int k;
	PUT(at, radius);
	PUT(at, c->r); PUT(at, c->g); PUT(at, c->b); PUT(at, c->a);
	for (k = 0; k < VERTICES; k++) {
		PUT(at, x); PUT(at, k ? 20 : -20); PUT(at, 0);
	}
	return at;
}

DLLEXPORT miBoolean cp_strands(result, state, paras)
	miTag *result;
	miState *state;
	struct cp_strands *paras;
{
	int n = *mi_eval_integer(&paras->n), colors = *mi_eval_integer(&paras->n_color), i;
	const miColor *color = mi_eval_color(paras->color) + *mi_eval_integer(&paras->i_color);
	miScalar gap = *mi_eval_scalar(&paras->gap), *scalars, *at;
	miGeoIndex *hairs;
	miHair_list *list;
	miObject *obj;

	if (n < 1 || colors < 1)
		return miFALSE;
	if (!(obj = mi_api_object_begin(mi_mem_strdup("cp_strands"))))
		return miFALSE;
	obj->visible = miTRUE;
	obj->shadow = 0x03;
	obj->face = 'a';
	list = mi_api_hair_begin();
	list->degree = 1;
	list->radius = 99;	/* of hairs without a radius: there are none */
	list->approx = 1;
	mi_api_hair_info(0, 'r', 1);
	mi_api_hair_info(0, 't', 4);
	scalars = at = mi_api_hair_scalars_begin(n * HAIR_SIZE);
	for (i = 0; i < n; i++)
		at = strand(at, (i - .5 * (n - 1)) * gap, *mi_eval_scalar(&paras->radius) / (i + 1),
			    &color[i % colors]);
	mi_api_hair_scalars_end((int)(at - scalars));
	hairs = mi_api_hair_hairs_begin(n + 1);
	for (i = 0; i <= n; i++)
		hairs[i] = i * HAIR_SIZE;
	mi_api_hair_hairs_end();
	mi_api_hair_end();
	return mi_geoshader_add_result(result, mi_api_object_end());
}
