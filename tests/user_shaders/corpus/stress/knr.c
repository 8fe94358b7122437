/* SPDX-License-Identifier: Apache-2.0 */
/* Checks from a static table. Definitions as before the standard; macros stand for the state. */
#include "shader.h"
#include <math.h>

#define P	state->point
#define ROWS	4
#define COLS	3
#define CELL(v)	((int)floor((double)(v)))
#define MOD(a, n) ((((a) % (n)) + (n)) % (n))
#define LOOKUP(i, j) table[MOD(i, ROWS)][MOD(j, COLS)]
#define RETURN(v) do { result->r = (v); result->g = (v) * .5; result->b = 0; result->a = 1; return(miTRUE); } while (0)

static float table[ROWS][COLS] = {
	{ .1, .2, .3 },
	{ .9, .8, .7 },
	{ .4, .5, .6 },
	{ 1., 0., .5 },
};

struct cp_knr { miScalar size; };

int cp_knr_version() { return 1; }

static double
scaled(v, size)
	double v, size;
{
	return size == 0 ? 0. : v / size;
}

miBoolean
cp_knr(result, state, paras)
	miColor		*result;
	miState		*state;
	register struct cp_knr	*paras;
{
	auto int	i, j;
	register miScalar size;

	size = *mi_eval_scalar(&paras->size);
	i = CELL(scaled((double)P.x, (double)size)), j = CELL(scaled((double)P.y, (double)size));
	RETURN(LOOKUP(i, j));
}
