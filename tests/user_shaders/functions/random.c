/* SPDX-License-Identifier: Apache-2.0 */
/* Samples, random numbers, noise, splines. */
#define _XOPEN_SOURCE 700
#include "coverage.h"

static void samples(miState* state) {
  double at[2], sum = 0;
  int i = 0, n = 0, inside = 1;
  miUint count = 16;

  COVER(mi_sample, !mi_sample(at, NULL, state, 2, NULL));
  while (mi_sample(at, &i, state, 2, &count)) {
    inside &= at[0] >= 0 && at[0] < 1 && at[1] >= 0 && at[1] < 1 && i == n + 1;
    sum += at[0];
    n++;
  }
  /* Sixteen evenly spread numbers: their mean misses 1/2 by less than 1/16. */
  COVER(mi_sample, n == 16 && inside && NEAR(sum / 16, .5, .06));
  for (i = 0, n = 0; mi_sample(at, &i, state, 1, NULL) && n < 100; n++) continue;
  COVER(mi_sample, n == 100);
}

static void numbers(miState* state) {
  unsigned short own[3] = {1, 2, 3}, theirs[3] = {1, 2, 3};
  miScalar first, second;
  int i, same = 1, inside = 1;

  for (i = 0; i < 100; i++) {
    const double p = mi_par_random(state);
    const miScalar r = mi_random();
    inside &= p >= 0 && p < 1 && r >= 0 && r < 1;
    same &= NEAR(mi_erandom(own), erand48(theirs), 1e-6);
  }
  COVER(mi_par_random, inside);
  COVER(mi_random, inside);
  /* The generator of the C library, from the same seed. */
  COVER(mi_erandom, same && memcmp(own, theirs, sizeof(own)) == 0);
  mi_srandom(42);
  first = mi_random();
  mi_srandom(42);
  second = mi_random();
  COVER(mi_srandom, first == second);
}

#define UNIT(x) ((x) >= 0 && (x) <= 1)
#define SLOPE(above, below, g) NEAR(((above) - (below)) / 2e-3, g, .02)

static void noises(void) {
  const miScalar h = 1e-3f;
  double sum[6] = {0, 0, 0, 0, 0, 0};
  int unit[6] = {1, 1, 1, 1, 1, 1}, i;
  miScalar g, gx, gy, x = 3.37f, y = -1.21f;
  miVector p = make(1.3, 2.7, -.4), up = p, down = p, slope;

  for (i = 0; i < 4096; i++) {
    const miScalar u = .37f * (miScalar)i, v = 11.3f + .61f * (miScalar)(i % 64);
    const miVector w = make(u, v, .53 * (i % 97));
    const miScalar value[6] = {mi_noise_1d(u),  mi_noise_2d(u, v),  mi_noise_3d(&w),
                               mi_unoise_1d(u), mi_unoise_2d(u, v), mi_unoise_3d(&w)};
    int k;
    for (k = 0; k < 6; k++) {
      sum[k] += value[k] / 4096;
      unit[k] &= UNIT(value[k]);
    }
  }
  COVER(mi_noise_1d, unit[0] && NEAR(sum[0], .5, .05));
  COVER(mi_noise_2d, unit[1] && NEAR(sum[1], .5, .05));
  COVER(mi_noise_3d, unit[2] && NEAR(sum[2], .5, .05));
  COVER(mi_unoise_1d, unit[3] && NEAR(sum[3], .5, .05));
  COVER(mi_unoise_2d, unit[4] && NEAR(sum[4], .5, .05));
  COVER(mi_unoise_3d, unit[5] && NEAR(sum[5], .5, .05));

  COVER(mi_noise_1d_grad, mi_noise_1d_grad(x, &g) == mi_noise_1d(x));
  COVER(mi_noise_1d_grad, SLOPE(mi_noise_1d(x + h), mi_noise_1d(x - h), g));
  COVER(mi_unoise_1d_grad, mi_unoise_1d_grad(x, &g) == mi_unoise_1d(x));
  COVER(mi_unoise_1d_grad, SLOPE(mi_unoise_1d(x + h), mi_unoise_1d(x - h), g));
  mi_noise_2d_grad(x, y, &gx, &gy);
  COVER(mi_noise_2d_grad, SLOPE(mi_noise_2d(x + h, y), mi_noise_2d(x - h, y), gx) &&
                              SLOPE(mi_noise_2d(x, y + h), mi_noise_2d(x, y - h), gy));
  mi_unoise_2d_grad(x, y, &gx, &gy);
  COVER(mi_unoise_2d_grad, SLOPE(mi_unoise_2d(x + h, y), mi_unoise_2d(x - h, y), gx) &&
                               SLOPE(mi_unoise_2d(x, y + h), mi_unoise_2d(x, y - h), gy));
  up.z += h;
  down.z -= h;
  mi_noise_3d_grad(&p, &slope);
  COVER(mi_noise_3d_grad, SLOPE(mi_noise_3d(&up), mi_noise_3d(&down), slope.z));
  mi_unoise_3d_grad(&p, &slope);
  COVER(mi_unoise_3d_grad, SLOPE(mi_unoise_3d(&up), mi_unoise_3d(&down), slope.z));
}

DLLEXPORT miBoolean cover_random(miColor* result, miState* state, void* paras) {
  const miScalar line[4] = {0, 1, 2, 3};
  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  samples(state);
  numbers(state);
  noises();
  COVER(mi_spline, NEAR(mi_spline(0, 4, line), 0, 1e-6) && NEAR(mi_spline(1, 4, line), 3, 1e-6) &&
                       NEAR(mi_spline(.5f, 4, line), 1.5, 1e-5));
  return miTRUE;
}
