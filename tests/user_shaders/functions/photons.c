/* SPDX-License-Identifier: Apache-2.0 */
/* A light's photons are sent down onto the square; its photon shader tries all ways on. */
#include "coverage.h"

#define PHOTONS 50

static void choices(miState* state) {
  miColor diffuse = paint(1, 1, 1), glossy = paint(0, 0, 0), specular = paint(0, 0, 0);
  miColor half = paint(.5, .5, .5), none = paint(0, 0, 0), all = paint(1, 1, 1);
  miRay_type type;

  COVER(mi_choose_scatter_type, mi_choose_scatter_type(state, 0, &diffuse, &glossy, &specular) ==
                                        miPHOTON_REFLECT_DIFFUSE &&
                                    SHOWS(diffuse, 1, 1, 1));
  COVER(mi_choose_scatter_type,
        mi_choose_scatter_type(state, 0, &none, &glossy, &specular) == miPHOTON_ABSORB);
  specular = all;
  COVER(mi_choose_scatter_type,
        mi_choose_scatter_type(state, 1, &none, &glossy, &specular) == miPHOTON_TRANSMIT_SPECULAR);
  /* Half are absorbed, and the others carry their share. */
  type = mi_choose_simple_scatter_type(state, &half, &none, &none, &none);
  COVER(mi_choose_simple_scatter_type,
        type == miPHOTON_REFLECT_DIFFUSE ? SHOWS(half, 1, 1, 1) : type == miPHOTON_ABSORB);
  COVER(mi_choose_simple_scatter_type,
        mi_choose_simple_scatter_type(state, &none, &none, &none, &all) ==
            miPHOTON_TRANSMIT_SPECULAR);
}

DLLEXPORT miBoolean cover_photon(miColor* energy, miState* state, void* paras) {
  static int photons = 0, depth = 0;
  const miVector up = make(0, 0, 1), down = make(0, 0, -1);
  miColor own = *energy;

  if (depth > 0 || photons >= PHOTONS) return miTRUE;
  ++photons;
  choices(state);
  COVER(mi_store_photon, miRAY_PHOTON(state->type) && mi_store_photon(energy, state));
  COVER(mi_photon_reflection_diffuse, mi_photon_reflection_diffuse(energy, state, &up));
  COVER(mi_photon_reflection_glossy, mi_photon_reflection_glossy(energy, state, &up));
  COVER(mi_photon_reflection_specular, mi_photon_reflection_specular(energy, state, &up));
  COVER(mi_photon_transmission_diffuse, mi_photon_transmission_diffuse(energy, state, &down));
  COVER(mi_photon_transmission_glossy, mi_photon_transmission_glossy(energy, state, &down));
  COVER(mi_photon_transmission_specular, mi_photon_transmission_specular(energy, state, &down));
  COVER(mi_photon_transparent, mi_photon_transparent(energy, state));
  /* There are none in volumes, and materials have no volumes here. */
  COVER(mi_photon_volume_scattering, !mi_photon_volume_scattering(energy, state, &down));
  COVER(mi_store_volume_photon, !mi_store_volume_photon(energy, state));
  COVER(mi_call_photonvol_material, !mi_call_photonvol_material(&own, state));
  depth = 1;
  COVER(mi_call_photon_material, mi_call_photon_material(&own, state));
  depth = 0;
  return miTRUE;
}

DLLEXPORT miBoolean cover_emitter(miColor* energy, miState* state, void* paras) {
  static int photons = 0;
  miBoolean sent;
  state->dir = make(0, 0, -1);
  sent = mi_photon_light(energy, state);
  if (photons++ < PHOTONS)
    COVER(mi_photon_light,
          sent && (state->type == miPHOTON_EMIT_GLOBILLUM || state->type == miPHOTON_EMIT_CAUSTIC));
  return sent;
}

DLLEXPORT miBoolean cover_green(miColor* result, miState* state, void* paras) {
  *result = paint(0, 1, 0);
  return miTRUE;
}
