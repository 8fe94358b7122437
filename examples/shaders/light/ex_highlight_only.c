/* SPDX-License-Identifier: Apache-2.0 */
/* A light that makes highlights on mia_material but no diffuse light. */
/* Shows: the light data of mia_material_api.h. */
#include <mia_material_api.h>
#include <shader.h>

struct ex_highlight_only {
  miColor color; /* at distance 1 */
};

DLLEXPORT int ex_highlight_only_version(void) { return 1; }

DLLEXPORT miBoolean ex_highlight_only(miColor* result, miState* state,
                                      struct ex_highlight_only* paras) {
  /* Only mia_material leaves this; for other materials the light shines as any does. */
  mia_material_api_lightdata* data = mi_shaderstate_get(state, miA_MATERIAL_API_LIGHTDATA, NULL);
  if (data && data->struct_size >= sizeof(*data)) {
    data->affect_diffuse = 0;
    data->affect_specular = 1;
  }

  *result = *mi_eval_color(&paras->color);
  if (state->type != miRAY_LIGHT) return miTRUE;
  if (state->dist > 0) {
    miScalar decay = (miScalar)(1.0 / (state->dist * state->dist));
    result->r *= decay;
    result->g *= decay;
    result->b *= decay;
  }
  return mi_trace_shadow(result, state);
}
