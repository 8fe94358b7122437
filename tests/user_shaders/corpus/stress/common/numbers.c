/* SPDX-License-Identifier: Apache-2.0 */
#include <cplib/cplib.h>

const miColor cplib_black = { 0, 0, 0, 1 };

miScalar cplib_clamp(miScalar v, miScalar lo, miScalar hi)
{
	return v < lo ? lo : v > hi ? hi : v;
}

miScalar cplib_step(miScalar from, miScalar to, miScalar at)
{
	miScalar t = cplib_clamp((at - from) / (to - from), 0, 1);
	return t * t * (3 - 2 * t);
}
