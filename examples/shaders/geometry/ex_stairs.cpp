// SPDX-License-Identifier: Apache-2.0
// A flight of stairs: so many boxes, each a rise higher and a going farther than the one before.
// Shows: a geometry shader that makes an object of polygons.
#include <geoshader.h>
#include <shader.h>

struct ex_stairs {
  miInteger steps;
  miScalar rise;   // height of a step
  miScalar going;  // depth of a step
  miScalar width;
};

namespace {

// A box from the ground up: its 8 corners are vectors and vertices first, first + 1, ...
void add_corners(miScalar z0, miScalar z1, miScalar top, miScalar width) {
  for (int i = 0; i < 8; ++i) {
    miVector corner;
    corner.x = (i & 1) != 0 ? width : 0;
    corner.y = (i & 2) != 0 ? top : 0;
    corner.z = (i & 4) != 0 ? z1 : z0;
    mi_api_vector_xyz_add(&corner);
  }
}

void add_faces(int first) {
  // Counter-clockwise from outside; +z is towards the viewer.
  static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 4, 6, 2},
                                  {1, 3, 7, 5}, {2, 6, 7, 3}, {0, 1, 5, 4}};
  for (int f = 0; f < 6; ++f) {
    mi_api_poly_begin_tag(1, miNULLTAG);  // convex; the instance says the material
    for (int i = 0; i < 4; ++i) mi_api_poly_index_add(first + faces[f][i]);
    mi_api_poly_end();
  }
}

}  // namespace

extern "C" DLLEXPORT int ex_stairs_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean ex_stairs(miTag* result, miState* state, ex_stairs* paras) {
  const int steps = *mi_eval_integer(&paras->steps);
  const miScalar rise = *mi_eval_scalar(&paras->rise);
  const miScalar going = *mi_eval_scalar(&paras->going);
  const miScalar width = *mi_eval_scalar(&paras->width);
  if (steps < 1) {
    mi_error("ex_stairs: %d steps make no stairs", steps);
    return miFALSE;
  }

  // The interface takes the name over, so it has to be a copy.
  miObject* object = mi_api_object_begin(mi_mem_strdup("ex_stairs_object"));
  object->visible = object->shadow = miTRUE;
  object->reflection = object->refraction = 3;
  object->caustic = object->globillum = object->finalgather = 3;

  mi_api_basis_list_clear();
  mi_api_object_group_begin(0.0);
  for (int i = 0; i < steps; ++i)
    add_corners(-going * (miScalar)(i + 1), -going * (miScalar)i, rise * (miScalar)(i + 1), width);
  for (int i = 0; i < 8 * steps; ++i) mi_api_vertex_add(i);
  for (int i = 0; i < steps; ++i) add_faces(8 * i);
  mi_api_object_group_end();
  return mi_geoshader_add_result(result, mi_api_object_end());
}
