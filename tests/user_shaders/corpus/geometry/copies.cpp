// SPDX-License-Identifier: Apache-2.0
// One object, many instances: each is moved and has a label.
#include <string>
#include <vector>
#include <stdio.h>

#include <shader.h>
#include <geoshader.h>

struct cp_copies {
  int i_x, n_x;
  miScalar x[1];
};

namespace {

miTag plate() {
  static const miScalar corners[4][2] = {{-1, -3}, {1, -3}, {1, 3}, {-1, 3}};
  miObject* object = mi_api_object_begin(mi_mem_strdup("cp_plate"));
  object->visible = miTRUE;
  mi_api_basis_list_clear();
  mi_api_object_group_begin(0.0);
  for (int i = 0; i < 4; ++i) {
    miVector v = {corners[i][0], corners[i][1], 0};
    mi_api_vector_xyz_add(&v);
  }
  for (int i = 0; i < 4; ++i) mi_api_vertex_add(i);
  mi_api_poly_begin_tag(1, miNULLTAG);
  for (int i = 0; i < 4; ++i) mi_api_poly_index_add(i);
  mi_api_poly_end();
  mi_api_object_group_end();
  return mi_api_object_end();
}

}  // namespace

extern "C" DLLEXPORT int cp_copies_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean cp_copies(miTag* result, miState* state, cp_copies* paras) {
  const int n = *mi_eval_integer(&paras->n_x);
  const miScalar* x = mi_eval_scalar(paras->x) + *mi_eval_integer(&paras->i_x);
  const std::vector<miScalar> places(x, x + n);
  const miTag object = plate();
  for (size_t i = 0; i < places.size(); ++i) {
    char name[miNAMESIZE];
    sprintf(name, "cp_copy_%d", (int)i);
    miInstance* instance = mi_api_instance_begin(mi_mem_strdup(name));
    mi_matrix_ident(instance->tf.local_to_global);
    instance->tf.local_to_global[12] = places[i];
    mi_matrix_invert(instance->tf.global_to_local, instance->tf.local_to_global);
    instance->label = (miUint)i + 1;
    mi_geoshader_add_result(result, mi_api_instance_end(NULL, object, miNULLTAG));
  }
  return miTRUE;
}
