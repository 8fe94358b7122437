// SPDX-License-Identifier: Apache-2.0
// Wrapped diffuse light by the iterator of the interface, with a list and without.
#include <mi_shader_if.h>
#include "view.h"

using mi::shader::LightIterator;

struct cp_iterator {
  miColor color;
  miScalar wrap;
  int i_lights, n_lights;
  miTag lights[1];
};

extern "C" DLLEXPORT int cp_iterator_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean cp_iterator(miColor* result, miState* state, cp_iterator* paras) {
  const corpus::View view(state);
  const miScalar wrap = view(paras->wrap);
  corpus::Color total;
  miTag* lights = mi_eval_tag(paras->lights) + view(paras->i_lights);
  for (LightIterator light(state, lights, view(paras->n_lights)); !light.at_end(); ++light) {
    corpus::Color sum;
    while (light->sample()) {
      miColor c;
      light->get_contribution(&c);
      const miScalar cosine = (corpus::Vec(light->get_direction()) * view.normal() + wrap) / (1 + wrap);
      if (cosine > 0) sum += corpus::Color(c) * corpus::Color(cosine);
    }
    if (light->get_number_of_samples() > 0) sum /= miScalar(light->get_number_of_samples());
    total += sum;
  }
  *result = total * corpus::Color(view(paras->color));
  return miTRUE;
}
