/* SPDX-License-Identifier: Apache-2.0 */
/* Black bodies against the laws of Wien, Stefan and Boltzmann, and the eye's weights. */
#include "coverage.h"

DLLEXPORT miBoolean cover_blackbody(miColor* result, miState* state, void* paras) {
  const double kelvin = 5000, peak = 2.897772e6 / kelvin; /* nm, Wien */
  const miScalar highest = mi_blackbody_spectral_radiance((miScalar)kelvin, (miScalar)peak);
  miColor eye, red;
  double sum = 0;
  int nm;

  /* 4.09567e-6 T^5 W / (m^2 sr m) at the peak. */
  COVER(mi_blackbody_spectral_radiance,
        NEAR(highest / (4.09567e-15 * pow(kelvin, 5)), 1, 1e-4) &&
            mi_blackbody_spectral_radiance((miScalar)kelvin, (miScalar)(1.1 * peak)) < highest);
  COVER(mi_blackbody_spectral_radiance, mi_blackbody_spectral_radiance(0, 500) == 0);
  for (nm = 10; nm < 200000; nm += 10) sum += 10 * mi_blackbody_spectral_radiance(5000, nm);
  COVER(mi_blackbody_radiance, NEAR(mi_blackbody_radiance(5000) / sum, 1, 1e-3));
  /* sigma T^4 / pi */
  COVER(mi_blackbody_radiance, NEAR(mi_blackbody_radiance(1000) / (5.670374e4 / M_PI), 1, 1e-5));
  /* The tables say x = .0049, y = .3230, z = .2720 at 500 nm; the fit is within about 1 % of the
     highest value. */
  mi_ciexyz_weights(500, &eye);
  COVER(mi_ciexyz_weights,
        NEAR(eye.r, .0049, .02) && NEAR(eye.g, .323, .02) && NEAR(eye.b, .272, .02));
  mi_ciexyz_weights(650, &red);
  COVER(mi_ciexyz_weights, NEAR(red.r, .2835, .02) && NEAR(red.g, .107, .02) && red.b < .001);
  *result = paint(0, 1, 0);
  return miTRUE;
}
