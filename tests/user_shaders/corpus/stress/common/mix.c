/* SPDX-License-Identifier: Apache-2.0 */
#include <cplib/cplib.h>

static void over(miScalar *to, miScalar a, miScalar b, miScalar w) { *to = a * (1 - w) + b * w; }
static void add(miScalar *to, miScalar a, miScalar b, miScalar w) { *to = a + b * w; }
static void multiply(miScalar *to, miScalar a, miScalar b, miScalar w) { *to = a * (1 - w + b * w); }

void cplib_mix(miColor *to, const miColor *a, const miColor *b, cplib_mode mode)
{
	static void (*const table[cplib_N_MODES])(miScalar *, miScalar, miScalar, miScalar) = {
		over, add, multiply
	};
	miColor out;
	table[mode](&out.r, a->r, b->r, b->a);
	table[mode](&out.g, a->g, b->g, b->a);
	table[mode](&out.b, a->b, b->b, b->a);
	out.a = a->a;
	*to = out;
}
