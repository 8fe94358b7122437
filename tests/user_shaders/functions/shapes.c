/* SPDX-License-Identifier: Apache-2.0 */
/* Hair, a free-form surface and two placeholders beside each other. */
#include <geoshader.h>
#include "coverage.h"

static miTag hair(void) {
  static const float numbers[10] = {-3, -8, 0, -3, 0, 0, -3, 8, 0, 99};
  miHair_list* list;
  miScalar* scalars;
  miGeoIndex* hairs;
  int i;
  if (!mi_api_object_begin(NULL)) return miNULLTAG;
  list = mi_api_hair_begin();
  COVER(mi_api_hair_begin, list && list->degree == 1);
  list->radius = 1;
  list->approx = 1;
  COVER(mi_api_hair_info, mi_api_hair_info(0, 'u', 0));
  COVER(mi_api_hair_info, !mi_api_hair_info(0, 'z', 1) && !mi_api_hair_info(7, 'u', 1));
  scalars = mi_api_hair_scalars_begin(10);
  COVER(mi_api_hair_scalars_begin, scalars && !mi_api_hair_scalars_begin(-1));
  for (i = 0; i < 10; i++) scalars[i] = numbers[i];
  COVER(mi_api_hair_scalars_end, mi_api_hair_scalars_end(9));
  COVER(mi_api_hair_scalars_end, !mi_api_hair_scalars_end(10));
  hairs = mi_api_hair_hairs_begin(2);
  COVER(mi_api_hair_hairs_begin, hairs != NULL);
  COVER(mi_api_hair_hairs_add, mi_api_hair_hairs_add(0) && mi_api_hair_hairs_add(9));
  COVER(mi_api_hair_hairs_add, !mi_api_hair_hairs_add(-1));
  COVER(mi_api_hair_hairs_end, mi_api_hair_hairs_end());
  mi_api_hair_end();
  return mi_api_object_end();
}

/* A flat square of half size 1 around (0, 0), with coordinates from 0 to 1. */
static miTag surface(void) {
  miDlist *knots = mi_api_dlist_create(miDLIST_GEOSCALAR), *tags = mi_api_dlist_create(miDLIST_TAG);
  miTag tag = 1;
  miApprox approx;
  int i;
  COVER(mi_api_dlist_create, knots && tags);
  for (i = 0; i < 4; i++) {
    miGeoScalar knot = i / 2;
    COVER(mi_api_dlist_add, mi_api_dlist_add(knots, &knot));
  }
  COVER(mi_api_dlist_add, mi_api_dlist_add(tags, &tag) && !mi_api_dlist_add(tags, NULL));
  mi_api_dlist_delete(tags);
  mi_api_object_begin(mi_mem_strdup("flat"));
  mi_api_basis_list_clear();
  COVER(mi_api_basis_add,
        mi_api_basis_add(mi_mem_strdup("line"), miFALSE, miBASIS_BSPLINE, 1, 0, NULL));
  mi_api_object_group_begin(0.0);
  for (i = 0; i < 8; i++) {
    miGeoVector v;
    v.x = i < 4 ? i % 2 * 2 - 1 : i % 2;
    v.y = i < 4 ? i / 2 * 2 - 1 : i / 2 % 2;
    v.z = 0;
    COVER(mi_api_geovector_xyz_add, mi_api_geovector_xyz_add(&v));
  }
  for (i = 0; i < 8; i++) mi_api_vertex_add(i);
  COVER(mi_api_surface_begin, mi_api_surface_begin(mi_mem_strdup("s"), NULL));
  COVER(mi_api_surface_params,
        mi_api_surface_params(miU, mi_mem_strdup("line"), 0, 1, knots, miFALSE) &&
            mi_api_surface_params(miV, mi_mem_strdup("line"), 0, 1, knots, miFALSE));
  for (i = 0; i < 4; i++) COVER(mi_api_vertex_ref_add, mi_api_vertex_ref_add(i, 1));
  COVER(mi_api_vertex_ref_add, !mi_api_vertex_ref_add(8, 1));
  COVER(mi_api_surface_texture_begin,
        mi_api_surface_texture_begin(miFALSE, miFALSE, mi_mem_strdup("line"), knots, miFALSE,
                                     mi_mem_strdup("line"), knots, miFALSE));
  for (i = 4; i < 8; i++) mi_api_vertex_ref_add(i, 1);
  COVER(mi_api_surface_end, mi_api_surface_end() && !mi_api_surface_end());
  mi_api_dlist_delete(knots);
  miAPPROX_DEFAULT(approx);
  approx.cnst[miCNST_UPARAM] = approx.cnst[miCNST_VPARAM] = 2;
  COVER(mi_api_surface_approx, mi_api_surface_approx(mi_mem_strdup("s"), &approx));
  COVER(mi_api_poly_approx, mi_api_poly_approx(&approx));
  COVER(mi_api_subdivsurf_approx, mi_api_subdivsurf_approx(&approx));
  mi_api_object_group_end();
  return mi_api_object_end();
}

/* The object of a file: a square from (2, -1) to (3, 1). */
static miTag from_file(void) {
  miObject* object = mi_api_object_begin(mi_mem_strdup("from file"));
  if (!object) return miNULLTAG;
  object->bbox_min = make(2, -1, 0);
  object->bbox_max = make(3, 1, 0);
  COVER(mi_api_object_file, mi_api_object_file(mi_mem_strdup("piece.mi")));
  return mi_api_object_end();
}

DLLEXPORT miBoolean cover_shapes(miTag* result, miState* state, void* paras) {
  return mi_geoshader_add_result(result, hair()) && mi_geoshader_add_result(result, surface()) &&
         mi_geoshader_add_result(result, from_file());
}

DLLEXPORT miBoolean cover_shape(miColor* result, miState* state, void* paras) {
  const miVector p = state->point;
  *result = paint(0, 0, 1);
  if (!in_picture(state)) return miTRUE;
  if (p.x < -1.5) {
    /* A cylinder of radius 1 around x = -3, y. */
    COVER(mi_api_hair_end, NEAR((p.x + 3) * (p.x + 3) + p.z * p.z, 1, 1e-2));
  } else if (p.x < 1.5) {
    COVER(mi_api_surface_end, NEAR(p.z, 0, 1e-4) && fabs(p.x) <= 1.0001 && fabs(p.y) <= 1.0001);
    COVER(mi_api_surface_texture_begin, NEAR(state->tex_list[0].x, (p.x + 1) / 2, 1e-3) &&
                                            NEAR(state->tex_list[0].y, (p.y + 1) / 2, 1e-3));
    /* Deleted lists were copied. */
    COVER(mi_api_dlist_delete, NEAR(p.z, 0, 1e-4));
  } else {
    COVER(mi_api_object_file, p.x >= 1.9999 && p.x <= 3.0001 && fabs(p.y) <= 1.0001);
  }
  return miTRUE;
}
