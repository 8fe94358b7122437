// SPDX-License-Identifier: Apache-2.0
// A Lambert of a modelling program's plug-in: asks the program what a light does.
#include <shader.h>
#include <mayaapi.h>

struct cp_host {
  miColor color;
  miScalar translucence;
  int mode, i_lights, n_lights;
  miTag lights[1];
};

namespace {

inline miColor operator*(const miColor& c, float f) {
  const miColor out = {c.r * f, c.g * f, c.b * f, c.a};
  return out;
}
inline miColor operator*(const miColor& a, const miColor& b) {
  const miColor out = {a.r * b.r, a.g * b.g, a.b * b.b, a.a * b.a};
  return out;
}
inline miColor& operator+=(miColor& a, const miColor& b) {
  a.r += b.r, a.g += b.g, a.b += b.b;
  return a;
}

/// Whether the light that was just sampled lights diffusely.
bool lights_diffusely(miState* state) {
  miBoolean *diffuse = NULL, *specular = NULL;
  if (!mayabase_stateitem_get(state, MBSI_LIGHTDIFFUSE, &diffuse, MBSI_LIGHTSPECULAR, &specular,
                              MBSI_NULL))
    return true;
  return diffuse == NULL || *diffuse != miFALSE;
}

}  // namespace

extern "C" {

DLLEXPORT int cp_host_version(void) { return 2; }

DLLEXPORT miBoolean cp_host(miColor* result, miState* state, cp_host* paras) {
  if (state->type == miRAY_SHADOW || state->type == miRAY_DISPLACE) return miFALSE;
  const miColor color = *mi_eval_color(&paras->color);
  int n = *mi_eval_integer(&paras->n_lights);
  miTag* light = mi_eval_tag(&paras->lights) + *mi_eval_integer(&paras->i_lights);
  const int mode = *mi_eval_integer(&paras->mode);
  if (mode == 4) {
    if (!mayabase_lightlink_get(state, &n, &light)) mi_instance_lightlist(&n, &light, state);
  } else if (mode == 1) {
    mi_inclusive_lightlist(&n, &light, state);
  } else if (mode == 2) {
    mi_exclusive_lightlist(&n, &light, state);
  }
  result->r = result->g = result->b = 0;
  for (mi::shader::LightIterator it(state, light, n); !it.at_end(); ++it) {
    miColor sum = {0, 0, 0, 0};
    while (it->sample()) {
      miColor c;
      it->get_contribution(&c);
      if (lights_diffusely(state)) sum += c * color * it->get_dot_nl();
    }
    if (const int samples = it->get_number_of_samples()) *result += sum * (1.0f / samples);
  }
  result->a = 1;
  return miTRUE;
}

}
