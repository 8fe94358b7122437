/* SPDX-License-Identifier: Apache-2.0 */
/* Which functions of the interface were called, and whether they answered as they should. */
#ifndef COVERAGE_H
#define COVERAGE_H

#include <shader.h>

/* Says into the file of ORIEL_COVERAGE that a function was called here. */
#define COVER(name, right) cover(#name, (right) ? 1 : 0, __FILE__, __LINE__)
#define NEAR(found, wanted, tolerance) (fabs((double)(found) - (double)(wanted)) <= (tolerance))
#define IS(v, first, second, third) \
  (NEAR((v).x, first, 1e-4) && NEAR((v).y, second, 1e-4) && NEAR((v).z, third, 1e-4))
#define SHOWS(c, red, green, blue) \
  (NEAR((c).r, red, 1e-4) && NEAR((c).g, green, 1e-4) && NEAR((c).b, blue, 1e-4))

static void cover(const char* name, int right, const char* path, int line) {
  const char* slash = strrchr(path, '/');
  FILE* file = fopen(getenv("ORIEL_COVERAGE"), "a");
  if (!file) return;
  fprintf(file, "%s %s %d %s\n", name, slash ? slash + 1 : path, line, right ? "right" : "wrong");
  fclose(file);
}

/* Before the picture the renderer asks materials what glows: with no ray and nothing to see. */
static int in_picture(const miState* state) {
  return state->type == miRAY_EYE && (state->raster_x != 0 || state->raster_y != 0);
}

static miVector make(double x, double y, double z) {
  miVector v;
  v.x = (miScalar)x;
  v.y = (miScalar)y;
  v.z = (miScalar)z;
  return v;
}

static miColor paint(double r, double g, double b) {
  miColor c;
  c.r = (miScalar)r;
  c.g = (miScalar)g;
  c.b = (miScalar)b;
  c.a = 1;
  return c;
}

#endif
