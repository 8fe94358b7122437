// SPDX-License-Identifier: Apache-2.0
// The ways in which C++ sources say that a function is to be found in the library.
#include "shader.h"

#ifdef _MSC_VER
#pragma warning(disable : 4786)
#pragma comment(lib, "shader.lib")
#endif

#ifndef MY_API
#define MY_API miC_LINKAGE DLLEXPORT
#endif
#define BEGIN_C extern "C" {
#define END_C }

struct cp_exports_cc { miScalar value; };
typedef struct cp_exports_cc Paras;

extern "C" DLLEXPORT int cp_exports_cc_version(void);
extern "C" { DLLEXPORT miBoolean cp_exports_cc_linked(miColor *, miState *, Paras *); }
extern "C" miBoolean cp_exports_cc(miColor *result, miState *state, Paras *paras);

DLLEXPORT int cp_exports_cc_version(void) { return 1; }

BEGIN_C
DLLEXPORT void cp_exports_cc_init(miState *, Paras *, miBoolean *req) { *req = miFALSE; }
DLLEXPORT void cp_exports_cc_exit(miState *, Paras *) {}
END_C

MY_API miBoolean cp_exports_cc_made(miColor *result, miState *state, Paras *paras);
MY_API miBoolean cp_exports_cc_made(miColor *result, miState *state, Paras *paras) {
  result->g = 2 * *mi_eval_scalar(&paras->value);
  return miTRUE;
}

miBoolean cp_exports_cc_linked(miColor *result, miState *state, Paras *paras) {
  result->r = *mi_eval_scalar(&paras->value);
  return miTRUE;
}

miBoolean DLLEXPORT cp_exports_cc(miColor *result, miState *state, Paras *paras) {
  result->b = 0;
  result->a = 1;
  return cp_exports_cc_linked(result, state, paras) && cp_exports_cc_made(result, state, paras);
}
