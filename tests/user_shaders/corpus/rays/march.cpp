// SPDX-License-Identifier: Apache-2.0
// Steps along the ray and gathers the light of the lamps at each step.
#include <algorithm>
#include <vector>

#include <shader.h>

struct cp_march {
  miScalar density;
  miInteger steps;
  int i_lights, n_lights;
  miTag lights[1];
};

namespace {

struct Step {
  double t, length;
};

std::vector<Step> steps_along(double length, int n) {
  std::vector<Step> steps;
  steps.reserve(n);
  for (int i = 0; i < n; ++i) {
    const Step step = {(i + .5) * length / n, length / n};
    steps.push_back(step);
  }
  return steps;
}

miColor light_at(miState* state, const miVector& at, const miTag* lights, int n) {
  miColor sum = {0, 0, 0, 0};
  const miVector point = state->point, normal = state->normal;
  void* const pri = (void*)state->pri;
  const double dist = state->dist;
  state->point = at;
  state->normal.x = state->normal.y = state->normal.z = 0;
  state->pri = 0;
  for (int i = 0; i < n; ++i) {
    miColor c, one = {0, 0, 0, 0};
    miVector dir;
    miScalar dot_nl;
    int samples = 0;
    while (mi_sample_light(&c, &dir, &dot_nl, state, lights[i], &samples)) {
      one.r += c.r; one.g += c.g; one.b += c.b;
    }
    if (samples) { sum.r += one.r / samples; sum.g += one.g / samples; sum.b += one.b / samples; }
  }
  state->point = point;
  state->normal = normal;
  memcpy(&state->pri, &pri, sizeof pri);
  state->dist = dist;
  return sum;
}

}  // namespace

extern "C" DLLEXPORT int cp_march_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean cp_march(miColor* result, miState* state, cp_march* paras) {
  if (state->type == miRAY_LIGHT || state->type == miRAY_SHADOW || state->dist <= 0) return miTRUE;
  const miScalar density = *mi_eval_scalar(&paras->density);
  const miTag* lights = mi_eval_tag(paras->lights) + *mi_eval_integer(&paras->i_lights);
  const int n = *mi_eval_integer(&paras->n_lights);
  const std::vector<Step> steps = steps_along(state->dist, *mi_eval_integer(&paras->steps));
  miColor sum = {0, 0, 0, 0};
  double kept = 1;
  for (std::vector<Step>::const_iterator s = steps.begin(); s != steps.end(); ++s) {
    miVector at = state->org;
    at.x += miScalar(state->dir.x * s->t);
    at.y += miScalar(state->dir.y * s->t);
    at.z += miScalar(state->dir.z * s->t);
    const miColor light = light_at(state, at, lights, n);
    const double share = kept * density * s->length;
    sum.r += miScalar(share * light.r);
    sum.g += miScalar(share * light.g);
    sum.b += miScalar(share * light.b);
    kept *= std::max(0.0, 1 - density * s->length);
  }
  result->r = miScalar(result->r * kept) + sum.r;
  result->g = miScalar(result->g * kept) + sum.g;
  result->b = miScalar(result->b * kept) + sum.b;
  return miTRUE;
}
