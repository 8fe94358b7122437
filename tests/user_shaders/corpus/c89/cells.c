/* SPDX-License-Identifier: Apache-2.0 */
/* Würfel im Objektraum: gerade und ungerade Zellen, Größe je Achse. Line ends of another system. */
#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <shader.h>

#define ODD(n) ((n) & 1)

struct cp_cells {
	miVector	size;	/* Kantenlängen */
	miColor		even, odd;
};

static int cell(miScalar at, miScalar size)
{
	if (size == 0.0)
		return 0;
	return (int)floor(at / size + 0.5);
}

DLLEXPORT int cp_cells_version(void) { return 1; }

DLLEXPORT miBoolean cp_cells(
	miColor		*result,
	miState		*state,
	struct cp_cells	*paras)
{
	miVector	p, size;
	int		n;

	mi_point_to_object(state, &p, &state->point);
	size = *mi_eval_vector(&paras->size);
	n = cell(p.x, size.x) + cell(p.y, size.y) + cell(p.z, size.z);
	*result = ODD(n) ? *mi_eval_color(&paras->odd) : *mi_eval_color(&paras->even);
	return miTRUE;
}
