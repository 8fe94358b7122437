/* SPDX-License-Identifier: Apache-2.0 */
/* A square under a sky of radiance (.25, .5, 1) on all sides. */
#include "coverage.h"

DLLEXPORT miBoolean cover_indirect(miColor* result, miState* state, void* paras) {
  struct miIrrad_options irradiance;
  struct miAmboccl_options occlusion;
  miVector bent = make(0, 0, 0);
  miColor c;

  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  COVER(mi_compute_irradiance,
        mi_compute_irradiance(&c, state) && SHOWS(c, .25 * M_PI, .5 * M_PI, M_PI));
  COVER(mi_compute_irradiance_backside,
        mi_compute_irradiance_backside(&c, state) && SHOWS(c, .25 * M_PI, .5 * M_PI, M_PI));
  miIRRAD_DEFAULT(&irradiance, state);
  COVER(miIRRAD_DEFAULT, irradiance.size == (int)sizeof(irradiance) &&
                             irradiance.finalgather_rays == state->options->finalgather_rays &&
                             irradiance.importance == -1);
  COVER(mi_compute_avg_radiance,
        mi_compute_avg_radiance(&c, state, 'f', &irradiance) && SHOWS(c, .25, .5, 1));
  COVER(mi_compute_avg_radiance,
        mi_compute_avg_radiance(&c, state, 'b', NULL) && SHOWS(c, .25, .5, 1));
  COVER(mi_finalgather_store, mi_finalgather_store(&c, state, miFG_STORE_COMPUTE));
  /* There are no photons in volumes. */
  COVER(mi_compute_volume_irradiance,
        !mi_compute_volume_irradiance(&c, state) && SHOWS(c, 0, 0, 0));
  COVER(mi_compute_directional_irradiance,
        !mi_compute_directional_irradiance(&c, state, 1, 0, 0) && SHOWS(c, 0, 0, 0));
  miAMBOCCL_DEFAULT(&occlusion, state);
  COVER(miAMBOCCL_DEFAULT, occlusion.size == (int)sizeof(occlusion) && occlusion.spread == -2 &&
                               IS(occlusion.axis, 0, 0, 1));
  occlusion.rays = 64;
  COVER(mi_ambient_occlusion, mi_ambient_occlusion(state, &occlusion, &bent) == 0 &&
                                  NEAR(mi_vector_norm(&bent), 1, 1e-4) && bent.z > .9);
  /* About an axis along the surface half of all directions are below it. */
  occlusion.axis = make(1, 0, 0);
  occlusion.rays = 1024;
  COVER(mi_ambient_occlusion, NEAR(mi_ambient_occlusion(state, &occlusion, NULL), .5, .08));
  return miTRUE;
}
