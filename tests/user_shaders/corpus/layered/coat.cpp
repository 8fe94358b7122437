// SPDX-License-Identifier: Apache-2.0
// A coat of glass over any material: reflection by Fresnel, the rest from below.
#include <shader.h>

struct cp_coat {
  miTag below;
  miScalar ior;
  miInteger depth;
};

template <class T>
inline T mix(const T& a, const T& b, double t) { return T(a + (b - a) * t); }

extern "C" DLLEXPORT int cp_coat_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean cp_coat(miColor* result, miState* state, struct cp_coat* paras) {
  const miScalar reflected = mi_fresnel_reflection(state, 1, *mi_eval_scalar(&paras->ior));
  miColor above = {0, 0, 0, 0}, below = {0, 0, 0, 0};
  if (state->reflection_level < *mi_eval_integer(&paras->depth)) {
    miVector dir;
    mi_reflection_dir(&dir, state);
    if (!mi_trace_reflection(&above, state, &dir)) mi_trace_environment(&above, state, &dir);
  }
  const miTag tag = *mi_eval_tag(&paras->below);
  if (tag) mi_call_shader(&below, miSHADER_MATERIAL, state, tag);
  result->r = mix(below.r, above.r, reflected);
  result->g = mix(below.g, above.g, reflected);
  result->b = mix(below.b, above.b, reflected);
  result->a = 1;
  return miTRUE;
}
