// SPDX-License-Identifier: Apache-2.0
// A light of the colour of a black body. Its spectrum is made once, for all threads to read.
#include "wrapper.h"

struct cp_kelvin {
  miScalar kelvin, intensity;
};

extern "C" {

DLLEXPORT int cp_kelvin_version(void) { return 1; }

DLLEXPORT void cp_kelvin_init(miState* state, cp_kelvin* paras, miBoolean* inst_init_req) {
  if (!paras) {
    *inst_init_req = miTRUE;
    return;
  }
  miSpectrum* s = mi_spectrum_create_inheap(NULL);
  mi_spectrum_blackbody(s, *mi_eval_scalar(&paras->kelvin), *mi_eval_scalar(&paras->intensity));
  void** user;
  mi_query(miQ_FUNC_USERPTR, state, 0, &user);
  *user = s;
}

DLLEXPORT void cp_kelvin_exit(miState* state, cp_kelvin* paras) {
  if (!paras) return;
  void** user;
  mi_query(miQ_FUNC_USERPTR, state, 0, &user);
  mi_spectrum_delete_fromheap(static_cast<miSpectrum*>(*user));
  *user = NULL;
}

DLLEXPORT miBoolean cp_kelvin(miColor* result, miState* state, cp_kelvin* paras) {
  void** user;
  if (!mi_query(miQ_FUNC_USERPTR, state, 0, &user) || !*user) return miFALSE;
  mi_spectrum_rgb(result, static_cast<const miSpectrum*>(*user));
  return mi_trace_shadow(result, state);
}

}
