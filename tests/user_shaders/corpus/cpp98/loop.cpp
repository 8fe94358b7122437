// SPDX-License-Identifier: Apache-2.0
// A light loop as a class over mi_sample_light, and a lobe as a template parameter.
#include "view.h"

using namespace corpus;

struct cp_loop {
  miColor diffuse, specular;
  miScalar exponent;
  int mode;
  int i_lights, n_lights;
  miTag lights[1];
};

namespace {

struct Phong {
  explicit Phong(miScalar exponent) : exponent_(exponent) {}
  miScalar operator()(miState* state, const miVector& to_light) const {
    return mi_phong_specular(exponent_, state, &to_light);
  }
  miScalar exponent_;
};

template <class Lobe>
Color lit(LightLoop& light, const View& view, const Color& diffuse, const Color& specular,
          const Lobe& lobe) {
  Color sum;
  while (light.sample()) {
    sum += diffuse * light.color * Color(light.cosine);
    const miScalar s = lobe(view, light.direction);
    if (s > 0) sum += specular * light.color * Color(s);
  }
  if (light.samples()) sum /= miScalar(light.samples());
  return sum;
}

}  // namespace

extern "C" {

DLLEXPORT int cp_loop_version(void) { return 1; }

DLLEXPORT miBoolean cp_loop(miColor* result, miState* state, cp_loop* paras) {
  const View view(state);
  Color sum;
  LightLoop light(view, view(paras->mode), view(paras->i_lights), view(paras->n_lights),
                  mi_eval_tag(paras->lights));
  for (; !light.done(); light.next())
    sum += lit(light, view, view(paras->diffuse), view(paras->specular),
               Phong(view(paras->exponent)));
  *result = sum;
  return miTRUE;
}

}
