/* SPDX-License-Identifier: Apache-2.0 */
/* A pane that colours the light that falls through it, most where light meets it flatly. */
/* Shows: a shadow shader in all shadow modes. */
#include <shader.h>

struct ex_stained_glass {
  miColor stain; /* what passes straight through */
};

DLLEXPORT int ex_stained_glass_version(void) { return 1; }

DLLEXPORT miBoolean ex_stained_glass(miColor* result, miState* state,
                                     struct ex_stained_glass* paras) {
  const miColor* stain = mi_eval_color(&paras->stain);
  miScalar way; /* through the pane, in its thicknesses */

  /* With shadow segments, first ask what lies between here and the light. */
  if (state->options->shadow == 's' && !mi_trace_shadow_seg(result, state)) return miFALSE;

  way = (miScalar)fabs(state->dot_nd);
  way = way > 0.05f ? 1.0f / way : 20.0f;
  result->r *= (miScalar)pow(stain->r, way);
  result->g *= (miScalar)pow(stain->g, way);
  result->b *= (miScalar)pow(stain->b, way);

  /* miFALSE ends the shadow ray: nothing is left to be shadowed. */
  return result->r > 1e-4f || result->g > 1e-4f || result->b > 1e-4f;
}
