/* SPDX-License-Identifier: Apache-2.0 */
/* Curved hairs of two cubic pieces, from a static table that is scaled into place. */
#include <stdlib.h>
#include <string.h>
#include <geoshader.h>

struct cp_curls { miScalar radius, sway; };

#define N_POINTS 7	/* two pieces of degree 3 share one */
#define N_HAIRS  2
static const float points[N_HAIRS][N_POINTS][3] = {
	{{-2, -5, 0}, {-3, -3, 0}, {-1, -1, 0}, {-2, 0, 0}, {-3, 1, 0}, {-1, 3, 0}, {-2, 5, 0}},
	{{ 2, -5, 0}, { 1, -4, 1}, { 3, -2, 1}, { 2, 0, 0}, { 1, 2, -1}, {3, 4, -1}, {2, 5, 0}}
};
static const int offsets[N_HAIRS + 1] = { 0, N_POINTS * 4, N_POINTS * 8 };

DLLEXPORT int cp_curls_version(void) { return(1); }

DLLEXPORT miBoolean cp_curls(
	miTag		*result,
	miState		*state,
	struct cp_curls	*paras)
{
	register miScalar *s;
	miHair_list	*hair;
	miScalar	radius = *mi_eval_scalar(&paras->radius);
	miScalar	sway = *mi_eval_scalar(&paras->sway);
	int		h, p;

	mi_api_object_begin(NULL)->visible = miTRUE;
	hair = mi_api_hair_begin();
	hair->degree = 3;
	hair->radius = radius;
	hair->space_max_size = 10;
	hair->space_max_depth = 40;
	mi_api_hair_info(1, 'r', 1);
	s = mi_api_hair_scalars_begin(N_HAIRS * N_POINTS * 4);
	for (h = 0; h < N_HAIRS; h++)
		for (p = 0; p < N_POINTS; p++, s += 4) {
			memcpy(s, points[h][p], 3 * sizeof(float));
			s[0] = points[h][0][0] + (s[0] - points[h][0][0]) * sway;
			s[3] = radius * (N_POINTS - p) / N_POINTS;
		}
	mi_api_hair_scalars_end(N_HAIRS * N_POINTS * 4);
	memcpy(mi_api_hair_hairs_begin(N_HAIRS + 1), offsets, sizeof(offsets));
	mi_api_hair_hairs_end();
	mi_api_hair_end();
	return(mi_geoshader_add_result(result, mi_api_object_end()));
}
