/* SPDX-License-Identifier: Apache-2.0 */
/* Uses a helper library whose headers lie in folders of their own. */
#include <shader.h>
#include <cplib/cplib.h>

struct cp_shared { miColor base, layer; int mode; };

DLLEXPORT int cp_shared_version(void) { return 3; }

DLLEXPORT miBoolean cp_shared(miColor *result, miState *state, struct cp_shared *paras)
{
	miColor layer = *mi_eval_color(&paras->layer);

	layer.a *= cplib_step(-2, 2, state->point.x);
	*result = cplib_black;
	cplib_mix(result, mi_eval_color(&paras->base), &layer,
		  (cplib_mode)*mi_eval_integer(&paras->mode));
	return miTRUE;
}
