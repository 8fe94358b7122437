// SPDX-License-Identifier: Apache-2.0
// A painted surface under a clear coat: diffuse paint, a mirror whose strength follows Fresnel.
// Shows: parameters by mi_eval, a light loop with LightIterator, indirect light, a traced ray.
#include <shader.h>

struct ex_lacquer {
  miColor paint;
  miScalar ior;       // of the coat
  miScalar indirect;  // weight of indirect light
  int i_lights;       // an array is an offset, a count, and its first element
  int n_lights;
  miTag lights[1];
};

extern "C" DLLEXPORT int ex_lacquer_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean ex_lacquer(miColor* result, miState* state, ex_lacquer* paras) {
  // The slots for shadows and displacement may name the same shader; there is nothing to do then.
  if (state->type == miRAY_SHADOW || state->type == miRAY_DISPLACE) return miFALSE;

  const miColor paint = *mi_eval_color(&paras->paint);
  const miScalar coat = mi_fresnel_reflection(state, 1.0f, *mi_eval_scalar(&paras->ior));
  const miScalar below = 1.0f - coat;
  result->r = result->g = result->b = 0;
  result->a = 1;

  // Direct light. Without a list the iterator takes the lights linked to the object, or all.
  miTag* const lights = mi_eval_tag(paras->lights) + *mi_eval_integer(&paras->i_lights);
  const int n = *mi_eval_integer(&paras->n_lights);
  for (mi::shader::LightIterator light(state, lights, n); !light.at_end(); ++light) {
    miColor sum = {0, 0, 0, 0};
    while (light->sample()) {
      miColor part;
      light->get_contribution(&part);
      const miScalar weight = light->get_dot_nl() * below;
      sum.r += part.r * weight;
      sum.g += part.g * weight;
      sum.b += part.b * weight;
    }
    // Samples that brought no light count as well.
    const int samples = light->get_number_of_samples();
    if (samples > 0) {
      result->r += paint.r * sum.r / (miScalar)samples;
      result->g += paint.g * sum.g / (miScalar)samples;
      result->b += paint.b * sum.b / (miScalar)samples;
    }
  }

  // Final gathering, global illumination and caustics, already divided by pi.
  const miScalar indirect = *mi_eval_scalar(&paras->indirect) * below;
  miColor around;
  if (indirect > 0 && mi_compute_avg_radiance(&around, state, 'f', 0)) {
    result->r += paint.r * around.r * indirect;
    result->g += paint.g * around.g * indirect;
    result->b += paint.b * around.b * indirect;
  }

  // The coat.
  miVector direction;
  miColor mirrored;
  mi_reflection_dir(&direction, state);
  if (mi_trace_reflection(&mirrored, state, &direction)) {
    result->r += coat * mirrored.r;
    result->g += coat * mirrored.g;
    result->b += coat * mirrored.b;
  }
  return miTRUE;
}
