/* SPDX-License-Identifier: Apache-2.0 */
/* A texture of a white texel on the left and a black one on the right, a texture shader, and the
   triangle that carries them: x and y from -8 to 8 in object space, coordinates from 0 to 1. */
#include "coverage.h"

struct cover_textures {
  miTag image;
  miTag filtered; /* the same, filtered */
  miTag shader;
};

/* Shows the coordinate it is asked for. */
DLLEXPORT miBoolean cover_coordinate(miColor* result, miState* state, void* paras) {
  *result = paint(state->tex.x, state->tex.y, state->tex.z);
  return miTRUE;
}

static void look_up(miState* state, struct cover_textures* p) {
  const miTag image = *mi_eval_tag(&p->image), shader = *mi_eval_tag(&p->shader);
  const miTag filtered = *mi_eval_tag(&p->filtered);
  const miVector white = make(.25, .5, 0), black = make(.75, .5, 0), odd = make(.1, .2, .3);
  const miVector again = make(3.25, -1.5, 0);
  miColor c;
  miScalar s;
  miVector v;
  miMatrix st;
  int x = 0, y = 0;
  void* paras = &x;

  COVER(mi_lookup_color_texture,
        mi_lookup_color_texture(&c, state, image, &white) && SHOWS(c, 1, 1, 1));
  COVER(mi_lookup_color_texture,
        mi_lookup_color_texture(&c, state, image, &black) && SHOWS(c, 0, 0, 0));
  COVER(mi_lookup_color_texture,
        mi_lookup_color_texture(&c, state, image, &again) && SHOWS(c, 1, 1, 1));
  COVER(mi_lookup_color_texture,
        mi_lookup_color_texture(&c, state, shader, &odd) && SHOWS(c, .1, .2, .3));
  COVER(mi_lookup_color_texture, !mi_lookup_color_texture(&c, state, miNULLTAG, &odd));
  COVER(mi_lookup_scalar_texture,
        mi_lookup_scalar_texture(&s, state, image, &white) && NEAR(s, 1, 1e-4));
  COVER(mi_lookup_vector_texture,
        mi_lookup_vector_texture(&v, state, shader, &odd) && IS(v, .1, .2, .3));
  mi_texture_info(image, &x, &y, &paras);
  COVER(mi_texture_info, x == 2 && y == 1 && paras == NULL);

  /* A disc as wide as the texture sees the mean of both texels. */
  mi_matrix_null(st);
  st[0] = st[5] = 1;
  st[8] = .25f;
  st[9] = .5f;
  COVER(mi_lookup_filter_color_texture,
        mi_lookup_filter_color_texture(&c, state, filtered, NULL, st) && NEAR(c.r, .5, .1));
  st[0] = st[5] = 1e-4f;
  COVER(mi_lookup_filter_color_texture,
        mi_lookup_filter_color_texture(&c, state, filtered, NULL, st) && NEAR(c.r, 1, .01));
}

static void triangle(miState* state) {
  const miVector *a, *b, *c;
  miVector sum, in_object, t = make(-1, -1, -1);

  mi_point_to_object(state, &in_object, &state->point);
  COVER(mi_texture_interpolate, mi_texture_interpolate(state, 0, &t.x) &&
                                    IS(t, (in_object.x + 8) / 16, (in_object.y + 8) / 16, 0));
  COVER(mi_texture_interpolate, !mi_texture_interpolate(state, 1, &t.x));

  COVER(mi_tri_vectors, mi_tri_vectors(state, 'p', 0, &a, &b, &c) && NEAR(fabs(a->x), 8, 1e-3) &&
                            NEAR(fabs(b->y), 8, 1e-3) && NEAR(c->z, 0, 1e-4));
  sum.x = state->bary[0] * a->x + state->bary[1] * b->x + state->bary[2] * c->x;
  sum.y = state->bary[0] * a->y + state->bary[1] * b->y + state->bary[2] * c->y;
  COVER(mi_tri_vectors, NEAR(sum.x, in_object.x, 1e-3) && NEAR(sum.y, in_object.y, 1e-3));
  COVER(mi_tri_vectors, mi_tri_vectors(state, 't', 0, &a, &b, &c));
  sum.x = state->bary[0] * a->x + state->bary[1] * b->x + state->bary[2] * c->x;
  COVER(mi_tri_vectors, NEAR(sum.x, state->tex_list[0].x, 1e-4));
  COVER(mi_tri_vectors, !mi_tri_vectors(state, 't', 1, &a, &b, &c));
  COVER(mi_tri_vectors, !mi_tri_vectors(state, '*', 0, &a, &b, &c));
}

/* A pixel is 4 wide at the square, 8 in object space: half of the texture. */
static void filter(miState* state) {
  miVector p[3], t[3];
  miMatrix st;
  COVER(mi_texture_filter_project, mi_texture_filter_project(p, t, state, 1, 0));
  COVER(mi_texture_filter_project,
        NEAR(p[1].x - p[0].x, 1, 1e-5) && NEAR(t[1].x - t[0].x, .5, 1e-4) &&
            NEAR(t[1].y - t[0].y, 0, 1e-4) && NEAR(t[2].y - t[0].y, .5, 1e-4) &&
            NEAR(t[0].x, state->tex_list[0].x, 1e-4));
  COVER(mi_texture_filter_transform, mi_texture_filter_transform(st, p, t));
  COVER(mi_texture_filter_transform,
        NEAR(st[0], .5, 1e-4) && NEAR(st[5], .5, 1e-4) && NEAR(st[8], state->tex_list[0].x, 1e-4));
}

DLLEXPORT miBoolean cover_textures(miColor* result, miState* state, struct cover_textures* paras) {
  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  look_up(state, paras);
  triangle(state);
  filter(state);
  return miTRUE;
}
