// SPDX-License-Identifier: Apache-2.0
// A light without a place; a wrapper calls it and tints what it brings.
#include <shader.h>

struct cp_sun { miColor color; };
struct cp_filter { miTag light; miColor filter; };

extern "C" {

DLLEXPORT int cp_sun_version(void) { return 1; }
DLLEXPORT miBoolean cp_sun(miColor* result, miState* state, cp_sun* paras) {
  *result = *mi_eval_color(&paras->color);
  if (state->type != miRAY_LIGHT) return miTRUE;
  return mi_trace_shadow(result, state);
}

DLLEXPORT int cp_filter_version(void) { return 1; }
DLLEXPORT miBoolean cp_filter(miColor* result, miState* state, cp_filter* paras) {
  const miBoolean lit = mi_call_shader_x(result, miSHADER_LIGHT, state, *mi_eval_tag(&paras->light), 0);
  const miColor* filter = mi_eval_color(&paras->filter);
  result->r *= filter->r;
  result->g *= filter->g;
  result->b *= filter->b;
  return lit;
}

}
