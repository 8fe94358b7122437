// SPDX-License-Identifier: Apache-2.0
// A pane that dyes: what passes falls off with the thickness, at each wavelength by its own rate.
#include <math.h>
#include "wrapper.h"

using spectra::Spectrum;

struct cp_filter {
  miTag behind;
  miScalar thickness, blue, red;  // rates at 400 and 700 nm
};

static Spectrum passing(const miScalar thickness, miScalar blue, miScalar red) {
  Spectrum s;
  for (miScalar nm = s.first(); nm <= s.last(); nm += s.step(nm)) {
    const miScalar rate = blue + (red - blue) * (nm - 400) / 300;
    s.set(nm, (miScalar)exp(-rate * thickness));
  }
  return s;
}

extern "C" {

DLLEXPORT int cp_filter_version(void) { return 1; }

DLLEXPORT miBoolean cp_filter(miColor* result, miState* state, struct cp_filter* paras) {
  miColor behind;
  if (Spectrum::rendered()) return miFALSE;  // the profile would want spectra as results
  if (!mi_call_shader(&behind, miSHADER_MATERIAL, state, *mi_eval_tag(&paras->behind)))
    return miFALSE;
  const Spectrum filter = passing(*mi_eval_scalar(&paras->thickness),
                                  *mi_eval_scalar(&paras->blue), *mi_eval_scalar(&paras->red));
  *result = (Spectrum(behind) * filter).rgb();
  return miTRUE;
}

}
