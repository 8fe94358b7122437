/* SPDX-License-Identifier: Apache-2.0 */
/* Sends a light's photons into a cone about its axis, evenly over the solid angle. */
/* Shows: a photon emitter. It gets the energy of one photon and gives it a way. */
#include <shader.h>

struct ex_floodlight_photons {
  miScalar angle; /* between the axis and the edge of the cone, degrees */
};

DLLEXPORT int ex_floodlight_photons_version(void) { return 1; }

DLLEXPORT miBoolean ex_floodlight_photons(miColor* energy, miState* state,
                                          struct ex_floodlight_photons* paras) {
  double edge = cos(*mi_eval_scalar(&paras->angle) * M_PI / 180.0);
  double sample[2], cosine, sine, around;
  miVector dir;

  mi_sample(sample, NULL, state, 2, NULL);
  cosine = 1.0 - sample[0] * (1.0 - edge);
  sine = sqrt(1.0 - cosine * cosine);
  around = 2.0 * M_PI * sample[1];

  /* A light looks down its own -z. */
  dir.x = (miScalar)(sine * cos(around));
  dir.y = (miScalar)(sine * sin(around));
  dir.z = (miScalar)-cosine;
  mi_vector_from_light(state, &state->dir, &dir);
  mi_vector_normalize(&state->dir);
  return mi_photon_light(energy, state);
}
