/* SPDX-License-Identifier: Apache-2.0 */
/* Two lights: this one at (0, 0, 3), twice as large in its own space, and another beside it. */
#include "coverage.h"

struct cover_light {
  miTag profile;
};

/* Shines with (1, .5, .25) everywhere. Its profile has 100 candela in all directions. */
DLLEXPORT miBoolean cover_light(miColor* result, miState* state, struct cover_light* paras) {
  const miVector p = make(1, 2, 4);
  const miTag profile = *mi_eval_tag(&paras->profile);
  miVector r;
  miBoolean open;

  *result = paint(1, .5, .25);
  if (state->type != miRAY_LIGHT) return miTRUE;
  mi_point_to_light(state, &r, &p);
  COVER(mi_point_to_light, IS(r, 2, 4, 2));
  mi_point_from_light(state, &r, &p);
  COVER(mi_point_from_light, IS(r, .5, 1, 5));
  mi_vector_to_light(state, &r, &p);
  COVER(mi_vector_to_light, IS(r, 2, 4, 8));
  mi_vector_from_light(state, &r, &p);
  COVER(mi_vector_from_light, IS(r, .5, 1, 2));
  mi_normal_to_light(state, &r, &p);
  COVER(mi_normal_to_light, IS(r, .5, 1, 2));
  mi_normal_from_light(state, &r, &p);
  COVER(mi_normal_from_light, IS(r, 2, 4, 8));

  COVER(mi_lightprofile_sample, NEAR(mi_lightprofile_sample(state, profile, miTRUE), 1, 1e-4));
  COVER(mi_lightprofile_value,
        NEAR(mi_lightprofile_value(mi_db_access(profile), .3f, .8f, NULL, miTRUE), 1, 1e-4));
  COVER(mi_lightprofile_value,
        NEAR(mi_lightprofile_value(mi_db_access(profile), 0, 0, &p, miFALSE), 100, .01));

  /* The renderer casts the shadow itself: the answer is yes, or black where it asks what is left
     in a full shadow. */
  open = mi_trace_shadow(result, state);
  COVER(mi_trace_shadow, open ? SHOWS(*result, 1, .5, .25) : SHOWS(*result, 0, 0, 0));
  return open;
}

/* A pane between the light and the square. */
DLLEXPORT miBoolean cover_shadow(miColor* result, miState* state, void* paras) {
  const miColor before = *result;
  COVER(mi_trace_shadow_seg,
        mi_trace_shadow_seg(result, state) && SHOWS(*result, before.r, before.g, before.b));
  COVER(mi_continue_shadow_seg,
        mi_continue_shadow_seg(result, state) && SHOWS(*result, before.r, before.g, before.b));
  mi_vector_mul((miVector*)result, .5f);
  return miTRUE;
}
