/* SPDX-License-Identifier: Apache-2.0 */
/* Highlights, Fresnel's shares and colours against closed forms. */
#include "coverage.h"

DLLEXPORT miBoolean cover_highlights(miColor* result, miState* state, void* paras) {
  const miVector down = make(0, 0, -1), up = make(0, 0, 1), x = make(1, 0, 0), y = make(0, 1, 0);
  const miVector mirror = make(.6, 0, .8), flat = make(.8, 0, .6);
  const miColor ior = {1.5f, 2, 1, 1};
  miColor c = {.25f, .5f, 1, 1};
  miScalar ns, ks;
  int i, lobes = 0;
  miState own = *state;

  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  own.dir = make(.6, 0, -.8);
  own.normal = up;
  own.dot_nd = -.8f;
  /* The cosine between the mirrored ray and the light, (.6 .8 + .8 .6) = .96, to the power. */
  COVER(mi_phong_specular, NEAR(mi_phong_specular(30, &own, &mirror), 1, 1e-4));
  COVER(mi_phong_specular, NEAR(mi_phong_specular(30, &own, &flat), pow(.96, 30), 1e-4));
  /* Straight ahead F D / 4 with D = 1 / m^2 in units of a white surface. */
  COVER(mi_blinn_specular, NEAR(mi_blinn_specular(&down, &up, &up, .3f, 1.5f), .04 / .36, 1e-5));
  COVER(mi_blong_specular, NEAR(mi_blong_specular(30, &own, &mirror), 1, 1e-4));
  COVER(mi_cooktorr_specular, mi_cooktorr_specular(&c, &down, &up, &up, .3f, &ior) &&
                                  SHOWS(c, .04 / .36, 1 / 9. / .36, 0));
  /* Ward straight ahead: shiny^2 / 4. */
  COVER(mi_ward_glossy, NEAR(mi_ward_glossy(&down, &up, &up, 10), 25, 1e-2));
  COVER(mi_ward_anisglossy, NEAR(mi_ward_anisglossy(&down, &up, &up, &x, &y, 10, 6), 15, 1e-2));

  COVER(mi_fresnel, NEAR(mi_fresnel(1, 1.5f, 1, 1), .04, 1e-6));
  own.dot_nd = -1;
  COVER(mi_fresnel_reflection, NEAR(mi_fresnel_reflection(&own, 1, 1.5f), .04, 1e-6));
  own.dot_nd = (miScalar)(-1 / sqrt(3.25)); /* Brewster: tan = 1.5 */
  COVER(mi_fresnel_reflection,
        NEAR(mi_fresnel_reflection(&own, 1, 1.5f), .5 * pow(1.25 / 3.25, 2), 1e-5));
  mi_fresnel_specular(&ns, &ks, 30, &own, &mirror, 1, 1.5f);
  COVER(mi_fresnel_specular, NEAR(ns, 1, 1e-4) && NEAR(ks, .5 * pow(1.25 / 3.25, 2), 1e-5));
  COVER(mi_schlick_scatter, NEAR(mi_schlick_scatter(&up, &x, 0), 1 / (4 * M_PI), 1e-6));
  for (i = 0; i < 1000; i++) lobes += mi_choose_lobe(state, .3f);
  COVER(mi_choose_lobe, NEAR(lobes, 300, 73) && mi_choose_lobe(state, 1) == 1);

  c = paint(.25, .5, 1);
  /* The scene says: luminance weight .5 .25 .25. */
  COVER(mi_luminance, NEAR(mi_luminance(state, &c), .5, 1e-6));
  c = paint(1, 1, 1);
  mi_colorprofile_internal_to_ciexyz(&c);
  COVER(mi_colorprofile_internal_to_ciexyz, NEAR(c.r, .9505, 2e-4) && NEAR(c.b, 1.089, 2e-3));
  mi_colorprofile_ciexyz_to_internal(&c);
  COVER(mi_colorprofile_ciexyz_to_internal, SHOWS(c, 1, 1, 1));
  mi_colorprofile_render_to_ciexyz(&c);
  COVER(mi_colorprofile_render_to_ciexyz, NEAR(c.r, .9505, 2e-4) && NEAR(c.g, 1, 2e-4));
  mi_colorprofile_ciexyz_to_render(&c);
  COVER(mi_colorprofile_ciexyz_to_render, SHOWS(c, 1, 1, 1));
  c = paint(.1, .2, .3);
  mi_colorprofile_internal_to_render(&c);
  COVER(mi_colorprofile_internal_to_render, SHOWS(c, .1, .2, .3));
  mi_colorprofile_render_to_internal(&c);
  COVER(mi_colorprofile_render_to_internal, SHOWS(c, .1, .2, .3));
  *result = paint(0, 1, 0);
  return miTRUE;
}
