/* SPDX-License-Identifier: Apache-2.0 */
/* Photons on a painted surface under a clear coat: kept, and sent on as diffuse or mirrored. */
/* Shows: a photon shader: store, choose by Russian roulette, find a direction, send on. */
#include <shader.h>

struct ex_lacquer_photon {
  miColor diffuse;
  miColor mirror;
};

DLLEXPORT int ex_lacquer_photon_version(void) { return 1; }

static void multiply(miColor* energy, const miColor* by) {
  energy->r *= by->r;
  energy->g *= by->g;
  energy->b *= by->b;
}

DLLEXPORT miBoolean ex_lacquer_photon(miColor* energy, miState* state,
                                      struct ex_lacquer_photon* paras) {
  /* Copies: the choice rescales them, so that what goes on carries what was absorbed elsewhere. */
  miColor diffuse = *mi_eval_color(&paras->diffuse);
  miColor mirror = *mi_eval_color(&paras->mirror);
  miColor glossy = {0, 0, 0, 0};
  miVector dir;

  /* Only diffuse surfaces gather photons. What comes straight from a light is left out by the
     renderer where light shaders bring it. */
  if (diffuse.r > 0 || diffuse.g > 0 || diffuse.b > 0) mi_store_photon(energy, state);

  switch (mi_choose_scatter_type(state, 0.0f, &diffuse, &glossy, &mirror)) {
    case miPHOTON_REFLECT_DIFFUSE:
      multiply(energy, &diffuse);
      mi_reflection_dir_diffuse(&dir, state);
      return mi_photon_reflection_diffuse(energy, state, &dir);
    case miPHOTON_REFLECT_SPECULAR:
      multiply(energy, &mirror);
      mi_reflection_dir_specular(&dir, state);
      return mi_photon_reflection_specular(energy, state, &dir);
    default: /* absorbed */
      return miTRUE;
  }
}
