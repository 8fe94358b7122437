/* SPDX-License-Identifier: Apache-2.0 */
/* Two spheres and a tube of particle maps. */
#include <geoshader.h>
#include "coverage.h"

static void number(double n) {
  miScalar value = (miScalar)n;
  COVER(mi_api_map_value, mi_api_map_value(miTYPE_SCALAR, &value));
}

static void place(double x, double y, double z) {
  number(x);
  number(y);
  number(z);
  mi_api_map_field_end();
}

static void field(double n) {
  number(n);
  mi_api_map_field_end();
}

static void declare(void) {
  struct miParameter *fields, *extension;
  miInteger id = 1;
  COVER(mi_api_map_decl_dim, mi_api_map_decl_dim(3) && !mi_api_map_decl_dim(7));
  fields = mi_api_map_field_decl(miTYPE_INTEGER, mi_mem_strdup("id"), 0, miFALSE);
  COVER(mi_api_map_field_decl, fields != NULL);
  COVER(mi_api_map_field_decl,
        !mi_api_map_field_decl(miTYPE_COLOR, mi_mem_strdup("no"), 0, miFALSE));
  extension = mi_api_map_field_decl(miTYPE_SCALAR, mi_mem_strdup("extension"), 0, miFALSE);
  fields = mi_api_map_field_append(fields, extension);
  fields = mi_api_map_field_append(
      fields, mi_api_map_field_decl(miTYPE_SCALAR, mi_mem_strdup("way"), 3, miTRUE));
  COVER(mi_api_map_field_append, fields != NULL);
  COVER(mi_api_map_decl_begin, mi_api_map_decl_begin(mi_mem_strdup("dust"), fields) != NULL);
  mi_api_map_decl_end();
  COVER(mi_api_map_value, !mi_api_map_value(miTYPE_INTEGER, &id));
}

static miTag particles(const char* type) {
  const miBoolean tubes = strcmp(type, "tubes") == 0;
  miInteger id = 7;
  miTag map, object;
  int i;
  if (!mi_api_object_begin(mi_mem_strdup(type))) return miNULLTAG;
  COVER(mi_api_map_obj_type, mi_api_map_obj_type(mi_mem_strdup(type)));
  COVER(mi_api_map_obj_type, !mi_api_map_obj_type(mi_mem_strdup("cubes")));
  COVER(mi_api_map_obj_field,
        mi_api_map_obj_field(mi_mem_strdup("radius"), mi_mem_strdup("extension")) &&
            mi_api_map_obj_field(mi_mem_strdup("length"), mi_mem_strdup("extension")) &&
            mi_api_map_obj_field(mi_mem_strdup("direction"), mi_mem_strdup("way")));
  COVER(mi_api_map_begin, !mi_api_map_begin(mi_mem_strdup("no such")));
  COVER(mi_api_map_begin, mi_api_map_begin(mi_mem_strdup("dust")));
  place(0, 5, 0); /* the global way */
  for (i = 0; i < (tubes ? 1 : 2); i++) {
    if (tubes)
      place(2.5, -1, 0);
    else
      place(i * 2 - 2.5, 0, 0);
    COVER(mi_api_map_value, mi_api_map_value(miTYPE_INTEGER, &id));
    mi_api_map_field_end();
    field(tubes ? 1 : .5 + i * .5);
    mi_api_map_element_end();
  }
  map = mi_api_map_end(0);
  COVER(mi_api_map_end, map != miNULLTAG);
  object = mi_api_object_end();
  return object;
}

DLLEXPORT miBoolean cover_particles(miTag* result, miState* state, void* paras) {
  declare();
  return mi_geoshader_add_result(result, particles("spheres")) &&
         mi_geoshader_add_result(result, particles("tubes"));
}

DLLEXPORT miBoolean cover_particle(miColor* result, miState* state, void* paras) {
  const miVector p = state->point;
  *result = paint(0, 0, 1);
  if (!in_picture(state)) return miTRUE;
  if (p.x < 1.4) {
    const double middle = p.x < -1.6 ? -2.5 : -.5, radius = p.x < -1.6 ? .5 : 1;
    const double away = sqrt((p.x - middle) * (p.x - middle) + p.y * p.y + p.z * p.z);
    COVER(mi_api_map_element_end, NEAR(away, radius, 5e-3));
    COVER(mi_api_map_field_end, NEAR(state->normal.z, p.z / radius, 1e-2));
    COVER(mi_api_map_decl_end, NEAR(state->normal.x, (p.x - middle) / radius, 1e-2));
  } else if (p.y > -1 && p.y < 0) {
    /* The tube goes from (2.5, -1) to (2.5, 0): its length is 1, the way is a unit vector. */
    const double away = sqrt((p.x - 2.5) * (p.x - 2.5) + p.z * p.z);
    COVER(mi_api_map_element_end, NEAR(away, 1, 5e-3));
  }
  return miTRUE;
}
