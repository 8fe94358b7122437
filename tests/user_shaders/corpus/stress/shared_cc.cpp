// SPDX-License-Identifier: Apache-2.0
// The same helper library from C++.
#include <cplib/cplib.h>
#include <cplib/color/mix.h>

struct cp_shared_cc { miScalar low, high; };

extern "C" DLLEXPORT int cp_shared_cc_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean
cp_shared_cc(miColor *result, miState *state, struct cp_shared_cc *paras)
{
	const miScalar low = *mi_eval_scalar(&paras->low), high = *mi_eval_scalar(&paras->high);
	result->a = 1;
	result->r = result->g = result->b = ::cplib_clamp(state->point.y, low, high);
	::cplib_mix(result, &::cplib_black, result, cplib_ADD);
	return miTRUE;
}
