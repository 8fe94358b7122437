// SPDX-License-Identifier: Apache-2.0
// A buffer for each thread, made when a thread first comes and freed at the end of the frame.
#include <algorithm>
#include <vector>

#include "shader.h"

struct cp_scratch {
  int i_values, n_values;
  miScalar values[1];
};

typedef std::vector<miScalar> Scratch;

static Scratch& own(miState* state) {
  Scratch* mine = 0;
  mi_query(miQ_FUNC_TLS_GET, state, miNULLTAG, &mine);
  if (!mine) {
    mine = new Scratch;
    mi_query(miQ_FUNC_TLS_SET, state, miNULLTAG, &mine);
  }
  return *mine;
}

extern "C" DLLEXPORT int cp_scratch_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean cp_scratch_init(miState*, cp_scratch* paras, miBoolean* req) {
  if (!paras) *req = miTRUE;
  return miTRUE;
}

extern "C" DLLEXPORT miBoolean cp_scratch_exit(miState* state, cp_scratch* paras) {
  if (!paras) return miTRUE;
  int threads = 0;
  void** all = 0;
  mi_query(miQ_FUNC_TLS_GETALL, state, miNULLTAG, &all, &threads);
  for (int i = 0; i < threads; ++i) delete (Scratch*)all[i];
  return miTRUE;
}

// Red: the median. Green: the greatest. Blue: what the buffer holds too much.
extern "C" DLLEXPORT miBoolean cp_scratch(miColor* result, miState* state, cp_scratch* paras) {
  Scratch& buffer = own(state);
  const int n = *mi_eval_integer(&paras->n_values);
  const miScalar* values = mi_eval_scalar(paras->values) + *mi_eval_integer(&paras->i_values);
  buffer.insert(buffer.end(), values, values + n);
  std::sort(buffer.begin(), buffer.end());
  result->r = buffer[buffer.size() / 2];
  result->g = buffer.back();
  result->b = miScalar(buffer.size()) - n;
  result->a = 1;
  buffer.clear();
  return miTRUE;
}
