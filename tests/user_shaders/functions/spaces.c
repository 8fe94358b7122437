/* SPDX-License-Identifier: Apache-2.0 */
/* Between the spaces of a scene whose matrices are known: the camera stands at (0, 0, 4), the
   object is twice as large in its own space and moved by (1, 0, 0) there. */
#include "coverage.h"

DLLEXPORT miBoolean cover_spaces(miColor* result, miState* state, void* paras) {
  const miVector p = make(1, 2, 3), origin = make(0, 0, 0);
  miVector r, x, y;

  mi_point_to_world(state, &r, &p);
  COVER(mi_point_to_world, IS(r, 1, 2, 3));
  mi_point_from_world(state, &r, &p);
  COVER(mi_point_from_world, IS(r, 1, 2, 3));
  mi_vector_to_world(state, &r, &p);
  COVER(mi_vector_to_world, IS(r, 1, 2, 3));
  mi_vector_from_world(state, &r, &p);
  COVER(mi_vector_from_world, IS(r, 1, 2, 3));
  mi_normal_to_world(state, &r, &p);
  COVER(mi_normal_to_world, IS(r, 1, 2, 3));
  mi_normal_from_world(state, &r, &p);
  COVER(mi_normal_from_world, IS(r, 1, 2, 3));

  mi_point_to_camera(state, &r, &p);
  COVER(mi_point_to_camera, IS(r, 1, 2, -1));
  mi_point_from_camera(state, &r, &p);
  COVER(mi_point_from_camera, IS(r, 1, 2, 7));
  mi_vector_to_camera(state, &r, &p);
  COVER(mi_vector_to_camera, IS(r, 1, 2, 3));
  mi_vector_from_camera(state, &r, &p);
  COVER(mi_vector_from_camera, IS(r, 1, 2, 3));
  mi_normal_to_camera(state, &r, &p);
  COVER(mi_normal_to_camera, IS(r, 1, 2, 3));
  mi_normal_from_camera(state, &r, &p);
  COVER(mi_normal_from_camera, IS(r, 1, 2, 3));

  mi_point_to_object(state, &r, &p);
  COVER(mi_point_to_object, IS(r, 3, 4, 6));
  mi_point_from_object(state, &r, &p);
  COVER(mi_point_from_object, IS(r, 0, 1, 1.5));
  mi_vector_to_object(state, &r, &p);
  COVER(mi_vector_to_object, IS(r, 2, 4, 6));
  mi_vector_from_object(state, &r, &p);
  COVER(mi_vector_from_object, IS(r, .5, 1, 1.5));
  /* The inverse transpose, not made unit. */
  mi_normal_to_object(state, &r, &p);
  COVER(mi_normal_to_object, IS(r, .5, 1, 1.5));
  mi_normal_from_object(state, &r, &p);
  COVER(mi_normal_from_object, IS(r, 2, 4, 6));

  /* Half the film is as wide as its distance: the axis is the middle of 2 x 2 pixels, and at depth
     4 a pixel is 4 wide, 8 in the object's own units. */
  mi_point_to_raster(state, &r, &origin);
  COVER(mi_point_to_raster, NEAR(r.x, 1, 1e-4) && NEAR(r.y, 1, 1e-4));
  COVER(mi_raster_unit, mi_raster_unit(state, &x, &y) && IS(x, 8, 0, 0) && IS(y, 0, 8, 0));
  *result = paint(0, 1, 0);
  return miTRUE;
}
