/* SPDX-License-Identifier: Apache-2.0 */
/* Counts, for each sample of the picture, how often a marked surface was met, and writes the count
   into a frame buffer. */
/* Shows: a state shader around each sample, and a material that leaves it something. */
#include <shader.h>

#define HOPS_KEY "ex_hops"

struct ex_hop_meter {
  miInteger buffer; /* frame buffer of type s */
};

DLLEXPORT int ex_hop_meter_version(void) { return 1; }

DLLEXPORT miBoolean ex_hop_meter(void* result, miState* state, struct ex_hop_meter* paras,
                                 miShader_state_arg* arg) {
  if (arg->op == miSHADERSTATE_SAMPLE_INIT) {
    int none = 0;
    mi_shaderstate_set(state, HOPS_KEY, &none, sizeof(none), miSS_LIFETIME_EYERAY);
  } else if (arg->op == miSHADERSTATE_SAMPLE_EXIT) {
    int size;
    const int* hops = mi_shaderstate_get(state, HOPS_KEY, &size);
    if (hops && size == (int)sizeof(*hops)) {
      miScalar value = (miScalar)*hops;
      mi_fb_put(state, *mi_eval_integer(&paras->buffer), &value);
    }
  }
  return miTRUE;
}

/* A mirror that counts. */
struct ex_hop {
  miColor tint;
};

DLLEXPORT int ex_hop_version(void) { return 1; }

DLLEXPORT miBoolean ex_hop(miColor* result, miState* state, struct ex_hop* paras) {
  const miColor* tint = mi_eval_color(&paras->tint);
  /* What get returns is the stored copy itself, so it can be counted up in place. */
  int* hops = mi_shaderstate_get(state, HOPS_KEY, NULL);
  miVector dir;

  if (hops) ++*hops;
  mi_reflection_dir(&dir, state);
  if (!mi_trace_reflection(result, state, &dir)) mi_trace_environment(result, state, &dir);
  result->r *= tint->r;
  result->g *= tint->g;
  result->b *= tint->b;
  return miTRUE;
}
