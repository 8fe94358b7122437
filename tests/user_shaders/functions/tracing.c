/* SPDX-License-Identifier: Apache-2.0 */
/* Rays of a material on a square under a sky of one colour, with a red wall far along x. */
#include "coverage.h"

#define SKY(c) SHOWS(c, .25, .5, .75)

static miVector to_wall(const miState* state) {
  const miVector wall = make(30, 0, 5);
  miVector d;
  mi_vector_sub(&d, &wall, &state->point);
  mi_vector_normalize(&d);
  return d;
}

static void rays(miState* state) {
  const miVector above = make(0, 0, 2), down = make(0, 0, -1), up = make(0, 0, 1);
  const miVector wall = to_wall(state);
  miVector d;
  miColor c;

  mi_reflection_dir(&d, state);
  COVER(mi_trace_reflection, mi_trace_reflection(&c, state, &d) && SKY(c));
  COVER(mi_trace_reflection, state->child && state->child->type == miRAY_REFLECT &&
                                 state->child->reflection_level == state->reflection_level + 1 &&
                                 state->child->refraction_level == state->refraction_level &&
                                 state->child->parent == state);
  COVER(mi_trace_reflection, mi_trace_reflection(&c, state, &wall) && SHOWS(c, 1, 0, 0) &&
                                 NEAR(state->child->point.x, 30, 1e-3));
  COVER(mi_trace_refraction,
        mi_trace_refraction(&c, state, &down) && SKY(c) && state->child->type == miRAY_REFRACT);
  COVER(mi_trace_transparent, mi_trace_transparent(&c, state) && SKY(c) &&
                                  state->child->refraction_level == state->refraction_level + 1 &&
                                  state->child->reflection_level == state->reflection_level);
  COVER(mi_trace_environment, mi_trace_environment(&c, state, &wall) && SKY(c));
  COVER(mi_trace_continue, mi_trace_continue(&c, state) && SKY(c));
  COVER(mi_trace_probe, mi_trace_probe(state, &down, &above) && NEAR(state->child->dist, 2, 1e-4) &&
                            NEAR(state->child->point.z, 0, 1e-4));
  COVER(mi_trace_probe, !mi_trace_probe(state, &up, &state->point));
}

static void reach(miState* state) {
  const miVector wall = to_wall(state);
  double offset = 3, start = 1, stop = 10;
  miColor c;

  mi_ray_falloff(state, &start, &stop);
  COVER(mi_ray_falloff, start == 0 && stop == 0);
  COVER(mi_ray_falloff, mi_trace_reflection(&c, state, &wall) && SKY(c));
  mi_ray_falloff(state, &start, &stop);
  COVER(mi_ray_falloff, start == 1 && stop == 10);
  start = 0; /* the wall half-way through the fade */
  stop = mi_trace_reflection(&c, state, &wall) ? 2 * state->child->dist : 0;
  mi_ray_falloff(state, &start, &stop);
  COVER(mi_ray_falloff, mi_trace_reflection(&c, state, &wall) && SHOWS(c, .625, .25, .375));
  mi_ray_falloff(state, &start, &stop);
  mi_ray_offset(state, &offset);
  COVER(mi_ray_offset, offset == 0);
  offset = 100; /* behind the wall */
  mi_ray_offset(state, &offset);
  COVER(mi_ray_offset, offset == 3 && mi_trace_reflection(&c, state, &wall) && SKY(c));
  offset = 0;
  mi_ray_offset(state, &offset);
  COVER(mi_ray_offset, offset == 100);
  mi_ray_differential_transform(state, 0);
  COVER(mi_ray_differential_transform, mi_trace_reflection(&c, state, &wall) && SHOWS(c, 1, 0, 0));
}

DLLEXPORT miBoolean cover_tracing(miColor* result, miState* state, void* paras) {
  miColor opacity = paint(.5, .25, 1), back;
  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  rays(state);
  reach(state);
  COVER(mi_opacity_get, !mi_opacity_get(state, &back));
  COVER(mi_opacity_set, mi_opacity_set(state, &opacity));
  COVER(mi_opacity_get, mi_opacity_get(state, &back) && SHOWS(back, .5, .25, 1));
  return miTRUE;
}

/* A lens before all that. */
DLLEXPORT miBoolean cover_lens(miColor* result, miState* state, void* paras) {
  const miVector origin = state->org, direction = state->dir;
  COVER(mi_trace_eye, mi_trace_eye(result, state, &origin, &direction) && SHOWS(*result, 0, 1, 0));
  COVER(mi_trace_eye, NEAR(state->point.z, 0, 1e-3) && NEAR(state->normal.z, 1, 1e-4));
  return miTRUE;
}
