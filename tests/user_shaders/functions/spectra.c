/* SPDX-License-Identifier: Apache-2.0 */
/* Spectra: bands, calculations, lamps and colours. */
#include "coverage.h"

#define BAND(s, nm, wanted) NEAR(mi_spectrum_value_get(s, nm), wanted, 1e-4)

static void flat(miSpectrum* s, double value) {
  int nm;
  for (nm = 400; nm <= 700; nm += 10) mi_spectrum_value_set(s, (miScalar)nm, (miScalar)value);
}

static void cover_making(void) {
  miSpectrum own, *s, *other, *heap;
  miScalar lo = 0, hi = 0;
  memset(&own, 0, sizeof own);
  COVER(mi_spectrum_enabled, mi_spectrum_enabled() == NULL);
  COVER(mi_spectrum_check, !mi_spectrum_check(&own) && !mi_spectrum_check(NULL));
  COVER(mi_spectrum_ensure, mi_spectrum_ensure(&own) == &own && mi_spectrum_check(&own));
  mi_spectrum_value_set(&own, 500, 3);
  COVER(mi_spectrum_ensure, BAND(mi_spectrum_ensure(&own), 500, 3));
  COVER(mi_spectrum_size, mi_spectrum_size(NULL) == sizeof own);
  mi_spectrum_range_get(&own, &lo, &hi);
  COVER(mi_spectrum_range_get, lo == 400 && hi == 700);
  lo = hi = 0;
  mi_spectrum_visible_range(&lo, &hi);
  COVER(mi_spectrum_visible_range, lo == 400 && hi == 700);
  COVER(mi_spectrum_blueprint, mi_spectrum_check(mi_spectrum_blueprint()));
  s = mi_spectrum_create(NULL);
  COVER(mi_spectrum_create, mi_spectrum_check(s) && BAND(s, 550, 0));
  heap = mi_spectrum_create_inheap(mi_spectrum_blueprint());
  COVER(mi_spectrum_create_inheap, mi_spectrum_check(heap));
  mi_spectrum_delete_fromheap(heap);
  COVER(mi_spectrum_delete_fromheap, 1);
  flat(s, 2);
  other = mi_spectrum_clone(s);
  COVER(mi_spectrum_clone, other != s && BAND(other, 400, 2) && BAND(other, 700, 2));
  mi_spectrum_clear(s);
  COVER(mi_spectrum_clear, BAND(s, 550, 0) && BAND(other, 550, 2));
  mi_spectrum_copy(s, other);
  COVER(mi_spectrum_copy, BAND(s, 550, 2));
  mi_spectrum_reset(s);
  COVER(mi_spectrum_reset, BAND(s, 550, 0) && mi_spectrum_check(s));
  mi_spectrum_assign(s, other);
  COVER(mi_spectrum_assign, BAND(s, 640, 2));
  mi_spectrum_assign_data(s, NULL);
  COVER(mi_spectrum_assign_data, mi_spectrum_check(s));
  mi_spectrum_delete(s);
  mi_spectrum_delete(other);
  mi_spectrum_delete(NULL);
  COVER(mi_spectrum_delete, 1);
}

static void cover_bands(void) {
  miSpectrum *a = mi_spectrum_create(NULL), *b = mi_spectrum_create(NULL);
  COVER(mi_spectrum_value_set, mi_spectrum_value_set(a, 544, 3) == 3);
  COVER(mi_spectrum_value_get, BAND(a, 536, 3) && BAND(a, 534, 0) && BAND(a, 300, 0));
  COVER(mi_spectrum_value_set, mi_spectrum_value_set(a, 300, 3) == 0);
  COVER(mi_spectrum_value_add, mi_spectrum_value_add(a, 540, 2) == 5 && BAND(a, 540, 5));
  COVER(mi_spectrum_linewidth,
        mi_spectrum_linewidth(a, 540) == 10 && mi_spectrum_linewidth(a, 800) == 0);
  flat(a, 2);
  flat(b, 3);
  mi_spectrum_value_set(b, 600, 7);
  mi_spectrum_add(a, b);
  COVER(mi_spectrum_add, BAND(a, 400, 5) && BAND(a, 600, 9));
  mi_spectrum_mul(a, b);
  COVER(mi_spectrum_mul, BAND(a, 400, 15) && BAND(a, 600, 63));
  mi_spectrum_scale(a, .5f);
  COVER(mi_spectrum_scale, BAND(a, 400, 7.5) && BAND(a, 600, 31.5));
  mi_spectrum_lerp(a, b, .25f);
  COVER(mi_spectrum_lerp, BAND(a, 400, 7.5 * .75 + 3 * .25) && BAND(a, 600, 31.5 * .75 + 7 * .25));
  mi_spectrum_add(a, NULL);
  mi_spectrum_add(NULL, a);
  mi_spectrum_delete(a);
  mi_spectrum_delete(b);
}

static void cover_colours(void) {
  miSpectrum *s = mi_spectrum_create(NULL), *lamp = mi_spectrum_create(NULL);
  miColor color = paint(.2, .5, .7), seen;
  mi_spectrum_color_add(s, &color);
  mi_spectrum_rgb(&seen, s);
  COVER(mi_spectrum_rgb, SHOWS(seen, .2, .5, .7));
  mi_spectrum_color_add(s, &color);
  mi_spectrum_rgb(&seen, s);
  COVER(mi_spectrum_color_add, SHOWS(seen, .4, 1, 1.4));
  flat(s, 2);
  mi_spectrum_ciexyz(&seen, s);
  COVER(mi_spectrum_ciexyz, NEAR(seen.r, 2, .03) && NEAR(seen.g, 2, 1e-4) && NEAR(seen.b, 2, .03));
  /* D65 is white: the ratio of its bands is that of the CIE's table. */
  mi_spectrum_cie(lamp, 3, "D65");
  mi_spectrum_rgb(&seen, lamp);
  COVER(mi_spectrum_cie, NEAR(seen.r, 3, .06) && NEAR(seen.g, 3, .06) && NEAR(seen.b, 3, .06));
  COVER(mi_spectrum_cie,
        NEAR(mi_spectrum_value_get(lamp, 450) / mi_spectrum_value_get(lamp, 560), 1.17008, 2e-3));
  mi_spectrum_cie_sky(s, 6504, 3);
  COVER(mi_spectrum_cie_sky, BAND(s, 450, mi_spectrum_value_get(lamp, 450)));
  /* Wien's limit, for the ratio of 700 to 600 nm. */
  mi_spectrum_blackbody(s, 1000, 2);
  COVER(mi_spectrum_blackbody, NEAR(mi_spectrum_value_get(s, 700) / mi_spectrum_value_get(s, 600),
                                    pow(6. / 7, 5) * exp(14.387769 * (1 / .6 - 1 / .7)), .02));
  mi_spectrum_ciexyz(&seen, s);
  COVER(mi_spectrum_blackbody, NEAR(seen.g, 2, 1e-4));
  mi_spectrum_delete(s);
  mi_spectrum_delete(lamp);
}

DLLEXPORT miBoolean cover_spectra(miColor* result, miState* state, void* paras) {
  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  cover_making();
  cover_bands();
  cover_colours();
  return miTRUE;
}
