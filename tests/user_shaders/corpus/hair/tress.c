/* SPDX-License-Identifier: Apache-2.0 */
/* Hair as it is shaded: colours and numbers packed behind the texture list, and the way across. */
#include "shader.h"

typedef enum { TRESS_COLOR, TRESS_NUMBER, TRESS_ACROSS } tress_what;

struct cp_tress { miInteger what; };

DLLEXPORT int cp_tress_version(void) { return 1; }

DLLEXPORT miBoolean cp_tress(miColor *result, miState *state, struct cp_tress *paras)
{
	const miScalar *packed = (const miScalar *)&state->tex_list[0];
	miVector a, b, c;
	miVector *pa = &a, *pb = &b, *pc = &c;

	if (mi_tri_vectors(state, 'p', 0, &pa, &pb, &pc)) {
		mi_error("cp_tress: a hair is no triangle");
		return miFALSE;
	}
	switch ((tress_what)*mi_eval_integer(&paras->what)) {
	case TRESS_COLOR:
		*result = *(const miColor *)packed;	/* four scalars of each hair */
		break;
	case TRESS_NUMBER:
		result->r = result->g = result->b = packed[0];
		break;
	case TRESS_ACROSS:
		result->r = state->bary[0] * .5f;
		result->g = (1 - state->bary[0]) * .5f;
		result->b = 0;
		break;
	}
	result->a = 1;
	return miTRUE;
}
