// SPDX-License-Identifier: Apache-2.0
// Black bodies and colour matching functions for user shaders.
#include "oriel/sdk/shader/blackbody.h"

#include "color/black_body.h"

miScalar mi_blackbody_spectral_radiance(miScalar kelvin, miScalar nm) {
  return static_cast<miScalar>(oriel::black_body_spectral_radiance(nm, kelvin));
}

miScalar mi_blackbody_radiance(miScalar kelvin) {
  return static_cast<miScalar>(oriel::black_body_radiance(kelvin));
}

void mi_ciexyz_weights(miScalar nm, miColor* weights) {
  const oriel::Vec3 xyz = oriel::cie_1931_matching(nm);
  *weights = {xyz.x, xyz.y, xyz.z, 1};
}
