// SPDX-License-Identifier: Apache-2.0
// Between two colours by way of their spectra: what is linear in them is so in the colours.
#include <algorithm>
#include "wrapper.h"

struct cp_mixture { miColor first, second; miScalar at; };

template <class T>
static T between(T a, const T& b, miScalar at) { return a.lerp(b, at), a; }

miC_LINKAGE DLLEXPORT int cp_mixture_version(void) { return 1; }

miC_LINKAGE DLLEXPORT miBoolean cp_mixture(miColor* result, miState* state, cp_mixture* paras) {
  using namespace spectra;
  const Spectrum first(*mi_eval_color(&paras->first)), second(*mi_eval_color(&paras->second));
  const miScalar at = std::min(miScalar(1), *mi_eval_scalar(&paras->at));
  Spectrum sum = between(first, second, at) + Spectrum(miScalar(0));
  sum *= 2;
  if (!sum.valid()) return miFALSE;
  *result = sum.rgb();
  return miTRUE;
}
