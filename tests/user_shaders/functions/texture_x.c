/* SPDX-License-Identifier: Apache-2.0 */
/* Look-ups with a filter of the shader's own. A pixel covers half of the texture: white on the
   left, black on the right. */
#include "coverage.h"

struct cover_texture_x {
  miTag image;
  miTag shader;
};

/* Shows the coordinate it is asked for. */
DLLEXPORT miBoolean cover_place(miColor* result, miState* state, void* paras) {
  *result = paint(state->tex.x, state->tex.y, state->tex.z);
  return miTRUE;
}

DLLEXPORT miBoolean cover_texture_x(miColor* result, miState* state,
                                    struct cover_texture_x* paras) {
  const miTag image = *mi_eval_tag(&paras->image), shader = *mi_eval_tag(&paras->shader);
  const miVector white = make(.25, .5, 0), odd = make(.1, .2, .3);
  miTexfilter narrow, wide;
  miColor c;
  miScalar s;
  miVector v;

  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  memset(&narrow, 0, sizeof(narrow));
  wide = narrow;
  narrow.circle_radius = 1e-3f;
  wide.circle_radius = 1; /* as wide as the texture: the mean of both */
  COVER(mi_lookup_color_texture_x,
        mi_lookup_color_texture_x(&c, state, image, &white, NULL) && SHOWS(c, 1, 1, 1));
  COVER(mi_lookup_color_texture_x,
        mi_lookup_color_texture_x(&c, state, image, &white, &narrow) && NEAR(c.r, 1, .01));
  COVER(mi_lookup_color_texture_x,
        mi_lookup_color_texture_x(&c, state, image, &white, &wide) && NEAR(c.r, .5, .1));
  COVER(mi_lookup_color_texture_x,
        mi_lookup_color_texture_x(&c, state, shader, &odd, &wide) && SHOWS(c, .1, .2, .3));
  COVER(mi_lookup_color_texture_x, !mi_lookup_color_texture_x(&c, state, 0, &odd, &wide));
  COVER(mi_lookup_scalar_texture_x,
        mi_lookup_scalar_texture_x(&s, state, image, &white, &wide) && NEAR(s, .5, .1));
  COVER(mi_lookup_scalar_texture_x,
        mi_lookup_scalar_texture_x(&s, state, shader, &odd, &wide) && NEAR(s, .2, 1e-4));
  COVER(mi_lookup_vector_texture_x,
        mi_lookup_vector_texture_x(&v, state, image, &white, &wide) && NEAR(v.y, .5, .1));
  COVER(mi_lookup_vector_texture_x,
        mi_lookup_vector_texture_x(&v, state, shader, &odd, &wide) && IS(v, .1, .2, .3));
  return miTRUE;
}
