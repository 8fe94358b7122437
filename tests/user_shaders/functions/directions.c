/* SPDX-License-Identifier: Apache-2.0 */
/* Where rays go on: laws of optics, and means over evenly spread samples. */
#include "coverage.h"

#define UNITS(v) NEAR(mi_vector_norm(&(v)), 1, 1e-4)
#define GRID 16
#define MANY 4096

typedef void (*Direction)(miVector* dir, miState* state, const double sample[2]);

static void glossy(miVector* d, miState* s, const double u[2]) {
  mi_reflection_dir_glossy_x(d, s, 200, u);
}
static void anisglossy(miVector* d, miState* s, const double u[2]) {
  const miVector x = make(1, 0, 0), y = make(0, 1, 0);
  mi_reflection_dir_anisglossy_x(d, s, &x, &y, 200, 100, u);
}
static void diffuse(miVector* d, miState* s, const double u[2]) {
  mi_reflection_dir_diffuse_x(d, s, u);
}
static void through_glossy(miVector* d, miState* s, const double u[2]) {
  mi_transmission_dir_glossy_x(d, s, 1, 1.5f, 200, u);
}
static void through_anisglossy(miVector* d, miState* s, const double u[2]) {
  const miVector x = make(1, 0, 0), y = make(0, 1, 0);
  mi_transmission_dir_anisglossy_x(d, s, 1, 1.5f, &x, &y, 200, 100, u);
}
static void through_diffuse(miVector* d, miState* s, const double u[2]) {
  mi_transmission_dir_diffuse_x(d, s, u);
}

/* Mean direction over an even grid of samples; all must be unit and on the side of `up`. */
static int mean_is(Direction direction, miState* state, double up, miVector wanted, double near) {
  miVector sum = make(0, 0, 0), d;
  int i, right = 1;
  for (i = 0; i < GRID * GRID; i++) {
    double u[2];
    u[0] = (i % GRID + .5) / GRID;
    u[1] = (i / GRID + .5) / GRID;
    direction(&d, state, u);
    right &= UNITS(d) && d.z * up > 0;
    mi_vector_add(&sum, &sum, &d);
  }
  mi_vector_div(&sum, GRID * GRID);
  return right && NEAR(sum.x, wanted.x, near) && NEAR(sum.y, wanted.y, near) &&
         NEAR(sum.z, wanted.z, near);
}

/* Incidence by 3-4-5, so Snell's law into glass has sine 0.4. */
static const double kThrough = 0.9165151389911680; /* sqrt(1 - .16) */

static void one_each(miState* state) {
  const miVector x = make(1, 0, 0), y = make(0, 1, 0);
  miVector d;

  mi_reflection_dir(&d, state);
  COVER(mi_reflection_dir, IS(d, .6, 0, .8));
  mi_reflection_dir_specular(&d, state);
  COVER(mi_reflection_dir_specular, IS(d, .6, 0, .8));
  COVER(mi_refraction_dir, mi_refraction_dir(&d, state, 1, 1.5f) && IS(d, .4, 0, -kThrough));
  COVER(mi_refraction_dir, !mi_refraction_dir(&d, state, 2, 1)); /* sine 1.2: total reflection */
  COVER(mi_transmission_dir_specular,
        mi_transmission_dir_specular(&d, state, 1, 1.5f) && IS(d, .4, 0, -kThrough));
  COVER(mi_transmission_dir_specular, !mi_transmission_dir_specular(&d, state, 2, 1));

  mi_reflection_dir_glossy(&d, state, 1000);
  COVER(mi_reflection_dir_glossy, UNITS(d) && NEAR(d.x, .6, .02));
  mi_reflection_dir_anisglossy(&d, state, &x, &y, 1000, 1000);
  COVER(mi_reflection_dir_anisglossy, UNITS(d) && NEAR(d.x, .6, .02));
  mi_reflection_dir_diffuse(&d, state);
  COVER(mi_reflection_dir_diffuse, UNITS(d) && d.z > 0);
  mi_transmission_dir_glossy(&d, state, 1, 1.5f, 1000);
  COVER(mi_transmission_dir_glossy, UNITS(d) && NEAR(d.x, .4, .02) && d.z < 0);
  mi_transmission_dir_anisglossy(&d, state, 1, 1.5f, &x, &y, 1000, 1000);
  COVER(mi_transmission_dir_anisglossy, UNITS(d) && NEAR(d.x, .4, .02) && d.z < 0);
  mi_transmission_dir_diffuse(&d, state);
  COVER(mi_transmission_dir_diffuse, UNITS(d) && d.z < 0);
}

static void means(miState* state) {
  /* The mean of a cosine distribution is 2/3 along its axis. */
  COVER(mi_reflection_dir_diffuse_x, mean_is(diffuse, state, 1, make(0, 0, 2 / 3.), .01));
  COVER(mi_transmission_dir_diffuse_x,
        mean_is(through_diffuse, state, -1, make(0, 0, -2 / 3.), .01));
  COVER(mi_reflection_dir_glossy_x, mean_is(glossy, state, 1, make(.6, 0, .8), .002));
  COVER(mi_reflection_dir_anisglossy_x, mean_is(anisglossy, state, 1, make(.6, 0, .8), .002));
  COVER(mi_transmission_dir_glossy_x,
        mean_is(through_glossy, state, -1, make(.4, 0, -kThrough), .002));
  COVER(mi_transmission_dir_anisglossy_x,
        mean_is(through_anisglossy, state, -1, make(.4, 0, -kThrough), .002));
}

static void media(miState* state) {
  double along = 0, ahead = 0, length = 0;
  int i, units = 1;
  for (i = 0; i < MANY; i++) {
    miVector d;
    mi_scattering_dir_diffuse(&d, state);
    units &= UNITS(d);
    along += mi_vector_dot(&d, &state->dir) / MANY;
    mi_scattering_dir_directional(&d, state, .999f);
    units &= UNITS(d);
    ahead += mi_vector_dot(&d, &state->dir) / MANY;
    length += mi_scattering_pathlength(state, 4) / MANY;
  }
  /* Five standard deviations of the means: 1/sqrt(3) and 1/4 over 64. */
  COVER(mi_scattering_dir_diffuse, units && NEAR(along, 0, .045));
  COVER(mi_scattering_dir_directional, units && ahead > .98);
  COVER(mi_scattering_pathlength, NEAR(length, .25, .02));
}

DLLEXPORT miBoolean cover_directions(miColor* result, miState* state, void* paras) {
  miState own = *state;
  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  own.dir = make(.6, 0, -.8);
  own.normal = own.normal_geom = make(0, 0, 1);
  own.dot_nd = -.8f;
  one_each(&own);
  means(&own);
  media(&own);
  return miTRUE;
}
